/* Timer 1: the one clock, 0.5 us a tick, which stamps edges (D8, ICP1) and makes the sample tick. */
#ifndef CLOCK_H
#define CLOCK_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>
#include <util/atomic.h>

#include "config.h"
#include "edge_timer.h"

#define CLOCK_TICK_NS 500u
#define CLOCK_TICKS_PER_MS 2000u

#define CLOCK_RUN (_BV(ICNC1) | _BV(CS11)) /* noise canceller, clock/8 */

/* The flank that is stamped next: rising or falling. */
static inline void clock_capture(bool rising)
{
    if (rising) {
        TCCR1B = CLOCK_RUN | _BV(ICES1);
    } else {
        TCCR1B = CLOCK_RUN;
    }
}

static inline void clock_start(uint16_t first_compare)
{
    OCR1A = first_compare;
    TCCR1A = 0;
    clock_capture(true);
    TIMSK1 = _BV(ICIE1) | _BV(OCIE1A) | _BV(TOIE1) | (MOTOR_CURRENT_SENSE ? _BV(OCIE1B) : 0);
}

/* Whether the counter has overflowed and its interrupt has not run yet. (Nothing here writes TIFR1: the interrupts
 * clear their own flags.) */
static inline bool clock_overflow_pending(void)
{
    return TIFR1 & _BV(TOV1);
}

/* [tick] now; with interrupts off. The counter is read first: an overflow right after it leaves a value in the upper
 * half, which edge_timer_extend takes for what it is. */
static inline uint32_t clock_now(const struct edge_timer *edges)
{
    uint16_t counter = TCNT1;
    return edge_timer_extend(edges->overflows, counter, clock_overflow_pending());
}

/* Whether a moment less than half a turn away has passed. */
static inline bool clock_is_past(uint16_t moment)
{
    uint16_t counter;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { counter = TCNT1; }
    return (int16_t)(counter - moment) > 0;
}

#endif
