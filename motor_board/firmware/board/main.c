/* The motor's board: interrupts feed `device`, the main loop moves frames and holds off the watchdog. */
#include "main.h"

#include <avr/cpufunc.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <stddef.h>
#include <string.h>
#include <util/atomic.h>

#include "bridge.h"
#include "clock.h"
#include "config.h"
#include "device.h"
#include "frame.h"
#include "lines.h"
#include "quadrature.h"
#include "registers.h"
#include "sense.h"
#include "serial.h"
#include "supply.h"

static const struct device_config config = {
    .board = CHIP_BOARD,
    .board_id = MOTOR_BOARD_ID,
    .edges_per_revolution = MOTOR_EDGES_PER_REVOLUTION,
    .channels = MOTOR_CHANNELS,
    .tick_ns = CLOCK_TICK_NS,
    .top = BRIDGE_TOP,
    .ticks_per_ms = CLOCK_TICKS_PER_MS,
    .shortest_period = CLOCK_TICKS_PER_MS,
    .first_period = 5 * CLOCK_TICKS_PER_MS,
    .lead = CHIP_LEAD,
    .first_timeout = 100,
    .first_decay = WIRE_DECAY_BRAKE,
    .silent_top = BRIDGE_SILENT_TOP,
    .senses_current = MOTOR_CURRENT_SENSE,
};

volatile bool main_woken;

static struct device device;
static struct frame_reader reader;
static volatile bool ticking; /* the compare interrupt has run since the watchdog was fed */

static uint8_t boot __attribute__((section(".noinit"))); /* outlives a reset, not a power-down */
static uint8_t reset_cause __attribute__((section(".noinit")));
#if MOTOR_CURRENT_SENSE
static struct guard_memory heat __attribute__((section(".noinit")));
#endif

/* Runs before main: after a watchdog reset the watchdog stays on, at its shortest time. */
void stop_watchdog(void) __attribute__((naked, used, section(".init3")));
void stop_watchdog(void)
{
    reset_cause = MCUSR;
    MCUSR = 0;
    wdt_disable();
}

uint32_t main_now(void)
{
    return clock_now(&device.edges);
}

#if MOTOR_CHANNELS == 2
/* The capture unit is set to A's next flank. One that came before that has the time of its being noticed. */
static inline void see_a(uint16_t counter)
{
    for (;;) {
        uint8_t lines = lines_read();
        quadrature_see_a(&device.edges, counter, clock_overflow_pending(), lines);
        clock_capture(!(lines & QUADRATURE_A));
        if (!((lines_read() ^ lines) & QUADRATURE_A)) {
            return;
        }
        counter = CLOCK_COUNTER;
    }
}

static inline void see_fall(void)
{
    if (!lines_a_is_high()) {
        uint16_t counter = CLOCK_COUNTER;
        device_fall(&device, counter, clock_overflow_pending(), lines_b_is_high());
    }
}
#endif

/* Counts as the driver has asked to. */
static void follow_quadrature(void)
{
#if MOTOR_CHANNELS == 2
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        uint8_t fold = device.quadrature, lines = lines_read();
        if (fold != device.edges.fold) {
            quadrature_start(&device.edges, fold, lines);
            lines_interrupt(fold);
            clock_capture(fold == 1 || !(lines & QUADRATURE_A));
        }
    }
#endif
}

ISR(CLOCK_CAPTURE_vect)
{
    uint16_t counter = CLOCK_CAPTURED;
#if MOTOR_CHANNELS == 1
    device_capture(&device, counter, clock_overflow_pending());
#else
    if (device.edges.fold > 1) {
        see_a(counter);
        return;
    }
    device_rise(&device, counter, clock_overflow_pending(), lines_b_is_high());
    see_fall(); /* a pulse that is over already: its interrupt came before this one, and knew of no rising edge */
#endif
}

#if MOTOR_CHANNELS == 2
/* A has changed; its rising edges are captured. */
ISR(LINES_A_vect)
{
    see_fall();
}

/* B has changed. */
ISR(LINES_B_vect)
{
    uint16_t counter = CLOCK_COUNTER;
    bool pending = clock_overflow_pending();
    uint8_t lines = lines_read();
    quadrature_see_b(&device.edges, counter, pending, lines, CHIP_B_LATE);
    if (!((device.edges.lines ^ lines) & QUADRATURE_A)) { /* also after an error: A's flank has been taken note of */
        clock_capture(!(lines & QUADRATURE_A));
    }
}
#endif

ISR(CLOCK_OVERFLOW_vect)
{
    device_overflow(&device);
}

/* Edges may come meanwhile: times are copied with interrupts on, and as many of the oldest ones as such edges overwrite
 * are not used. Two or three come where other interrupts are in between. */
static void copy_edges(struct edge_timer *edges)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { memcpy(edges, &device.edges, offsetof(struct edge_timer, time)); }
    memcpy(edges->time, device.edges.time, sizeof edges->time);
    __asm__ volatile("" ::: "memory"); /* what an interrupt has changed meanwhile is read again */
    uint8_t newer = (uint8_t)(device.edges.newest - edges->newest) & (EDGE_TIMER_KEPT - 1u);
    uint8_t sure = (uint8_t)(EDGE_TIMER_KEPT - newer);
    edges->known = edges->known < sure ? edges->known : sure;
}

/* Only its beginning keeps captures waiting: edges may come every 50 us. The next compare interrupt is at least 1 ms
 * away, so that this one is over before it. */
ISR(CLOCK_TICK_vect)
{
    bool ticks = device_latch(&device);
    bridge_write(device.output.duty, device.output.decay, device.output.pwm);
    CLOCK_TICK = device_next(&device); /* before sei: 16-bit registers share their temporary byte */
    if (MOTOR_CURRENT_SENSE) {
        CLOCK_SENSE = (uint16_t)(device.tick - SENSE_LEAD);
    }
    ticking = true;
    main_woken = true;
    sei();
    if (ticks) {
        struct edge_timer edges;
        while (!clock_is_past((uint16_t)device.latest)) {
        }
        if (MOTOR_CURRENT_SENSE) {
            sense_take_current(&device.current);
        }
        copy_edges(&edges);
        device_sample(&device, &edges);
#if MOTOR_CURRENT_SENSE
        guard_keep(&device.guard, &heat);
#endif
    }
}

#if MOTOR_CURRENT_SENSE
/* Before a tick. Edges come first; the tick itself is further away than this lasts. */
ISR(CLOCK_SENSE_vect)
{
    uint16_t latest = (uint16_t)(CLOCK_SENSE + SENSE_WAIT);
    sei();
    sense_take_supply(&device.supply);
    while (!bridge_in_middle() && !clock_is_past(latest)) {
    }
    sense_start_current();
}
#endif

static void receive(void)
{
    uint8_t byte;
    uint32_t time = 0;
    struct frame frame;
    while (serial_read(&byte, &time)) {
        if (frame_read(&reader, byte, &frame)) {
            bool known;
            ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { known = device_act(&device, &frame, time); }
            reader.bad = (uint16_t)(reader.bad + !known);
        }
    }
}

static void send(void)
{
    static struct device_frame frame;
    uint8_t *wire;
    while ((wire = serial_buffer()) != 0) {
        bool quiet = serial_quiet(), taken;
        ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
        {
            taken = device_take(&device, &frame, quiet, main_now() + CHIP_SEAL_TICKS, reader.bad);
        }
        if (!taken) {
            return;
        }
        serial_send(frame_seal(frame.data, frame.type, frame.seq, frame.size, wire));
    }
}

/* Sleep until an interrupt leaves something to do; at once awake if one has since `main_woken` was cleared. */
static void rest(void)
{
    cli();
    while (!main_woken) {
        SMCR = _BV(SE); /* idle: clocks and timers go on */
        sei();
        sleep_cpu();
        _NOP(); /* simavr takes an interrupt that comes with the sleep one instruction later */
        cli();
    }
    SMCR = 0;
    sei();
}

static void feed_watchdog(void)
{
    if (ticking) { /* main loop and sample tick both live */
        ticking = false;
        wdt_reset();
    }
}

int main(void)
{
    bridge_start();
    wdt_enable(WDTO_60MS);
    device_start(&device, &config, ++boot, reset_cause);
#if MOTOR_CURRENT_SENSE
    guard_recall(&device.guard, &heat);
#endif
    bridge_write(0, device.output.decay, WIRE_PWM_STANDARD);
    lines_start();
    supply_start();
    sense_start();
    serial_start();
    clock_start((uint16_t)device.compare);
    sei();
    for (;;) {
        main_woken = false;
        receive();
        follow_quadrature();
        send();
        if (!MOTOR_CURRENT_SENSE) { /* else the converter belongs to the current, which is about a moment */
            supply_read(&device.supply);
        }
        feed_watchdog();
        rest();
    }
}
