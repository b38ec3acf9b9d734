#include "serial.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "board.h"
#include "registers.h"

#define DIVISOR (F_CPU / 8 / WIRE_BAUD - 1) /* with U2X; exact for 500 kbaud at 16 MHz */
#define RECEIVED 64u                        /* bytes, a power of two */
#define TIMES 8u                            /* zeros whose time is kept, a power of two */

#if F_CPU / 8 / (DIVISOR + 1) != WIRE_BAUD
#error "this clock cannot make the baud rate of protocol/wire.yaml"
#endif

static volatile uint8_t received[RECEIVED], read_to, written_to;
static volatile uint32_t zero_times[TIMES];
static volatile uint8_t zeros_in;
static uint8_t zeros_out;

static uint8_t frames[2][WIRE_LONGEST_FRAME]; /* one goes out, one is filled or waits */
static const uint8_t *volatile sending;       /* 0: quiet */
static volatile uint8_t left, waiting;        /* byte still to go of this one, length of the other one */
static volatile uint8_t filling;              /* index of the other one */

void serial_start(void)
{
    UCSR0A = _BV(U2X0);
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
    UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
    UBRR0H = (uint8_t)(DIVISOR >> 8);
    UBRR0L = (uint8_t)DIVISOR; /* last: simavr works out the speed here */
    UDR0 = 0;                  /* ends whatever frame the reset cut short */
}

ISR(SERIAL_RECEIVED_vect)
{
    uint8_t byte = UDR0;
    uint8_t at = written_to, next = (uint8_t)(at + 1) & (RECEIVED - 1), out = read_to;
    if (next == out) {
        return; /* full: the CRC of what it belonged to will say so */
    }
    received[at] = byte;
    written_to = next;
    if (byte == 0) {
        zero_times[zeros_in++ & (TIMES - 1)] = board_now();
        board_woken = true;
    } else if (((uint8_t)(next - out) & (RECEIVED / 2))) {
        board_woken = true; /* a frame may be longer than what is left of the buffer */
    }
}

bool serial_read(uint8_t *byte, uint32_t *time)
{
    uint8_t at = read_to;
    if (at == written_to) {
        return false;
    }
    *byte = received[at];
    read_to = (uint8_t)(at + 1) & (RECEIVED - 1);
    if (*byte == 0) {
        ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { *time = zero_times[zeros_out & (TIMES - 1)]; }
        zeros_out++;
    }
    return true;
}

ISR(SERIAL_EMPTY_vect)
{
    UDR0 = *sending;
    if (--left) {
        sending++;
        return;
    }
    board_woken = true;
    left = waiting;
    waiting = 0;
    if (left) {
        sending = frames[filling];
        filling ^= 1;
    } else {
        sending = 0;
        UCSR0B &= (uint8_t)~_BV(UDRIE0);
    }
}

uint8_t *serial_buffer(void)
{
    return waiting ? 0 : frames[filling];
}

void serial_send(uint8_t length)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        if (sending) {
            waiting = length;
        } else {
            sending = frames[filling];
            filling ^= 1;
            left = length;
            UCSR0B |= _BV(UDRIE0);
        }
    }
}

bool serial_quiet(void)
{
    bool quiet;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { quiet = sending == 0; }
    return quiet;
}
