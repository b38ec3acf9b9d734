#include "tick.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <stddef.h>
#include <string.h>
#include <util/atomic.h>

#include "board.h"
#include "bridge.h"
#include "clock.h"
#include "config.h"
#include "encoder.h"
#include "guard.h"
#include "registers.h"
#include "sense.h"
#include "supply.h"

static volatile bool ticking; /* since the watchdog was fed */
#if MOTOR_CURRENT_SENSE
static struct guard_memory heat __attribute__((section(".noinit"))); /* outlives a reset, not a power-down */
#endif

void tick_start(void)
{
#if MOTOR_CURRENT_SENSE
    guard_recall(&board_device.guard, &heat);
#endif
    EDGES_LEFT = 0xFF; /* until the first tick */
    clock_start((uint16_t)board_device.compare);
}

void tick_feed_watchdog(void)
{
    if (ticking) {
        ticking = false;
        wdt_reset();
    }
}

ISR(CLOCK_OVERFLOW_vect)
{
    device_overflow(&board_device);
}

/* Edges may come meanwhile: times are copied with interrupts on, and as many of the oldest ones as such edges overwrite
 * are not used. Two or three come where other interrupts are in between. */
static void copy_edges(struct edge_timer *edges)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { memcpy(edges, &board_device.edges, offsetof(struct edge_timer, time)); }
    memcpy(edges->time, board_device.edges.time, sizeof edges->time);
    __asm__ volatile("" ::: "memory"); /* what an interrupt has changed meanwhile is read again */
    uint8_t newer = (uint8_t)(board_device.edges.newest - edges->newest) & (EDGE_TIMER_KEPT - 1u);
    uint8_t sure = (uint8_t)(EDGE_TIMER_KEPT - newer);
    edges->known = edges->known < sure ? edges->known : sure;
}

/* Edges come first, and noise may hold a tick up until it is time for the next. No more are heard until ticks are in time. */
static void __attribute__((noinline)) catch_up(void)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        uint16_t ahead = (uint16_t)(CLOCK_TICK - CLOCK_COUNTER);
        if (ahead <= DEVICE_LONGEST_STEP) {
            encoder_allow(ahead);
        } else if (!clock_tick_pending()) { /* it has passed the next one already */
            CLOCK_TICK = device_catch_up(&board_device, board_now());
            if (MOTOR_CURRENT_SENSE) {
                CLOCK_SENSE = (uint16_t)(board_device.tick - SENSE_LEAD);
            }
        }
    }
}

/* Only its beginning keeps captures waiting: edges may come every 50 us. The next compare interrupt is at least 1 ms
 * away, so that this one is over before it. */
ISR(CLOCK_TICK_vect)
{
    bool ticks = device_latch(&board_device);
    bridge_write(board_device.output.duty, board_device.output.decay, board_device.output.pwm);
    CLOCK_TICK = device_next(&board_device); /* before sei: 16-bit registers share their temporary byte */
    if (MOTOR_CURRENT_SENSE) {
        CLOCK_SENSE = (uint16_t)(board_device.tick - SENSE_LEAD);
    }
    ticking = true;
    board_woken = true;
    CLOCK_INTERRUPTS &= (uint8_t)~CLOCK_TICKS; /* not in itself: there is no room for that on the stack */
    sei();
    catch_up();
    if (ticks) {
        struct edge_timer edges;
        while (!clock_is_past((uint16_t)board_device.latest)) {
        }
        if (MOTOR_CURRENT_SENSE) {
            sense_take_current(&board_device.current);
        }
        copy_edges(&edges);
        device_sample(&board_device, &edges);
#if MOTOR_CURRENT_SENSE
        guard_keep(&board_device.guard, &heat);
#endif
    }
    cli();
    CLOCK_INTERRUPTS |= CLOCK_TICKS;
}

#if MOTOR_CURRENT_SENSE
/* Before a tick. Edges come first; the tick itself is further away than this lasts. */
ISR(CLOCK_SENSE_vect)
{
    uint16_t latest = (uint16_t)(CLOCK_SENSE + SENSE_WAIT);
    sei();
    sense_take_supply(&board_device.supply);
    uint8_t phase = 0;
    while (!bridge_in_middle(&phase) && !clock_is_past(latest)) {
    }
    sense_start_current();
}
#endif
