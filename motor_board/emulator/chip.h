/* An ATmega328P or ATmega2560 that runs the firmware's ELF, in lockstep with whoever calls: libsimavr behind a few plain functions.
 *
 * Time is counted in clock cycles (16 MHz) since power-up and goes on through resets. */
#ifndef CHIP_H
#define CHIP_H

#include <stddef.h>
#include <stdint.h>

struct chip;

/* Why chip_run came back. */
enum { CHIP_REACHED, CHIP_OUTPUT_CHANGED, CHIP_CRASHED };

/* Mean level of the bridge's pins in 1/256. An undriven pin counts as low (the bridge pulls it down). */
struct chip_pins {
    uint16_t enable, forward, reverse;
};

/* What the interrupts of one vector cost: cycles from the vector to the return without those of nested interrupts, and
 * the longest that one was waited for. */
struct chip_load {
    uint64_t calls, cycles, longest, waited;
};

/* The chip that the program is for; 0 if the file cannot be read or is for none that is emulated. */
struct chip *chip_open(const char *elf);
void chip_close(struct chip *chip);

/* As the compiler calls it. */
const char *chip_name(const struct chip *chip);

uint64_t chip_cycle(const struct chip *chip);

/* Runs until a cycle (at most 5 beyond it), or until the pins have changed. */
int chip_run(struct chip *chip, uint64_t until);

struct chip_pins chip_pins(const struct chip *chip);

/* The cycle at which the program last wrote to the pins' registers: some 80 before chip_run comes back for it. */
uint64_t chip_written(const struct chip *chip);

/* What the encoder's lines do: channel B is high or low, and channel A rises for a moment, rises, falls, or
 * stays as it is. */
enum { CHIP_B_HIGH = 1, CHIP_A_STAYS = 2, CHIP_A_FALLS = 4, CHIP_B_ALONE = 8 };

/* Forgets edges later than `after` and adds these, ascending, with what happens there. Each is seen by the capture unit
 * at exactly its cycle. Returns how many there was room for. */
size_t chip_edges(struct chip *chip, uint64_t after, const uint64_t *cycles, const uint8_t *what, size_t count);

/* Whether the program has switched on the pull-ups of A (bit 0) and B (bit 1). */
int chip_pull_ups(const struct chip *chip);

/* Bytes for the serial port's input; returns how many there was room for. They go in at the baud rate. */
size_t chip_feed(struct chip *chip, const uint8_t *bytes, size_t count);

/* Bytes that the serial port has put out, with the cycle at which each began. */
size_t chip_drain(struct chip *chip, uint8_t *bytes, uint64_t *cycles, size_t room);

/* What the reset button does. Bytes on their way in are lost. */
void chip_reset(struct chip *chip);

/* Power was off, or fell so low that the chip forgot what it knew; the EEPROM did not. */
void chip_power_up(struct chip *chip);

/* How often the chip was reset since power-up, for whatever reason. */
uint32_t chip_resets(const struct chip *chip);

/* The cycle at which the program last started its clock, which counts from 0 there. */
uint64_t chip_clock_zero(const struct chip *chip);

/* [mV] at the supply input A0, 0 to 5000. */
void chip_supply(struct chip *chip, uint32_t millivolts);

/* The cycle at which the program began to convert A1 since the last call, or 0: chip_run has come back for it, and
 * chip_sense says what is on A1 [mV] before the conversion is over. */
uint64_t chip_sensing(struct chip *chip);
void chip_sense(struct chip *chip, uint32_t millivolts);

/* What a fault could do, and only the watchdog ends: an endless loop with interrupts off or on, or a program that runs
 * on without its sample tick. */
enum { CHIP_HALTED, CHIP_LOOPING, CHIP_TICKLESS };
void chip_hang(struct chip *chip, int how);

#define CHIP_VECTORS 64

/* Interrupt load by vector number, and the cycles that the program slept; all since the last call. */
uint64_t chip_load(struct chip *chip, struct chip_load loads[CHIP_VECTORS]);

#endif
