/* The pins of the H-bridge: its enable or PWM input, and its two direction inputs. */
#ifndef BRIDGE_H
#define BRIDGE_H

#include <stdbool.h>
#include <stdint.h>

#include "config.h"

#define BRIDGE_TOP 256 /* duty of full voltage */

/* With silent PWM, by decay (brake, coast); 0: not to be had. On the enable it is 20 kHz in 100 steps; on the inputs
 * 62.5 kHz in 256, which an L298N (at most 40 kHz) does not follow. */
#if MOTOR_BRIDGE == BRIDGE_L298N
#define BRIDGE_SILENT_TOP {0, 100}
#elif MOTOR_BRIDGE == BRIDGE_TB6612
#define BRIDGE_SILENT_TOP {100, 256}
#else
#define BRIDGE_SILENT_TOP {256, 256}
#endif

/* All pins low, timers ready. */
void bridge_start(void);

/* Drives at this duty, of BRIDGE_TOP or what silent PWM has. From 0 and through a reversal it acts at once, otherwise from the next PWM period
 * on (128 us; 50 us or 16 us with silent PWM). */
void bridge_write(int16_t duty, uint8_t decay, uint8_t pwm);

/* Whether a conversion that is started now holds its input in the middle of a pulse; always, where there is none or it
 * is too short to be hit (silent PWM). `phase` begins as 0: one that an interrupt let pass since the last call counts, too. */
bool bridge_in_middle(uint8_t *phase);

#endif
