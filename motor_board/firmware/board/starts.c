/* The number of a start outlives a power-down, in the EEPROM: the memory of a chip wakes up with nearly the same contents
 * each time, and a recording of the serial line that begins with an enable would be obeyed again after it. */
#include "starts.h"

#include <avr/eeprom.h>

#define CELLS 64u /* a cell bears 100,000 writes: so many starts times that */
#define CELL(start) (&cells[(start) % CELLS])

static uint8_t cells[CELLS] EEMEM; /* each start is written to the cell of its number */

uint8_t starts_next(void)
{
    uint8_t latest = eeprom_read_byte(&cells[0]), next = (uint8_t)(latest + 1u);
    for (uint8_t k = 0; k < CELLS && eeprom_read_byte(CELL(next)) == next; k++) {
        next++;
    }
    eeprom_update_byte(CELL(next), next); /* nothing waits for it: who loses power before has heard of no start */
    return next;
}
