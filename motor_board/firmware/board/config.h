/* What differs from set-up to set-up; `ros2 run motor_board flash` sets these, in the Arduino IDE edit them here. */
#ifndef CONFIG_H
#define CONFIG_H

#define BRIDGE_L298N 1  /* enable low: coasts; both inputs alike: brakes */
#define BRIDGE_TB6612 2 /* PWM low: brakes; both inputs low: coasts */
#define BRIDGE_DRV8871 3 /* no enable; both inputs high: brakes; both low: coasts */

#ifndef MOTOR_BRIDGE
#define MOTOR_BRIDGE BRIDGE_L298N
#endif

#ifndef MOTOR_BOARD_ID
#define MOTOR_BOARD_ID 0 /* which of several boards, 0 … 65535 */
#endif

#ifndef MOTOR_EDGES_PER_REVOLUTION
#define MOTOR_EDGES_PER_REVOLUTION 0 /* of one polarity; 0: not known here */
#endif

#ifndef MOTOR_CHANNELS
#define MOTOR_CHANNELS 1 /* 2: the second encoder channel is connected and tells the direction; the driver may have both counted */
#endif

#ifndef MOTOR_SUPPLY_FULL_SCALE
#define MOTOR_SUPPLY_FULL_SCALE 0 /* [mV] of the motor's supply that put 5 V on A0 through the divider; 0: not measured */
#endif

#ifndef MOTOR_CURRENT_SENSE
#define MOTOR_CURRENT_SENSE 0 /* 1: A1 has a voltage that follows the motor's current; the driver knows its gain and zero */
#endif

#endif
