/* Where on a chip is what the outside of it has to do with. */
#ifndef LAYOUT_H
#define LAYOUT_H

#include <stdint.h>

/* A pin: its port's letter, the addresses of that port's direction and output registers, and its bit. */
struct pin {
    char port;
    uint16_t ddr, out;
    uint8_t bit;
};

/* A pin of the bridge, with the timer that may pulse it: its number, which of its outputs (0: A) the pin is, the addresses of
 * its mode register and of the output's compare register, and the bit that connects the pin (the next lower one inverts). */
struct pulsed_pin {
    struct pin pin;
    char timer;
    int pwm;
    uint16_t mode, compare;
    uint8_t connected;
};

struct layout {
    const char *name;
    unsigned machine; /* in the flags of an ELF file for it */
    struct pin a, a_too, b; /* of the encoder; a_too: joined to A, port 0: there is none */
    struct pulsed_pin enable, forward, reverse;
    uint16_t top_control, top; /* where top_bits are set in the control register, the enable's timer counts to top */
    uint8_t top_bits;
    uint16_t clock_control, clock_interrupts; /* of the timer that is the program's clock */
    uint8_t tick_interrupt;
};

/* The layout of the chip that an ELF file is for; 0 if it is for none of them. */
const struct layout *layout_of(const char *elf);

#endif
