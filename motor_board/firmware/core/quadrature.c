#include "quadrature.h"

#define NONE 0
#define ILLEGAL 2
#define CLOSE 2000u /* [tick] 1 ms: B's interrupt may be 25 us late, 1/40 of that */

/* Where a compiler can keep constants out of RAM, it shall. */
#ifdef __FLASH
#define CONSTANT const __flash
#else
#define CONSTANT const
#endif

/* By levels before and levels now (A is bit 0, B bit 1): forward A leads, 0 → 1 → 3 → 2 → 0. */
static CONSTANT int8_t steps[16] = {
    NONE, 1, -1, ILLEGAL, /* from 0 */
    -1, NONE, ILLEGAL, 1, /* from 1: A high */
    1, ILLEGAL, NONE, -1, /* from 2: B high */
    ILLEGAL, -1, 1, NONE, /* from 3 */
};

static inline int8_t step_of(uint8_t before, uint8_t now)
{
    return steps[(uint8_t)(before << 2 | now)];
}

void quadrature_start(struct edge_timer *timer, uint8_t fold, uint8_t lines)
{
    timer->fold = fold;
    timer->lines = lines;
    timer->known = 0;
    timer->inside = false;
}

static inline void count_one(struct edge_timer *timer, uint32_t time, int8_t step, uint8_t way)
{
    if (step < 0) {
        timer->count--;
        way = (uint8_t)(way | EDGE_REVERSE);
    } else {
        timer->count++;
    }
    if ((way ^ timer->way[timer->newest]) & EDGE_REVERSE) {
        way = (uint8_t)(way | EDGE_UNDOES);
    }
    edge_timer_keep(timer, time, way);
}

void quadrature_see_a(struct edge_timer *timer, uint16_t counter, bool pending, uint8_t lines)
{
    uint8_t b = (uint8_t)((timer->fold == 4 ? timer->lines : lines) & QUADRATURE_B);
    uint8_t before = (uint8_t)((timer->lines & QUADRATURE_A) | b), now = (uint8_t)((lines & QUADRATURE_A) | b);
    int8_t step = step_of(before, now);
    timer->lines = now;
    if (step != NONE) {
        count_one(timer, edge_timer_extend(timer->overflows, counter, pending), step, 0);
    }
}

void quadrature_see_b(struct edge_timer *timer, uint16_t counter, bool pending, uint8_t lines, uint8_t late)
{
    if (!((timer->lines ^ lines) & QUADRATURE_B)) {
        return;
    }
    int8_t step = step_of(timer->lines, lines);
    timer->lines = lines;
    if (step == ILLEGAL) {
        timer->errors++;
        timer->known = 0; /* how far it turned is not known: no period reaches across */
        return;
    }
    count_one(timer, edge_timer_extend(timer->overflows, counter, pending) - late, step, EDGE_LATE);
}

static uint8_t index_of(const struct edge_timer *timer, uint8_t back)
{
    return (uint8_t)(timer->newest - back) & (EDGE_TIMER_KEPT - 1u);
}

/* Whether the shaft went one way through `span` intervals that end with this edge. */
static bool is_one_way(const struct edge_timer *timer, uint8_t first, uint8_t span)
{
    uint8_t ways = 0;
    if (first + span >= timer->known) {
        return false;
    }
    for (uint8_t back = first; back < first + span; back++) {
        ways = (uint8_t)(ways | timer->way[index_of(timer, back)]);
    }
    return !(ways & EDGE_UNDOES);
}

static uint32_t mean_period(const struct edge_timer *timer, uint8_t first)
{
    uint8_t shift = timer->fold == 4 ? 2 : 1;
    for (;; shift--) {
        uint8_t span = (uint8_t)(1u << shift);
        if (is_one_way(timer, first, span)) {
            uint32_t time = timer->time[index_of(timer, first)] - timer->time[index_of(timer, (uint8_t)(first + span))];
            return (time + (span >> 1)) >> shift;
        }
        if (shift == 0) {
            return 0;
        }
    }
}

/* Whether to report the edge before this one, as this one's time is too rough for how close they are. */
static bool is_rough(const struct edge_timer *timer, uint8_t back, uint32_t now)
{
    uint8_t at = index_of(timer, back), before = index_of(timer, (uint8_t)(back + 1u));
    return back + 1u < timer->known && timer->way[at] & EDGE_LATE && !(timer->way[before] & EDGE_LATE) &&
           timer->time[at] - timer->time[before] < CLOSE && now - timer->time[at] < CLOSE;
}

struct edge quadrature_at(const struct edge_timer *timer, uint32_t now)
{
    uint8_t back = edge_timer_later(timer, now);
    back = (uint8_t)(back + (back < timer->known && is_rough(timer, back, now)));
    struct edge edge = {.count = timer->count};
    for (uint8_t i = 0; i < back; i++) {
        edge.count += timer->way[index_of(timer, i)] & EDGE_REVERSE ? 1u : (uint32_t)-1;
    }
    if (back < timer->known) {
        uint8_t at = index_of(timer, back);
        edge.valid = true;
        edge.time = timer->time[at];
        edge.reverse = timer->way[at] & EDGE_REVERSE;
        edge.period = mean_period(timer, back);
    }
    return edge;
}
