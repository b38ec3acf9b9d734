/* What interrupts cost, and how long they wait for each other. */
#include <simavr/sim_interrupts.h>
#include <string.h>

#include "inside.h"

static void on_sleep(avr_t *avr, avr_cycle_count_t cycles)
{
    struct chip *chip = avr->custom.data;
    chip->slept += cycles;
}

static void on_raised(avr_irq_t *irq, uint32_t pending, void *param)
{
    struct chip *chip = param;
    if (pending) {
        chip->raised[irq->irq / 256] = chip->avr->cycle;
    }
}

static void enter(struct chip *chip, unsigned vector)
{
    struct chip_load *load = &chip->loads[vector];
    uint64_t now = chip->avr->cycle, waited = now - chip->raised[vector];
    load->waited = waited > load->waited ? waited : load->waited;
    chip->running[chip->depth].vector = vector;
    chip->running[chip->depth].entered = now;
    chip->running[chip->depth].nested = 0;
    chip->depth++;
}

static void leave(struct chip *chip)
{
    unsigned depth = --chip->depth;
    struct chip_load *load = &chip->loads[chip->running[depth].vector];
    uint64_t whole = chip->avr->cycle - chip->running[depth].entered, own = whole - chip->running[depth].nested;
    load->calls++;
    load->cycles += own;
    load->longest = own > load->longest ? own : load->longest;
    if (depth > 0) {
        chip->running[depth - 1].nested += whole;
    }
}

static void on_interrupt(avr_irq_t *irq, uint32_t running, void *param)
{
    struct chip *chip = param;
    if (running && chip->depth < VECTORS) {
        enter(chip, (unsigned)irq->irq / 256);
    } else if (!running && chip->depth > 0) {
        leave(chip);
    }
}

void load_connect(struct chip *chip)
{
    chip->avr->sleep = on_sleep;
    for (uint8_t vector = 1; vector < VECTORS; vector++) {
        avr_irq_t *irq = avr_get_interrupt_irq(chip->avr, vector);
        if (irq) {
            avr_irq_register_notify(irq + AVR_INT_IRQ_PENDING, on_raised, chip);
            avr_irq_register_notify(irq + AVR_INT_IRQ_RUNNING, on_interrupt, chip);
        }
    }
}

uint64_t chip_load(struct chip *chip, struct chip_load loads[VECTORS])
{
    uint64_t slept = chip->slept;
    memcpy(loads, chip->loads, sizeof chip->loads);
    memset(chip->loads, 0, sizeof chip->loads);
    chip->slept = 0;
    return slept;
}
