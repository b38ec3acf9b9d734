#include "bridge.h"

#include "config.h"
#include "registers.h"
#include "wire.h"

#define INPUTS (FORWARD | REVERSE)
#define SILENT_COUNTS 100 /* 2 MHz / 100 = 20 kHz on the enable */

/* In the off part of a period the bridge has its enable low, or both inputs alike; which of the two brakes is the
 * bridge's. At duty 0 both inputs are alike whatever is pulsed, so that an enable that is stuck or shorted is not full
 * voltage; where inputs are pulsed the enable is high, and an input that is stuck is. ZERO_IS_HIGH: which level that
 * is, where the enable is pulsed. Both inputs high brake a TB6612FNG, as its PWM low does; both low are open on an L298N
 * with its enable low. */
#if MOTOR_BRIDGE == BRIDGE_L298N
#define PULSES_ENABLE(decay) ((decay) == WIRE_DECAY_COAST)
#define OFF_IS_HIGH(decay) false
#define ZERO_IS_HIGH false
#elif MOTOR_BRIDGE == BRIDGE_TB6612
#define PULSES_ENABLE(decay) ((decay) == WIRE_DECAY_BRAKE)
#define OFF_IS_HIGH(decay) false
#define ZERO_IS_HIGH true
#elif MOTOR_BRIDGE == BRIDGE_DRV8871
#define PULSES_ENABLE(decay) false
#define OFF_IS_HIGH(decay) ((decay) == WIRE_DECAY_BRAKE)
#define ZERO_IS_HIGH false /* it has no enable to pulse */
#else
#error "MOTOR_BRIDGE in config.h is none of BRIDGE_L298N, BRIDGE_TB6612 and BRIDGE_DRV8871"
#endif

static bool backward;

static enum { NO_PULSE, PULSE_ON_INPUT, PULSE_ON_ENABLE } pulse; /* the timer that makes pulses slow enough to hit their middle */
static uint8_t middle;                                  /* its count there */

#define EARLY 32  /* [0.5 us] the converter holds its input 12 to 20 us after it was started */
#define WINDOW 32 /* [0.5 us] in which an edge's interrupt may come between */

void bridge_start(void)
{
    pins_start();
    INPUT_MODE = INPUT_FAST;
    ENABLE_MODE = ENABLE_FAST;
    ENABLE_CONTROL = ENABLE_RUN;
    ENABLE_TOP = SILENT_COUNTS - 1;
}

/* PWM on the enable, inputs say the direction, and at duty 0 none. A compare value of n - 1 is high for n counts; as 0
 * is high for one, duty 0 is a plain low pin. `anew`: the pin was low or meant something else. The chip takes a compare
 * value over when the next period begins, and until then would pulse with an old one: the last count of a period makes
 * one begin now. */
static void write_enable(uint8_t compare, bool zero, bool anew, bool silent)
{
    uint8_t mode = silent ? ENABLE_SILENT : ENABLE_FAST;
    INPUT_MODE = INPUT_FAST;
    INPUT_CONTROL = INPUT_STOP;
    if (zero || anew) {
        ENABLE_MODE = mode;
    }
    pins_write(false, zero ? (ZERO_IS_HIGH ? INPUTS : 0) : backward ? REVERSE : FORWARD);
    if (!zero) {
        ENABLE_COMPARE = compare;
        if (anew) {
            ENABLE_CONTROL = silent ? ENABLE_RUN_SILENT : ENABLE_RUN;
            ENABLE_COUNTER = silent ? SILENT_COUNTS - 1 : 0xFF;
        }
        ENABLE_MODE = (uint8_t)(mode | ENABLE_PULSED);
    }
}

/* PWM on one input, the enable high throughout. The other input is low, and the pulsed one high for the duty; or, where
 * both inputs have to be high in the off part, the other one is high and the pulsed one low for the duty. */
static void write_input(uint8_t compare, bool zero, bool anew, bool silent, bool off_is_high)
{
    bool on_reverse = backward != off_is_high;
    ENABLE_MODE = ENABLE_FAST;
    if (zero || anew) {
        INPUT_MODE = INPUT_FAST;
        INPUT_CONTROL = INPUT_STOP;
    }
    pins_write(true, off_is_high ? INPUTS : 0);
    if (!zero) {
        if (on_reverse) {
            INPUT_REVERSE = compare;
        } else {
            INPUT_FORWARD = compare;
        }
        if (anew) {
            INPUT_COUNTER = 0xFF;
        }
        uint8_t pulsed = on_reverse ? INPUT_REVERSE_PULSED : INPUT_FORWARD_PULSED;
        uint8_t inverted = on_reverse ? INPUT_REVERSE_INVERTED : INPUT_FORWARD_INVERTED;
        INPUT_MODE = (uint8_t)(INPUT_FAST | pulsed | (off_is_high ? inverted : 0));
        INPUT_CONTROL = silent ? INPUT_RUN_SILENT : INPUT_RUN;
    }
}

void bridge_write(int16_t duty, uint8_t decay, uint8_t pwm)
{
    static int16_t before;
    static uint8_t decay_before = 0xFF, pwm_before;
    if (duty == before && decay == decay_before && pwm == pwm_before) {
        return;
    }
    bool anew = before == 0 || (duty < 0) != backward || decay != decay_before || pwm != pwm_before;
    if (duty != 0) {
        backward = duty < 0;
    }
    before = duty;
    decay_before = decay;
    pwm_before = pwm;
    uint8_t compare = (uint8_t)((duty < 0 ? -duty : duty) - 1);
    pulse = duty == 0 || pwm == WIRE_PWM_SILENT ? NO_PULSE : PULSES_ENABLE(decay) ? PULSE_ON_ENABLE : PULSE_ON_INPUT;
    middle = compare / 2;
    if (PULSES_ENABLE(decay)) {
        write_enable(compare, duty == 0, anew, pwm == WIRE_PWM_SILENT);
    } else {
        write_input(compare, duty == 0, anew, pwm == WIRE_PWM_SILENT, OFF_IS_HIGH(decay));
    }
}

bool bridge_in_middle(uint8_t *phase)
{
    uint8_t counter = (uint8_t)(pulse == PULSE_ON_ENABLE ? ENABLE_COUNTER : INPUT_COUNTER), before = *phase;
    *phase = (uint8_t)(counter - middle + EARLY);
    return pulse == NO_PULSE || *phase < WINDOW || *phase < before;
}
