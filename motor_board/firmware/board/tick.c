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

#define EDGES_OVERTAKING 9u /* of the 16 kept: seven are left, enough for a period */
#define STARVING 10u /* compare interrupts without a turn of the main loop; the watchdog waits for 60 ms */

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
    if (TICKS_UNFED) {
        TICKS_UNFED = 0;
        wdt_reset();
    }
}

ISR(CLOCK_OVERFLOW_vect)
{
    device_overflow(&board_device);
}

/* Edges may come meanwhile: times are copied with interrupts on, and as many of the oldest ones as such edges overwrite
 * are not used. Two or three come where other interrupts are in between. Where there are so many that none might be left,
 * they wait: 32 us, in which one may be lost. */
static void copy_edges(struct edge_timer *edges)
{
    uint8_t left;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        left = EDGES_LEFT;
        memcpy(edges, &board_device.edges, offsetof(struct edge_timer, time));
    }
    for (uint8_t i = 0; i < EDGE_TIMER_KEPT; i = (uint8_t)(i + 8u)) { /* faster than memcpy, which goes byte by byte */
        uint32_t *to = &edges->time[i];
        const uint32_t *from = &board_device.edges.time[i];
        to[0] = from[0], to[1] = from[1], to[2] = from[2], to[3] = from[3];
        to[4] = from[4], to[5] = from[5], to[6] = from[6], to[7] = from[7];
    }
    __asm__ volatile("" ::: "memory"); /* what an interrupt has changed meanwhile is read again */
    uint8_t newer = (uint8_t)((uint8_t)(board_device.edges.newest - edges->newest) & (EDGE_TIMER_KEPT - 1u));
    if ((uint8_t)(left - EDGES_LEFT) > EDGES_OVERTAKING) { /* `newer` may have gone round */
        ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { memcpy(edges, &board_device.edges, sizeof *edges); }
        return;
    }
    uint8_t sure = (uint8_t)(EDGE_TIMER_KEPT - newer);
    edges->known = edges->known < sure ? edges->known : sure;
}

/* Sets the compare interrupt to what is ahead of the counter, though that takes long itself where much was missed. A
 * function, so that its registers are saved where it is called, and not on the way to the pins. */
static void __attribute__((noinline)) catch_up(uint32_t now)
{
    do {
        CLOCK_TICK = device_catch_up(&board_device, now);
        now = clock_now(&board_device.edges);
    } while (device_is_behind(&board_device, now + 1u) && !clock_tick_pending());
    if (MOTOR_CURRENT_SENSE) {
        CLOCK_SENSE = (uint16_t)(board_device.tick - SENSE_LEAD);
    }
}

/* Edges come first, and noise may hold a tick up until it is time for the next. No more are heard until ticks are in time. */
static inline void be_in_time(void)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        uint32_t now = clock_now(&board_device.edges);
        uint32_t ahead = board_device.compare - now;
        if (ahead <= DEVICE_LONGEST_STEP) {
            encoder_allow((uint16_t)ahead, TICKS_UNFED > STARVING);
        } else if (device_is_behind(&board_device, now) && !clock_tick_pending()) { /* else it comes at once */
            catch_up(now);
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
    CLOCK_INTERRUPTS &= (uint8_t)~CLOCK_TICKS; /* not in itself: there is no room for that on the stack */
    sei();
    if (TICKS_UNFED <= STARVING) {
        TICKS_UNFED++;
    }
    board_woken = true;
    be_in_time();
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
