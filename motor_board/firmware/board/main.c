/* The motor's board: interrupts (encoder.c, tick.c, serial.c) feed its device; here the main loop, which moves frames and
 * holds off the watchdog. */
#include <avr/cpufunc.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "board.h"
#include "bridge.h"
#include "clock.h"
#include "config.h"
#include "device.h"
#include "encoder.h"
#include "frame.h"
#include "lines.h"
#include "registers.h"
#include "sense.h"
#include "serial.h"
#include "starts.h"
#include "supply.h"
#include "tick.h"

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

static struct frame_reader reader;

static uint8_t reset_cause __attribute__((section(".noinit")));

/* Runs before main: after a watchdog reset the watchdog stays on, at its shortest time. */
void stop_watchdog(void) __attribute__((naked, used, section(".init3")));
void stop_watchdog(void)
{
    reset_cause = MCUSR;
    MCUSR = 0;
    wdt_disable();
}

static void receive(void)
{
    uint8_t byte;
    uint32_t time = 0;
    struct frame frame;
    while (serial_read(&byte, &time)) {
        if (frame_read(&reader, byte, &frame)) {
            bool known;
            ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { known = device_act(&board_device, &frame, time); }
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
            taken = device_take(&board_device, &frame, quiet, board_now() + CHIP_SEAL_TICKS, reader.bad);
        }
        if (!taken) {
            return;
        }
        serial_send(frame_seal(frame.data, frame.type, frame.seq, frame.size, wire));
        tick_feed_watchdog(); /* where there is always another frame, that is no hang */
    }
}

/* Sleep until an interrupt leaves something to do; at once awake if one has since `board_woken` was cleared. */
static void rest(void)
{
    cli();
    while (!board_woken) {
        SMCR = _BV(SE); /* idle: clocks and timers go on */
        sei();
        sleep_cpu();
        _NOP(); /* simavr takes an interrupt that comes with the sleep one instruction later */
        cli();
    }
    SMCR = 0;
    sei();
}

int main(void)
{
    bridge_start();
    wdt_enable(WDTO_60MS);
    device_start(&board_device, &config, starts_next(), reset_cause);
    bridge_write(0, board_device.output.decay, WIRE_PWM_STANDARD);
    lines_start();
    supply_start();
    sense_start();
    serial_start();
    tick_start();
    sei();
    for (;;) {
        board_woken = false;
        receive();
        encoder_follow();
        send();
        if (!MOTOR_CURRENT_SENSE) { /* else the converter belongs to the current, which is about a moment */
            supply_read(&board_device.supply);
        }
        tick_feed_watchdog();
        rest();
    }
}
