#include "output.h"

/* Numbers wrap: so many are newer than one, the others older. More frames than that come in no LONGEST_TIMEOUT, after
 * which the output is off: what is farther ahead was sent long before. */
#define AHEAD 2048u

void output_off(struct output *output)
{
    output->on = false;
    output->timed_out = false;
    output->newest = 0;
    output->latch++;
}

void output_enable(struct output *output, const struct wire_enable *frame, uint16_t seq, uint32_t now)
{
    if (frame->on != 1) {
        output_off(output);
    } else if (!output->on && frame->boot == output->boot && frame->latch == output->latch) {
        output->on = true;
        output->timed_out = false;
        output->command = seq;
        output->heard = now;
    }
}

void output_command(struct output *output, const struct wire_command *frame, uint16_t seq, uint32_t now)
{
    if (output->on && (uint16_t)(seq - output->command - 1u) >= AHEAD) {
        return; /* sent before: what is repeated, or somebody else's */
    }
    output->command = seq;
    output->heard = now;
    if (output->on) {
        int16_t top = output->top;
        output->newest = frame->duty > top ? top : frame->duty < -top ? (int16_t)-top : frame->duty;
    }
}

void output_check(struct output *output, uint32_t now)
{
    uint32_t silence = now - output->heard;
    if (output->on && silence > output->timeout && silence < 0x80000000u) { /* a command after `now` is no silence */
        output_off(output);
        output->timed_out = true;
    }
}

void output_latch(struct output *output)
{
    output->duty = output->on ? output->newest : 0;
}
