#include "guard.h"

#include <stdbool.h>

#define PEAK 2u            /* conversions: one may have met a spike of the commutator */
#define BLIND 10u          /* samples in a row without a conversion: edges delay one, no more */
#define LONGEST 0xFFFFu    /* [64 tick] 2 s: a product with 2^14 stays below 2^30 */
#define MOST_HEAT 0x3FFFFFFFul

static uint32_t square(uint16_t steps)
{
    uint32_t value = steps > 1023u ? 1023u : steps;
    return value * value / 64u;
}

void guard_set(struct guard *guard, const struct wire_protect *limits)
{
    guard->limits = *limits;
    if (guard->limits.budget > MOST_HEAT) {
        guard->limits.budget = MOST_HEAT;
    }
    guard->above = guard->unknown = 0;
}

enum guard_verdict guard_check(struct guard *guard, uint16_t steps, uint32_t period)
{
    const struct wire_protect *limits = &guard->limits;
    if (limits->most == 0) {
        return GUARD_WELL;
    }
    if (steps == GUARD_UNKNOWN) { /* the latest one holds, for a while */
        guard->unknown = guard->unknown < BLIND ? (uint8_t)(guard->unknown + 1) : BLIND;
    } else {
        guard->unknown = 0;
        guard->current = steps > limits->zero ? (uint16_t)(steps - limits->zero) : (uint16_t)(limits->zero - steps);
        guard->above = guard->current <= limits->most ? 0 : guard->above < PEAK ? (uint8_t)(guard->above + 1) : PEAK;
    }
    uint32_t time = period / 64u > LONGEST ? LONGEST : period / 64u;
    uint32_t now = square(guard->current), rated = square(limits->rated);
    if (now > rated) {
        guard->heat += (now - rated) * time;
    } else {
        uint32_t cooled = (rated - now) * time;
        guard->heat -= guard->heat < cooled ? guard->heat : cooled;
    }
    bool hot = guard->heat >= limits->budget && now > rated;
    if (guard->heat > limits->budget) {
        guard->heat = limits->budget;
    }
    if (hot || guard->above >= PEAK) {
        return GUARD_OVERCURRENT;
    }
    return guard->unknown >= BLIND ? GUARD_BLIND : GUARD_WELL;
}

void guard_keep(const struct guard *guard, struct guard_memory *memory)
{
    memory->heat = guard->heat;
    memory->check = ~guard->heat;
}

void guard_recall(struct guard *guard, const struct guard_memory *memory)
{
    if (memory->check == ~memory->heat && memory->heat <= MOST_HEAT) {
        guard->heat = memory->heat;
    }
}
