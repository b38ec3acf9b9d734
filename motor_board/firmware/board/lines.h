/* The encoder's lines: A, which is also the capture unit's, and B. */
#ifndef LINES_H
#define LINES_H

#include <stdbool.h>
#include <stdint.h>

#include "config.h"
#include "quadrature.h"
#include "registers.h"

/* Pull-ups: a line that nobody drives (an open collector, a cable that came off) is high and counts nothing. */
static inline void lines_start(void)
{
    lines_pull_up();
#if MOTOR_CHANNELS == 2
    lines_watch_changes();
    LINES_INTERRUPTS = LINES_A_CHANGES;
#endif
}

#if MOTOR_CHANNELS == 2
/* Which line interrupts on every change: A's falls for one count in a period, none for two, B for four. */
static inline uint8_t lines_watched(uint8_t fold)
{
    return fold == 1 ? LINES_A_CHANGES : fold == 4 ? LINES_B_CHANGES : 0;
}

static inline void lines_interrupt(uint8_t fold)
{
    LINES_INTERRUPTS = lines_watched(fold);
}

/* Both, as `quadrature` has them. */
static inline uint8_t lines_read(void)
{
    return (uint8_t)((lines_a_is_high() ? QUADRATURE_A : 0u) | (lines_b_is_high() ? QUADRATURE_B : 0u));
}
#endif

#endif
