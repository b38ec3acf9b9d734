/* The one clock, a 16-bit timer of 0.5 us a tick, whose capture unit stamps edges and which makes the sample tick. */
#ifndef CLOCK_H
#define CLOCK_H

#include <stdbool.h>
#include <stdint.h>
#include <util/atomic.h>

#include "config.h"
#include "edge_timer.h"
#include "registers.h"

#define CLOCK_TICK_NS 500u
#define CLOCK_TICKS_PER_MS 2000u

/* The flank that is stamped next: rising or falling. */
static inline void clock_capture(bool rising)
{
    if (rising) {
        CLOCK_CONTROL = CLOCK_RUN | CLOCK_RISING;
    } else {
        CLOCK_CONTROL = CLOCK_RUN;
    }
}

static inline void clock_start(uint16_t first_compare)
{
    CLOCK_TICK = first_compare;
    CLOCK_MODE = 0;
    clock_capture(true);
    CLOCK_INTERRUPTS = MOTOR_CURRENT_SENSE ? CLOCK_ALL_AND_SENSE : CLOCK_ALL;
}

/* Whether the counter has overflowed and its interrupt has not run yet. (Only the interrupts clear it and the
 * tick's flag.) */
static inline bool clock_overflow_pending(void)
{
    return CLOCK_FLAGS & CLOCK_OVERFLOWN;
}

/* Whether the compare interrupt is due and has not run yet. */
static inline bool clock_tick_pending(void)
{
    return CLOCK_FLAGS & CLOCK_TICK_DUE;
}

/* [tick] now; with interrupts off. The counter is read first: an overflow right after it leaves a value in the upper
 * half, which edge_timer_extend takes for what it is. */
static inline uint32_t clock_now(const struct edge_timer *edges)
{
    uint16_t counter = CLOCK_COUNTER;
    return edge_timer_extend(edges->overflows, counter, clock_overflow_pending());
}

/* Whether a moment less than half a turn away has passed. */
static inline bool clock_is_past(uint16_t moment)
{
    uint16_t counter;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { counter = CLOCK_COUNTER; }
    return (int16_t)(counter - moment) > 0;
}

#endif
