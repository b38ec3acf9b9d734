/* The chip itself: its program, its pins, its resets. */
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_interrupts.h>
#include <stdlib.h>
#include <string.h>

#include "inside.h"

#define FREQUENCY 16000000
#define MCUSR 0x54
#define POWER_ON_RESET 0x01
#define EXTERNAL_RESET 0x02
#define SETTLE 80         /* cycles from the first change of a pin to the last one of the same write */
#define RUN_LIMIT 1000000 /* cycles that simavr may run without looking up; falls back to 1 at every reset */

static void touch(struct chip *chip)
{
    chip->written = chip->avr->cycle;
    if (!chip->settle) {
        chip->settle = chip->avr->cycle + SETTLE;
        traffic_arm(chip);
    }
}

static void on_pin(avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)value;
    touch(param);
}

static void on_register(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)avr;
    (void)address;
    (void)value;
    touch(param);
}

static void on_clock_start(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)address;
    struct chip *chip = param;
    if (value & 7 && !chip->clocked) {
        chip->clock_zero = avr->cycle;
        chip->clocked = 1;
    }
}

/* A flag that is up when its interrupt is let on interrupts then. simavr only looks when the flag rises: a tick that was due
 * while the tick before it kept itself off came a whole turn of the counter later. */
static void on_interrupts_chosen(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)param;
    avr->data[address] = value;
    for (int i = 0; i < avr->interrupts.vector_count; i++) {
        avr_int_vector_t *vector = avr->interrupts.vector[i];
        if (vector->enable.reg == address && avr_regbit_get(avr, vector->raised)) {
            avr_raise_interrupt(avr, vector); /* which does nothing where it is off, or pending already */
        }
    }
}

/* A conversion has begun: whoever knows the current is asked for it. */
static void on_conversion(avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    union {
        uint32_t value;
        avr_adc_mux_t mux;
    } what = {.value = value};
    struct chip *chip = param;
    if (what.mux.kind == ADC_MUX_SINGLE && what.mux.src == 1) {
        chip->sensing = chip->avr->cycle;
        if (!chip->settle) {
            chip->settle = chip->avr->cycle + 1; /* ends the run; the pins are as they were */
            traffic_arm(chip);
        }
    }
}

/* A reset wipes all cycle timers, ours too. */
static void on_reset(avr_io_t *io)
{
    struct chip *chip = (struct chip *)((char *)io - offsetof(struct chip, io));
    chip->resets++;
    chip->avr->run_cycle_limit = RUN_LIMIT;
    chip->feed_stopped = 0;
    chip->clocked = 0;
    chip->settle = 0;
    chip->depth = 0;
    touch(chip);
}

/* simavr tells of two compare registers of a timer; the third has to be watched like a mode register, of which it lets four
 * be watched by somebody besides itself. */
static void watch_output(struct chip *chip, const struct pulsed_pin *at)
{
    avr_t *avr = chip->avr;
    avr_irq_t *port = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(at->pin.port), 0);
    avr_irq_register_notify(port + IOPORT_IRQ_REG_PORT, on_pin, chip);
    avr_irq_register_notify(port + IOPORT_IRQ_DIRECTION_ALL, on_pin, chip);
    if (at->pwm < 2) {
        avr_irq_t *timer = avr_io_getirq(avr, AVR_IOCTL_TIMER_GETIRQ(at->timer), TIMER_IRQ_OUT_PWM0 + at->pwm);
        avr_irq_register_notify(timer, on_pin, chip);
    } else {
        avr_register_io_write(avr, at->compare, on_register, chip);
    }
}

static void connect(struct chip *chip)
{
    avr_t *avr = chip->avr;
    uint32_t no_flags = 0;
    chip->supply = avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0);
    chip->sense = avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC1);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER), on_conversion, chip);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &no_flags);
    const struct layout *at = chip->layout;
    watch_output(chip, &at->enable);
    watch_output(chip, &at->forward);
    watch_output(chip, &at->reverse);
    avr_register_io_write(avr, at->enable.mode, on_register, chip);
    avr_register_io_write(avr, at->forward.mode, on_register, chip); /* of the reverse pin, too */
    avr_register_io_write(avr, at->clock_control, on_clock_start, chip);
    avr_register_io_write(avr, at->clock_interrupts, on_interrupts_chosen, chip);
    traffic_connect(chip);
    load_connect(chip);
}

static void be_quiet(avr_t *avr, const int level, const char *format, va_list arguments)
{
    (void)avr;
    (void)level;
    (void)format;
    (void)arguments;
}

struct chip *chip_open(const char *elf)
{
    static elf_firmware_t firmware; /* large, and zeroed */
    struct chip *chip = calloc(1, sizeof *chip);
    avr_global_logger_set(be_quiet);
    memset(&firmware, 0, sizeof firmware);
    const struct layout *layout = layout_of(elf);
    avr_t *avr = chip && layout ? avr_make_mcu_by_name(layout->name) : NULL;
    if (!avr || elf_read_firmware(elf, &firmware) != 0) {
        free(chip);
        return NULL;
    }
    chip->avr = avr;
    chip->layout = layout;
    chip->until = UINT64_MAX / 2;
    avr_init(avr);
    avr->custom.data = chip;
    avr->frequency = FREQUENCY;
    avr->vcc = avr->avcc = avr->aref = 5000;
    avr_load_firmware(avr, &firmware);
    free(firmware.flash);
    avr->frequency = FREQUENCY;
    chip->io.kind = "lockstep";
    chip->io.reset = on_reset;
    avr_register_io(avr, &chip->io);
    connect(chip);
    avr->run_cycle_limit = RUN_LIMIT;
    return chip;
}

void chip_close(struct chip *chip)
{
    /* Our io is part of `chip`: simavr must not free it. */
    avr_io_t **link = &chip->avr->io_port;
    while (*link && *link != &chip->io) {
        link = &(*link)->next;
    }
    if (*link) {
        *link = chip->io.next;
    }
    avr_terminate(chip->avr);
    free(chip->avr);
    free(chip);
}

uint64_t chip_cycle(const struct chip *chip)
{
    return chip->avr->cycle;
}

const char *chip_name(const struct chip *chip)
{
    return chip->layout->name;
}

uint64_t chip_written(const struct chip *chip)
{
    return chip->written;
}

static int pins_changed(struct chip *chip)
{
    struct chip_pins pins = chip_pins(chip), old = chip->pins;
    chip->settle = 0;
    chip->pins = pins;
    return pins.enable != old.enable || pins.forward != old.forward || pins.reverse != old.reverse;
}

int chip_run(struct chip *chip, uint64_t until)
{
    avr_t *avr = chip->avr;
    chip->until = until;
    traffic_arm(chip);
    while (avr->cycle < until) {
        int state = avr_run(avr);
        if (state == cpu_Done || state == cpu_Crashed) {
            return CHIP_CRASHED;
        }
        if (chip->settle && avr->cycle >= chip->settle && pins_changed(chip)) {
            return CHIP_OUTPUT_CHANGED;
        }
        if (chip->sensing && !chip->settle) {
            break;
        }
    }
    return CHIP_REACHED;
}

void chip_reset(struct chip *chip)
{
    avr_t *avr = chip->avr;
    chip->feed_out = chip->feed_in;
    avr_reset(avr);
    avr->data[MCUSR] = EXTERNAL_RESET;
}

void chip_power_up(struct chip *chip)
{
    avr_t *avr = chip->avr;
    memset(avr->data + avr->ioend + 1, 0, avr->ramend - avr->ioend); /* as at the first power-up */
    chip_reset(chip);
    avr->data[MCUSR] = POWER_ON_RESET;
}

uint32_t chip_resets(const struct chip *chip)
{
    return chip->resets;
}

uint64_t chip_clock_zero(const struct chip *chip)
{
    return chip->clock_zero;
}

void chip_hang(struct chip *chip, int how)
{
    avr_t *avr = chip->avr;
    if (how == CHIP_TICKLESS) {
        avr->data[chip->layout->clock_interrupts] &= (uint8_t)~chip->layout->tick_interrupt;
        return;
    }
    avr_flashaddr_t end = avr->flashend - 1;
    avr->flash[end] = 0xFF; /* rjmp to itself */
    avr->flash[end + 1] = 0xCF;
    avr->pc = end;
    avr->state = cpu_Running;
    avr->sreg[S_I] = how == CHIP_LOOPING;
}

void chip_supply(struct chip *chip, uint32_t millivolts)
{
    avr_raise_irq(chip->supply, millivolts);
}

uint64_t chip_sensing(struct chip *chip)
{
    uint64_t cycle = chip->sensing;
    chip->sensing = 0;
    return cycle;
}

void chip_sense(struct chip *chip, uint32_t millivolts)
{
    avr_raise_irq(chip->sense, millivolts);
}
