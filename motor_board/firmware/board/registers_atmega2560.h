/* ATmega2560: Arduino Mega 2560. Timer 1's capture unit and timer 0's outputs are on no pin, or on one with a LED that the
 * bootloader blinks: timers 5, 3 and 4 do the work here. */
#ifndef REGISTERS_ATMEGA2560_H
#define REGISTERS_ATMEGA2560_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

#define CHIP_BOARD WIRE_BOARD_ATMEGA2560

/* Measured in the emulator [tick]. */
#define CHIP_SEAL_TICKS 254u /* from a pong's time being taken to its first byte going out */
#define CHIP_B_LATE 5u       /* from a flank of B to its interrupt's reading the clock, at least */
#define CHIP_LEAD 36u        /* from the compare match to the pins following it (270 to 300 cycles) */

/* The clock: timer 5, with its capture unit on D48. */
#define CLOCK_MODE TCCR5A
#define CLOCK_CONTROL TCCR5B
#define CLOCK_RUN (_BV(ICNC5) | _BV(CS51)) /* noise canceller, clock/8 */
#define CLOCK_RISING _BV(ICES5)
#define CLOCK_COUNTER TCNT5
#define CLOCK_CAPTURED ICR5
#define CLOCK_TICK OCR5A
#define CLOCK_SENSE OCR5B
#define CLOCK_INTERRUPTS TIMSK5
#define CLOCK_ALL (_BV(ICIE5) | _BV(OCIE5A) | _BV(TOIE5))
#define CLOCK_EDGES _BV(ICIE5)
#define CLOCK_TICKS _BV(OCIE5A)
#define CLOCK_ALL_AND_SENSE (CLOCK_ALL | _BV(OCIE5B))
#define CLOCK_FLAGS TIFR5
#define CLOCK_OVERFLOWN _BV(TOV5)
#define CLOCK_TICK_DUE _BV(OCF5A)
#define CLOCK_EDGE_DUE _BV(ICF5)
#define CLOCK_CAPTURE_vect TIMER5_CAPT_vect
#define CLOCK_OVERFLOW_vect TIMER5_OVF_vect
#define CLOCK_TICK_vect TIMER5_COMPA_vect
#define CLOCK_SENSE_vect TIMER5_COMPB_vect

#define EDGES_LEFT GPIOR0 /* interrupts of edges that there is time for until the next tick; 0: they are off */
#define TICKS_UNFED GPIOR2 /* compare interrupts since the watchdog was fed, as far as they matter */
#define EDGE_STALE GPIOR1 /* the capture interrupt that is due is one of an edge that was not heard in time */

#define SERIAL_RECEIVED_vect USART0_RX_vect
#define SERIAL_EMPTY_vect USART0_UDRE_vect

/* The encoder's lines: A on D48, and with two channels on D18 besides, because D48 has no interrupt of its own; B on D19. */
#define LINES_A_vect INT3_vect
#define LINES_B_vect INT2_vect
#define LINES_INTERRUPTS EIMSK
#define LINES_A_CHANGES _BV(INT3)
#define LINES_B_CHANGES _BV(INT2)
#define LINES_FLAGS EIFR
#define LINES_DUE (_BV(INTF2) | _BV(INTF3))

static inline void lines_pull_up(void)
{
    PORTL |= _BV(PL1);
    PORTD |= _BV(PD2);
}

static inline void lines_watch_changes(void)
{
    EICRA = _BV(ISC30) | _BV(ISC20);
}

static inline bool lines_a_is_high(void)
{
    return PINL & _BV(PL1);
}

static inline bool lines_b_is_high(void)
{
    return PIND & _BV(PD2);
}

/* The bridge: D3 (OC3C) its enable or PWM input, pulsed by timer 3; D7 (OC4B) and D6 (OC4A) its two direction inputs, by
 * timer 4. */
#define ENABLE _BV(PE5)
#define FORWARD _BV(PH4)
#define REVERSE _BV(PH3)

#define ENABLE_MODE TCCR3A
#define ENABLE_CONTROL TCCR3B
#define ENABLE_COUNTER TCNT3
#define ENABLE_TOP OCR3A /* with silent PWM */
#define ENABLE_COMPARE OCR3C
#define ENABLE_PULSED _BV(COM3C1)
#define ENABLE_FAST _BV(WGM30)                             /* mode 5: 0 … 255 */
#define ENABLE_RUN (_BV(WGM32) | _BV(CS31))                /* 2 MHz: PWM at 7.8 kHz, which an L298N follows */
#define ENABLE_SILENT (_BV(WGM31) | _BV(WGM30))            /* mode 15: 0 … ENABLE_TOP */
#define ENABLE_RUN_SILENT (_BV(WGM33) | _BV(WGM32) | _BV(CS31))

#define INPUT_MODE TCCR4A
#define INPUT_CONTROL TCCR4B
#define INPUT_COUNTER TCNT4
#define INPUT_FORWARD OCR4B
#define INPUT_REVERSE OCR4A
#define INPUT_FORWARD_PULSED _BV(COM4B1)
#define INPUT_FORWARD_INVERTED _BV(COM4B0)
#define INPUT_REVERSE_PULSED _BV(COM4A1)
#define INPUT_REVERSE_INVERTED _BV(COM4A0)
#define INPUT_FAST _BV(WGM40)
#define INPUT_STOP _BV(WGM42)
#define INPUT_RUN (_BV(WGM42) | _BV(CS41))
#define INPUT_RUN_SILENT (_BV(WGM42) | _BV(CS40)) /* 16 MHz: 62.5 kHz */

static inline void pins_start(void)
{
    PORTE &= (uint8_t)~ENABLE;
    PORTH &= (uint8_t)~(FORWARD | REVERSE);
    DDRE |= ENABLE;
    DDRH |= FORWARD | REVERSE;
}

/* The plain levels of the bridge's pins; inputs: FORWARD, REVERSE. The enable goes low before the direction changes, and
 * high after it. */
static inline void pins_write(bool enable, uint8_t inputs)
{
    if (!enable) {
        PORTE &= (uint8_t)~ENABLE;
    }
    PORTH = (uint8_t)((PORTH & ~(FORWARD | REVERSE)) | inputs);
    if (enable) {
        PORTE |= ENABLE;
    }
}

#endif
