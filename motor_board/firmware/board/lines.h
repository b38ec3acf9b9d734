/* The encoder's lines: A on D8, which is also the capture unit's, and B on D7. */
#ifndef LINES_H
#define LINES_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>

#include "config.h"
#include "quadrature.h"

/* Pull-ups: a line that nobody drives (an open collector, a cable that came off) is high and counts nothing. */
static inline void lines_start(void)
{
    PORTB |= _BV(PB0);
    PORTD |= _BV(PD7);
#if MOTOR_CHANNELS == 2
    PCMSK0 = _BV(PCINT0);
    PCMSK2 = _BV(PCINT23);
    PCICR = _BV(PCIE0);
#endif
}

#if MOTOR_CHANNELS == 2
/* Which line interrupts on every change: A's falls for one count in a period, none for two, B for four. */
static inline void lines_interrupt(uint8_t fold)
{
    PCICR = fold == 1 ? _BV(PCIE0) : fold == 4 ? _BV(PCIE2) : 0;
}

static inline bool lines_a_is_high(void)
{
    return PINB & _BV(PB0);
}

static inline bool lines_b_is_high(void)
{
    return PIND & _BV(PD7);
}

/* Both, as `quadrature` has them. */
static inline uint8_t lines_read(void)
{
    return (uint8_t)((lines_a_is_high() ? QUADRATURE_A : 0u) | (lines_b_is_high() ? QUADRATURE_B : 0u));
}
#endif

#endif
