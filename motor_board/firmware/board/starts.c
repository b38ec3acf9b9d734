/* The number of a start outlives a power-down, in the EEPROM: the memory of a chip wakes up with nearly the same contents
 * each time, and a recording of the serial line that begins with an enable would be obeyed again after it. */
#include "starts.h"

#include <avr/eeprom.h>

#define CELLS 64u /* a cell bears 100,000 writes: so many starts times that */
#define TURN 128u /* the number at which a round is counted: a chip that was erased begins with 0 and in round 0 */
#define ERASED 0xFFu
#define CELL(start) (&cells[(start) % CELLS])

static uint8_t cells[CELLS] EEMEM; /* each start is written to the cell of its number */
static uint8_t rounds EEMEM = ERASED; /* of 256 starts, from ERASED down */

uint16_t starts_next(void)
{
    uint8_t latest = eeprom_read_byte(&cells[0]), next = (uint8_t)(latest + 1u);
    for (uint8_t k = 0; k < CELLS && eeprom_read_byte(CELL(next)) == next; k++) {
        next++;
    }
    uint8_t left = eeprom_read_byte(&rounds);
    if (next == TURN) {
        eeprom_update_byte(&rounds, --left); /* first: who loses power in between skips a round, and repeats none */
    }
    eeprom_update_byte(CELL(next), next); /* nothing waits for it: who loses power before has heard of no start */
    return (uint16_t)((uint8_t)(ERASED - left) << 8 | next);
}
