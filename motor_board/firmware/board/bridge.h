/* The pins of the H-bridge: D3 (OC2B) its enable or PWM input, D5 (OC0B) and D6 (OC0A) its two direction inputs. */
#ifndef BRIDGE_H
#define BRIDGE_H

#include <stdint.h>

#define BRIDGE_TOP 256 /* duty of full voltage */

/* All pins low, timers ready. */
void bridge_start(void);

/* Drives at duty/256 of full voltage. From 0 and through a reversal it acts at once, otherwise from the next PWM period
 * on (128 us). */
void bridge_write(int16_t duty, uint8_t decay);

#endif
