/* ATmega328P: Arduino Uno, Nano. */
#ifndef REGISTERS_ATMEGA328P_H
#define REGISTERS_ATMEGA328P_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

#define CHIP_BOARD WIRE_BOARD_ATMEGA328P

/* Measured in the emulator [tick]. */
#define CHIP_SEAL_TICKS 254u /* from a pong's time being taken to its first byte going out */
#define CHIP_B_LATE 5u       /* from a flank of B to its interrupt's reading the clock, at least */
#define CHIP_LEAD 34u        /* from the compare match to the pins following it (256 to 290 cycles) */

/* The clock: timer 1, with its capture unit on D8. */
#define CLOCK_MODE TCCR1A
#define CLOCK_CONTROL TCCR1B
#define CLOCK_RUN (_BV(ICNC1) | _BV(CS11)) /* noise canceller, clock/8 */
#define CLOCK_RISING _BV(ICES1)
#define CLOCK_COUNTER TCNT1
#define CLOCK_CAPTURED ICR1
#define CLOCK_TICK OCR1A
#define CLOCK_SENSE OCR1B
#define CLOCK_INTERRUPTS TIMSK1
#define CLOCK_ALL (_BV(ICIE1) | _BV(OCIE1A) | _BV(TOIE1))
#define CLOCK_EDGES _BV(ICIE1)
#define CLOCK_TICKS _BV(OCIE1A)
#define CLOCK_ALL_AND_SENSE (CLOCK_ALL | _BV(OCIE1B))
#define CLOCK_FLAGS TIFR1
#define CLOCK_OVERFLOWN _BV(TOV1)
#define CLOCK_TICK_DUE _BV(OCF1A)
#define CLOCK_EDGE_DUE _BV(ICF1)
#define CLOCK_CAPTURE_vect TIMER1_CAPT_vect
#define CLOCK_OVERFLOW_vect TIMER1_OVF_vect
#define CLOCK_TICK_vect TIMER1_COMPA_vect
#define CLOCK_SENSE_vect TIMER1_COMPB_vect

#define EDGES_LEFT GPIOR0 /* interrupts of edges that there is time for until the next tick; 0: they are off */
#define TICKS_UNFED GPIOR2 /* compare interrupts since the watchdog was fed, as far as they matter */
#define EDGE_STALE GPIOR1 /* the capture interrupt that is due is one of an edge that was not heard in time */

#define SERIAL_RECEIVED_vect USART_RX_vect
#define SERIAL_EMPTY_vect USART_UDRE_vect

/* The encoder's lines: A on D8, B on D7. */
#define LINES_A_vect PCINT0_vect
#define LINES_B_vect PCINT2_vect
#define LINES_INTERRUPTS PCICR
#define LINES_A_CHANGES _BV(PCIE0)
#define LINES_B_CHANGES _BV(PCIE2)
#define LINES_FLAGS PCIFR
#define LINES_DUE (_BV(PCIF0) | _BV(PCIF2))

static inline void lines_pull_up(void)
{
    PORTB |= _BV(PB0);
    PORTD |= _BV(PD7);
}

static inline void lines_watch_changes(void)
{
    PCMSK0 = _BV(PCINT0);
    PCMSK2 = _BV(PCINT23);
}

static inline bool lines_a_is_high(void)
{
    return PINB & _BV(PB0);
}

static inline bool lines_b_is_high(void)
{
    return PIND & _BV(PD7);
}

/* The bridge: D3 (OC2B) its enable or PWM input, pulsed by timer 2; D5 (OC0B) and D6 (OC0A) its two direction inputs, by
 * timer 0. */
#define ENABLE _BV(PD3)
#define FORWARD _BV(PD5)
#define REVERSE _BV(PD6)

#define ENABLE_MODE TCCR2A
#define ENABLE_CONTROL TCCR2B
#define ENABLE_COUNTER TCNT2
#define ENABLE_TOP OCR2A /* with silent PWM */
#define ENABLE_COMPARE OCR2B
#define ENABLE_PULSED _BV(COM2B1)
#define ENABLE_FAST (_BV(WGM21) | _BV(WGM20)) /* mode 3: 0 … 255 */
#define ENABLE_RUN _BV(CS21)                  /* 2 MHz: PWM at 7.8 kHz, which an L298N follows */
#define ENABLE_SILENT (_BV(WGM21) | _BV(WGM20))
#define ENABLE_RUN_SILENT (_BV(WGM22) | _BV(CS21)) /* mode 7: 0 … ENABLE_TOP */

#define INPUT_MODE TCCR0A
#define INPUT_CONTROL TCCR0B
#define INPUT_COUNTER TCNT0
#define INPUT_FORWARD OCR0B
#define INPUT_REVERSE OCR0A
#define INPUT_FORWARD_PULSED _BV(COM0B1)
#define INPUT_FORWARD_INVERTED _BV(COM0B0)
#define INPUT_REVERSE_PULSED _BV(COM0A1)
#define INPUT_REVERSE_INVERTED _BV(COM0A0)
#define INPUT_FAST (_BV(WGM01) | _BV(WGM00))
#define INPUT_STOP 0
#define INPUT_RUN _BV(CS01)
#define INPUT_RUN_SILENT _BV(CS00) /* 16 MHz: 62.5 kHz */

static inline void pins_start(void)
{
    PORTD &= (uint8_t)~(ENABLE | FORWARD | REVERSE);
    DDRD |= ENABLE | FORWARD | REVERSE;
}

/* The plain levels of the bridge's pins, all at once; inputs: FORWARD, REVERSE. */
static inline void pins_write(bool enable, uint8_t inputs)
{
    PORTD = (uint8_t)((PORTD & ~(ENABLE | FORWARD | REVERSE)) | (enable ? ENABLE : 0) | inputs);
}

#endif
