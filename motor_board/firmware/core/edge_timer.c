#include "edge_timer.h"

#define OLD 0x80000000u /* [tick] differences beyond this could have wrapped */
#define MOST_LATER 3u   /* edges after `now` */

uint32_t edge_timer_extend(uint16_t overflows, uint16_t counter, bool pending)
{
    if (pending && counter < 0x8000u) {
        overflows++;
    }
    return (uint32_t)overflows << 16 | counter;
}

void edge_timer_overflow(struct edge_timer *timer)
{
    timer->overflows++;
}

void edge_timer_keep(struct edge_timer *timer, uint32_t time, uint8_t way)
{
    uint8_t newest = (timer->newest + 1u) & (EDGE_TIMER_KEPT - 1u);
    timer->newest = newest;
    timer->time[newest] = time;
    timer->way[newest] = way;
    timer->known = (uint8_t)(timer->known + (timer->known < EDGE_TIMER_KEPT));
}

void edge_timer_move(struct edge_timer *timer, uint32_t time)
{
    uint32_t later = time - timer->time[timer->newest];
    for (uint8_t i = 0; i < EDGE_TIMER_KEPT && later < OLD; i++) {
        timer->time[i] += later;
    }
}

void edge_timer_capture(struct edge_timer *timer, uint16_t counter, bool pending)
{
    timer->count++;
    edge_timer_keep(timer, edge_timer_extend(timer->overflows, counter, pending), 0);
}

static void count_one(struct edge_timer *timer, uint32_t time, bool reverse, uint8_t undoes)
{
    timer->count += reverse ? (uint32_t)-1 : 1u;
    edge_timer_keep(timer, time, (uint8_t)(undoes | (reverse ? EDGE_REVERSE : 0u)));
}

void edge_timer_fall(struct edge_timer *timer, uint16_t counter, bool pending, bool b_high)
{
    if (timer->inside && b_high == timer->entered_reverse) {
        count_one(timer, edge_timer_extend(timer->overflows, counter, pending), !b_high, EDGE_UNDOES);
    }
    timer->inside = false;
}

void edge_timer_rise(struct edge_timer *timer, uint16_t counter, bool pending, bool reverse)
{
    edge_timer_fall(timer, counter, pending, reverse);
    timer->inside = true;
    timer->entered_reverse = reverse;
    count_one(timer, edge_timer_extend(timer->overflows, counter, pending), reverse, 0);
}

static uint8_t index_of(const struct edge_timer *timer, uint8_t back)
{
    return (uint8_t)(timer->newest - back) & (EDGE_TIMER_KEPT - 1u);
}

static uint32_t time_of(const struct edge_timer *timer, uint8_t back)
{
    return timer->time[index_of(timer, back)];
}

static bool is_after(uint32_t time, uint32_t now)
{
    return time - now - 1u < OLD / 2;
}

/* `first`: how far back the latest edge is. */
static uint32_t period_of(const struct edge_timer *timer, uint8_t first)
{
    if ((timer->way[index_of(timer, first)] | timer->way[index_of(timer, (uint8_t)(first + 1u))]) & EDGE_UNDOES) {
        return 0; /* the same flank twice: no travel to divide by */
    }
    for (uint8_t back = first; back + 1u < timer->known; back++) {
        uint32_t period = time_of(timer, back) - time_of(timer, (uint8_t)(back + 1u));
        if (period > 0) {
            return period;
        }
    }
    return 0;
}

uint8_t edge_timer_later(const struct edge_timer *timer, uint32_t now)
{
    uint8_t later = 0;
    while (later < MOST_LATER && later < timer->known && is_after(time_of(timer, later), now)) {
        later++;
    }
    return later;
}

struct edge edge_timer_at(const struct edge_timer *timer, uint32_t now, bool two_channels)
{
    struct edge edge = {.count = timer->count};
    uint8_t later = edge_timer_later(timer, now);
    for (uint8_t back = 0; back < later; back++) {
        edge.count += two_channels && (timer->way[index_of(timer, back)] & EDGE_REVERSE) ? 1u : (uint32_t)-1;
    }
    if (later < timer->known) {
        edge.valid = true;
        edge.time = time_of(timer, later);
        edge.reverse = timer->way[index_of(timer, later)] & EDGE_REVERSE;
        edge.period = period_of(timer, later);
    }
    return edge;
}

void edge_timer_forget(struct edge_timer *timer, uint32_t now)
{
    uint32_t newest = timer->time[timer->newest];
    if (now - newest >= OLD && !is_after(newest, now)) {
        timer->known = 0;
    }
}
