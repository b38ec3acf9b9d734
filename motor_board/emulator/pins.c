/* What the pins of the bridge and of the encoder are set to. */
#include "inside.h"

static int is_high(const uint8_t *data, struct pin pin)
{
    return data[pin.out] >> pin.bit & 1;
}

static int is_driven(const uint8_t *data, struct pin pin)
{
    return data[pin.ddr] >> pin.bit & 1;
}

/* counts: of a period of the timer that pulses the pin */
static uint16_t level(const uint8_t *data, const struct pulsed_pin *at, int counts)
{
    if (!is_driven(data, at->pin)) {
        return 0;
    }
    if (data[at->mode] & at->connected) {
        int high = data[at->compare] + 1 > counts ? counts : data[at->compare] + 1;
        high = data[at->mode] & at->connected >> 1 ? counts - high : high; /* inverting */
        return (uint16_t)((high * 256 + counts / 2) / counts);
    }
    return is_high(data, at->pin) ? 256 : 0;
}

struct chip_pins chip_pins(const struct chip *chip)
{
    const uint8_t *data = chip->avr->data;
    const struct layout *at = chip->layout;
    return (struct chip_pins){
        .enable = level(data, &at->enable, data[at->top_control] & at->top_bits ? data[at->top] + 1 : 256),
        .forward = level(data, &at->forward, 256),
        .reverse = level(data, &at->reverse, 256),
    };
}

static int is_pulled_up(const uint8_t *data, struct pin pin)
{
    return !is_driven(data, pin) && is_high(data, pin);
}

int chip_pull_ups(const struct chip *chip)
{
    const uint8_t *data = chip->avr->data;
    return is_pulled_up(data, chip->layout->a) | is_pulled_up(data, chip->layout->b) << 1;
}
