/* The chips that can be emulated; addresses in data space, as in the data sheets' register summaries. */
#include "layout.h"

#include <stdio.h>

#define PORT(letter, address, bit) {letter, (address) + 1, (address) + 2, bit} /* PIN, DDR and PORT follow each other */

static const struct layout layouts[] = {
    {
        .name = "atmega328p",
        .machine = 5,                                 /* avr5 */
        .a = PORT('B', 0x23, 0),                      /* D8, ICP1 */
        .b = PORT('D', 0x29, 7),                      /* D7 */
        .enable = {PORT('D', 0x29, 3), '2', 1, 0xB0, 0xB4, 0x20},  /* D3, OC2B */
        .forward = {PORT('D', 0x29, 5), '0', 1, 0x44, 0x48, 0x20}, /* D5, OC0B */
        .reverse = {PORT('D', 0x29, 6), '0', 0, 0x44, 0x47, 0x80}, /* D6, OC0A */
        .top_control = 0xB1,                          /* TCCR2B */
        .top_bits = 0x08,                             /* WGM22 */
        .top = 0xB3,                                  /* OCR2A */
        .clock_control = 0x81,                        /* TCCR1B */
        .clock_interrupts = 0x6F,                     /* TIMSK1 */
        .tick_interrupt = 0x02,                       /* OCIE1A */
    },
    {
        .name = "atmega2560",
        .machine = 6,                                  /* avr6 */
        .a = PORT('L', 0x109, 1),                      /* D48, ICP5 */
        .a_too = PORT('D', 0x29, 3),                   /* D18, INT3 */
        .b = PORT('D', 0x29, 2),                       /* D19, INT2 */
        .enable = {PORT('E', 0x2C, 5), '3', 2, 0x90, 0x9C, 0x08},   /* D3, OC3C */
        .forward = {PORT('H', 0x100, 4), '4', 1, 0xA0, 0xAA, 0x20}, /* D7, OC4B */
        .reverse = {PORT('H', 0x100, 3), '4', 0, 0xA0, 0xA8, 0x80}, /* D6, OC4A */
        .top_control = 0x91,                           /* TCCR3B */
        .top_bits = 0x10,                              /* WGM33 */
        .top = 0x98,                                   /* OCR3A */
        .clock_control = 0x121,                        /* TCCR5B */
        .clock_interrupts = 0x73,                      /* TIMSK5 */
        .tick_interrupt = 0x02,                        /* OCIE5A */
    },
};

const struct layout *layout_of(const char *elf)
{
    enum { FLAGS = 0x24, MACHINE = 0x7F }; /* of the header of an ELF file of 32 bits */
    FILE *file = fopen(elf, "rb");
    int flags = file && fseek(file, FLAGS, SEEK_SET) == 0 ? fgetc(file) : EOF;
    if (file) {
        fclose(file);
    }
    for (unsigned i = 0; flags != EOF && i < sizeof layouts / sizeof *layouts; i++) {
        if (layouts[i].machine == ((unsigned)flags & MACHINE)) {
            return &layouts[i];
        }
    }
    return 0;
}
