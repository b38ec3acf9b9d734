/* Edges and bytes that go in at given cycles, and bytes that come out. */
#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_cycle_timers.h>

#include "inside.h"

#define CYCLES_PER_BYTE 320 /* 500 kbaud, 8N1 */
#define PULSE 64            /* cycles that the encoder's pin stays high */

static avr_cycle_count_t on_timer(avr_t *avr, avr_cycle_count_t when, void *param);

static uint64_t next_event(const struct chip *chip)
{
    uint64_t next = chip->until;
    if (chip->edge_out != chip->edge_in && chip->edges[chip->edge_out % EDGES].cycle < next) {
        next = chip->edges[chip->edge_out % EDGES].cycle;
    }
    if (chip->fall && chip->fall < next) {
        next = chip->fall;
    }
    if (chip->settle && chip->settle < next) {
        next = chip->settle;
    }
    if (chip->feed_out != chip->feed_in && chip->feed_next < next) {
        next = chip->feed_next;
    }
    return next;
}

void traffic_arm(struct chip *chip)
{
    uint64_t next = next_event(chip), now = chip->avr->cycle;
    avr_cycle_timer_register(chip->avr, next > now ? next - now : 1, on_timer, chip);
}

/* Channel A, on all pins that it is wired to. */
static void raise_a(struct chip *chip, uint32_t value)
{
    avr_raise_irq(chip->edge, value);
    if (chip->edge_too) {
        avr_raise_irq(chip->edge_too, value);
    }
}

/* Timers come up to 3 cycles late: the line changes as if it were `cycle`. */
static void raise_a_at(struct chip *chip, uint32_t value, uint64_t cycle)
{
    uint64_t now = chip->avr->cycle;
    chip->avr->cycle = cycle;
    raise_a(chip, value);
    chip->avr->cycle = now;
}

static avr_ioport_external_t with(avr_ioport_external_t lines, struct pin pin, int high)
{
    if (pin.port == lines.name) {
        lines.mask |= (uint8_t)(1u << pin.bit);
        lines.value |= (uint8_t)((high ? 1u : 0u) << pin.bit);
    }
    return lines;
}

/* Before a program has said that it wants changes, simavr takes a low pin for an interrupt again and again, and does not stop
 * when the program has said it. Every reset brings that back. */
static void forget_low_levels(struct chip *chip)
{
    for (uint8_t interrupt = 0; chip->edge_too && interrupt < 4; interrupt++) {
        avr_extint_set_strict_lvl_trig(chip->avr, interrupt, 0);
    }
}

/* What the encoder drives, against pull-ups, which simavr would let act again at every write to the port. */
static void drive_lines(struct chip *chip, int a_high, int b_high)
{
    const struct layout *at = chip->layout;
    forget_low_levels(chip);
    const char ports[] = {at->a.port, at->b.port}; /* a_too is on B's, if on any */
    for (int i = 0; i < 2; i++) {
        avr_ioport_external_t lines = {.name = (unsigned char)ports[i]};
        lines = with(with(with(lines, at->a, a_high), at->a_too, a_high), at->b, b_high);
        avr_ioctl(chip->avr, AVR_IOCTL_IOPORT_SET_EXTERNAL(ports[i]), &lines);
    }
    if (chip->b_high != (b_high != 0)) {
        avr_raise_irq(chip->direction, b_high != 0);
    }
    chip->a_high = a_high != 0;
    chip->b_high = b_high != 0;
}

static void pass_edge(struct chip *chip, uint64_t cycle, uint8_t what)
{
    drive_lines(chip, what & CHIP_B_ALONE ? chip->a_high : what & CHIP_A_STAYS, what & CHIP_B_HIGH);
    if (what & CHIP_B_ALONE) {
        return;
    }
    if (what & CHIP_A_FALLS) {
        raise_a_at(chip, 0, cycle);
        return;
    }
    if (!(what & CHIP_A_STAYS)) {
        raise_a(chip, 0);
        chip->fall = cycle + PULSE;
    }
    raise_a_at(chip, 1, cycle);
}

static void pass_edges(struct chip *chip)
{
    uint64_t now = chip->avr->cycle;
    while (chip->edge_out != chip->edge_in && chip->edges[chip->edge_out % EDGES].cycle <= now) {
        pass_edge(chip, chip->edges[chip->edge_out % EDGES].cycle, chip->edges[chip->edge_out % EDGES].what);
        chip->edge_out++;
    }
    if (chip->fall && chip->fall <= now) {
        raise_a(chip, 0);
        chip->fall = 0;
    }
}

static void pass_bytes(struct chip *chip)
{
    uint64_t now = chip->avr->cycle;
    while (chip->feed_out != chip->feed_in && chip->feed_next <= now) {
        if (!chip->feed_stopped) {
            avr_raise_irq(chip->input, chip->feed[chip->feed_out++ % BYTES]);
        }
        chip->feed_next += CYCLES_PER_BYTE;
    }
}

static avr_cycle_count_t on_timer(avr_t *avr, avr_cycle_count_t when, void *param)
{
    struct chip *chip = param;
    (void)when;
    pass_edges(chip);
    pass_bytes(chip);
    uint64_t next = next_event(chip);
    return next > avr->cycle ? next : avr->cycle + 1;
}

static void on_byte_out(avr_irq_t *irq, uint32_t value, void *param)
{
    struct chip *chip = param;
    (void)irq;
    if (chip->drain_in - chip->drain_out < BYTES) {
        chip->drain[chip->drain_in % BYTES] = (uint8_t)value;
        chip->drain_cycle[chip->drain_in++ % BYTES] = chip->avr->cycle;
    }
}

static void on_flow(avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    if (value) {
        ((struct chip *)param)->feed_stopped = 1;
    }
}

static void on_flow_again(avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    if (value) {
        ((struct chip *)param)->feed_stopped = 0;
    }
}

void traffic_connect(struct chip *chip)
{
    avr_t *avr = chip->avr;
    const struct layout *at = chip->layout;
    chip->edge = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(at->a.port), at->a.bit);
    chip->edge_too = at->a_too.port ? avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(at->a_too.port), at->a_too.bit) : NULL;
    chip->direction = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(at->b.port), at->b.bit);
    avr_raise_irq(chip->direction, 0);
    drive_lines(chip, 0, 0);
    chip->input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), on_byte_out, chip);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XOFF), on_flow, chip);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XON), on_flow_again, chip);
}

size_t chip_edges(struct chip *chip, uint64_t after, const uint64_t *cycles, const uint8_t *what, size_t count)
{
    size_t added = 0;
    while (chip->edge_in != chip->edge_out && chip->edges[(chip->edge_in - 1) % EDGES].cycle > after) {
        chip->edge_in--;
    }
    for (; added < count && chip->edge_in - chip->edge_out < EDGES; added++) {
        chip->edges[chip->edge_in % EDGES].cycle = cycles[added];
        chip->edges[chip->edge_in++ % EDGES].what = what[added];
    }
    return added;
}

size_t chip_feed(struct chip *chip, const uint8_t *bytes, size_t count)
{
    size_t added = 0;
    if (chip->feed_in == chip->feed_out && chip->feed_next < chip->avr->cycle) {
        chip->feed_next = chip->avr->cycle;
    }
    for (; added < count && chip->feed_in - chip->feed_out < BYTES; added++) {
        chip->feed[chip->feed_in++ % BYTES] = bytes[added];
    }
    return added;
}

size_t chip_drain(struct chip *chip, uint8_t *bytes, uint64_t *cycles, size_t room)
{
    size_t taken = 0;
    for (; taken < room && chip->drain_out != chip->drain_in; taken++) {
        bytes[taken] = chip->drain[chip->drain_out % BYTES];
        cycles[taken] = chip->drain_cycle[chip->drain_out++ % BYTES];
    }
    return taken;
}
