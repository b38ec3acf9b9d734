/* Encoder edges on a 32-bit clock, out of a 16-bit counter with input capture. */
#ifndef EDGE_TIMER_H
#define EDGE_TIMER_H

#include <stdbool.h>
#include <stdint.h>

#define EDGE_TIMER_KEPT 4u /* edges, a power of two */

/* What is known of the encoder at an instant. */
struct edge {
    uint32_t count;  /* wraps; with two channels backward edges count down */
    uint32_t time;   /* [tick] of the latest edge */
    uint32_t period; /* [tick] from the edge before it; 0: there is none, or it is too long ago */
    bool valid;      /* there is a latest edge, and it is less than 2^31 ticks old */
    bool reverse;    /* it was passed backward */
};

struct edge_timer {
    uint16_t overflows; /* upper half of the clock */
    uint32_t count;
    uint8_t newest, known;          /* index of the newest edge kept; how many are */
    uint32_t time[EDGE_TIMER_KEPT]; /* [tick] */
    bool reverse[EDGE_TIMER_KEPT];
};

/* The 32-bit time of a 16-bit counter value.
 *
 * `pending`: the counter has overflowed and `overflows` does not know yet. The value was read (or captured) before that
 * overflow if it is in the upper half, after it if in the lower half. This holds as long as an overflow waits less than
 * half a turn of the counter (16 ms at 0.5 us) for its interrupt. */
uint32_t edge_timer_extend(uint16_t overflows, uint16_t counter, bool pending);

/* The counter has overflowed. */
void edge_timer_overflow(struct edge_timer *timer);

/* An edge was captured at `counter`. */
void edge_timer_capture(struct edge_timer *timer, uint16_t counter, bool pending, bool reverse, bool two_channels);

/* The encoder at `now` [tick].
 *
 * Edges captured between a sample's instant and its interrupt belong to the next sample; up to two of them are told
 * apart. Should a second edge overwrite the capture register before the first one's interrupt has read it, both come
 * with the same time: both count, and the period is that of the pair before. */
struct edge edge_timer_at(const struct edge_timer *timer, uint32_t now, bool two_channels);

/* Forgets edges so old that their time could be taken for a later one; to be called at least every 2^30 ticks. */
void edge_timer_forget(struct edge_timer *timer, uint32_t now);

#endif
