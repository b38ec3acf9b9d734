/* The motor's current as a voltage on A1, if config.h says that there is one: converted in the middle of a PWM pulse, just
 * before each sample tick. Between that and the next the converter is the supply's. */
#ifndef SENSE_H
#define SENSE_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>

#include "config.h"
#include "supply.h"

#define SENSE_LEAD 700u /* [tick] 350 us before the tick: SENSE_WAIT, and a conversion (112 us) with room for edges */
#define SENSE_WAIT 400u /* [tick] 200 us at most for the middle of a pulse: one comes every 128 us */

#define SENSE_A1 _BV(MUX0) /* beside SUPPLY_A0 */

static inline void sense_start(void)
{
    if (MOTOR_CURRENT_SENSE) {
        ADMUX = SUPPLY_A0 | SENSE_A1;
        ADCSRA = SUPPLY_CONVERTER;
    }
}

static inline bool sense_is_done(void)
{
    return !(ADCSRA & _BV(ADSC));
}

/* At the tick: the current [5 V/1024], if it was converted since the tick before, and a conversion of the supply. */
static inline void sense_take_current(uint16_t *steps)
{
    if (sense_is_done() && (ADMUX & SENSE_A1)) {
        *steps = ADC;
        ADMUX = SUPPLY_A0;
        if (MOTOR_SUPPLY_FULL_SCALE > 0) {
            ADCSRA |= _BV(ADSC);
        }
    }
}

/* Before the tick: the supply [mV], and the converter is free for the current. */
static inline void sense_take_supply(uint16_t *millivolts)
{
    if (MOTOR_SUPPLY_FULL_SCALE > 0 && sense_is_done() && !(ADMUX & SENSE_A1)) {
        *millivolts = supply_converted();
    }
    ADMUX = SUPPLY_A0 | SENSE_A1;
}

static inline void sense_start_current(void)
{
    ADCSRA |= _BV(ADSC);
}

#endif
