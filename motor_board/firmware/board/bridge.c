#include "bridge.h"

#include <avr/io.h>

#include "config.h"
#include "wire.h"

#define ENABLE _BV(PD3)  /* D3, OC2B */
#define FORWARD _BV(PD5) /* D5, OC0B */
#define REVERSE _BV(PD6) /* D6, OC0A */
#define INPUTS (FORWARD | REVERSE)

#define FAST_PWM_0 (_BV(WGM01) | _BV(WGM00)) /* mode 3: 0 … 255 */
#define FAST_PWM_2 (_BV(WGM21) | _BV(WGM20))
#define CLOCK_0 _BV(CS01) /* 2 MHz: PWM at 7.8 kHz, which an L298N follows */
#define CLOCK_2 _BV(CS21)
#define SILENT_0 _BV(CS00)              /* 16 MHz: 62.5 kHz; the timer has no other above hearing with two outputs */
#define SILENT_2 (_BV(WGM22) | _BV(CS21)) /* mode 7: 2 MHz / 100 = 20 kHz */
#define SILENT_COUNTS_2 100

/* In the off part of a period the bridge has its enable low, or both inputs alike; which of the two brakes is the
 * bridge's. */
#if MOTOR_BRIDGE == BRIDGE_L298N
#define PULSES_ENABLE(decay) ((decay) == WIRE_DECAY_COAST)
#define OFF_IS_HIGH(decay) false
#elif MOTOR_BRIDGE == BRIDGE_TB6612
#define PULSES_ENABLE(decay) ((decay) == WIRE_DECAY_BRAKE)
#define OFF_IS_HIGH(decay) false
#elif MOTOR_BRIDGE == BRIDGE_DRV8871
#define PULSES_ENABLE(decay) false
#define OFF_IS_HIGH(decay) ((decay) == WIRE_DECAY_BRAKE)
#else
#error "MOTOR_BRIDGE in config.h is none of BRIDGE_L298N, BRIDGE_TB6612 and BRIDGE_DRV8871"
#endif

static bool backward;

static enum { NO_PULSE, PULSE_ON_0, PULSE_ON_2 } pulse; /* the timer that makes pulses slow enough to hit their middle */
static uint8_t middle;                                  /* its count there */

#define EARLY 32  /* [0.5 us] the converter holds its input 12 to 20 us after it was started */
#define WINDOW 32 /* [0.5 us] in which an edge's interrupt may come between */

void bridge_start(void)
{
    PORTD &= (uint8_t)~(ENABLE | INPUTS);
    DDRD |= ENABLE | INPUTS;
    TCCR0A = FAST_PWM_0;
    TCCR2A = FAST_PWM_2;
    TCCR2B = CLOCK_2;
    OCR2A = SILENT_COUNTS_2 - 1;
}

/* PWM on the enable, inputs say the direction. A compare value of n - 1 is high for n counts; as 0 is high for one, duty
 * 0 is a plain low pin. `anew`: the pin was low or meant something else. The chip takes a compare value over when the
 * next period begins, and until then would pulse with an old one: the last count of a period makes one begin now. */
static void write_enable(uint8_t compare, bool zero, bool anew, bool silent)
{
    TCCR0A = FAST_PWM_0;
    TCCR0B = 0;
    if (zero || anew) {
        TCCR2A = FAST_PWM_2;
    }
    PORTD = (uint8_t)((PORTD & ~(ENABLE | INPUTS)) | (backward ? REVERSE : FORWARD));
    if (!zero) {
        OCR2B = compare;
        if (anew) {
            TCCR2B = silent ? SILENT_2 : CLOCK_2;
            TCNT2 = silent ? SILENT_COUNTS_2 - 1 : 0xFF;
        }
        TCCR2A = FAST_PWM_2 | _BV(COM2B1);
    }
}

/* PWM on one input, the enable high throughout. The other input is low, and the pulsed one high for the duty; or, where
 * both inputs have to be high in the off part, the other one is high and the pulsed one low for the duty. */
static void write_input(uint8_t compare, bool zero, bool anew, bool silent, bool off_is_high)
{
    bool on_d6 = backward != off_is_high;
    TCCR2A = FAST_PWM_2;
    if (zero || anew) {
        TCCR0A = FAST_PWM_0;
        TCCR0B = 0;
    }
    PORTD = (uint8_t)((PORTD & ~INPUTS) | ENABLE | (off_is_high ? INPUTS : 0));
    if (!zero) {
        if (on_d6) {
            OCR0A = compare;
        } else {
            OCR0B = compare;
        }
        if (anew) {
            TCNT0 = 0xFF;
        }
        TCCR0A = (uint8_t)(FAST_PWM_0 | (on_d6 ? _BV(COM0A1) : _BV(COM0B1)) |
                           (off_is_high ? (on_d6 ? _BV(COM0A0) : _BV(COM0B0)) : 0));
        TCCR0B = silent ? SILENT_0 : CLOCK_0;
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
    pulse = duty == 0 || pwm == WIRE_PWM_SILENT ? NO_PULSE : PULSES_ENABLE(decay) ? PULSE_ON_2 : PULSE_ON_0;
    middle = compare / 2;
    if (PULSES_ENABLE(decay)) {
        write_enable(compare, duty == 0, anew, pwm == WIRE_PWM_SILENT);
    } else {
        write_input(compare, duty == 0, anew, pwm == WIRE_PWM_SILENT, OFF_IS_HIGH(decay));
    }
}

bool bridge_in_middle(void)
{
    uint8_t counter = pulse == PULSE_ON_2 ? TCNT2 : TCNT0;
    return pulse == NO_PULSE || (uint8_t)(counter - middle + EARLY) < WINDOW;
}
