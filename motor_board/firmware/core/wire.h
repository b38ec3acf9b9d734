/* Generated from protocol/wire.yaml by `python -m motor_board.wire_header`; do not edit. */
#ifndef WIRE_H
#define WIRE_H

#include <stdint.h>

#define WIRE_VERSION 1u
#define WIRE_BAUD 500000UL
#define WIRE_LONGEST_FRAME 48u /* byte, the closing zero included */

#define WIRE_PWM_STANDARD 0u
#define WIRE_PWM_SILENT 1u

#define WIRE_DECAY_BRAKE 0u
#define WIRE_DECAY_COAST 1u

#define WIRE_BOARD_ATMEGA328P 1u
#define WIRE_BOARD_ATMEGA2560 2u

#define WIRE_FLAG_ENABLED 1u
#define WIRE_FLAG_TIMED_OUT 2u
#define WIRE_FLAG_EDGE_VALID 4u
#define WIRE_FLAG_REVERSE 8u
#define WIRE_FLAG_TWO_CHANNELS 16u
#define WIRE_FLAG_OVERCURRENT 32u
#define WIRE_FLAG_CURRENT_UNKNOWN 64u

#define WIRE_RESET_CAUSE_POWER_ON 1u
#define WIRE_RESET_CAUSE_EXTERNAL 2u
#define WIRE_RESET_CAUSE_BROWN_OUT 4u
#define WIRE_RESET_CAUSE_WATCHDOG 8u

static inline uint8_t *wire_put_u8(uint8_t *at, uint8_t value) { *at = value; return at + 1; }
static inline uint8_t *wire_put_u16(uint8_t *at, uint16_t value)
{ return wire_put_u8(wire_put_u8(at, (uint8_t)value), (uint8_t)(value >> 8)); }
static inline uint8_t *wire_put_u32(uint8_t *at, uint32_t value)
{ return wire_put_u16(wire_put_u16(at, (uint16_t)value), (uint16_t)(value >> 16)); }
static inline uint8_t *wire_put_i16(uint8_t *at, int16_t value) { return wire_put_u16(at, (uint16_t)value); }

static inline uint8_t wire_get_u8(const uint8_t *at) { return at[0]; }
static inline uint16_t wire_get_u16(const uint8_t *at) { return (uint16_t)(at[0] | (uint16_t)((uint16_t)at[1] << 8)); }
static inline uint32_t wire_get_u32(const uint8_t *at)
{ return (uint32_t)wire_get_u16(at) | (uint32_t)wire_get_u16(at + 2) << 16; }
static inline int16_t wire_get_i16(const uint8_t *at) { return (int16_t)wire_get_u16(at); }

/* From the host: asks for a hello. */
#define WIRE_IDENTIFY 0x01u
#define WIRE_IDENTIFY_SIZE 0u /* byte of body */

/* From the host: switches the output off, sets how the board samples and drives, and is answered by a hello with what holds now (the one that follows a reset may come before it). */
#define WIRE_CONFIGURE 0x02u
#define WIRE_CONFIGURE_SIZE 7u /* byte of body */
struct wire_configure {
    uint32_t sample_period; /* [tick] between sample ticks; limited to shortest_period … 2^24 */
    uint16_t command_timeout; /* [ms] limited to 10 … 1000 */
    uint8_t decay; /* what the bridge does in the off part of a PWM period */
};
static inline void wire_get_configure(const uint8_t *at, struct wire_configure *frame)
{
    frame->sample_period = wire_get_u32(at + 0);
    frame->command_timeout = wire_get_u16(at + 4);
    frame->decay = wire_get_u8(at + 6);
}

/* From the host: switches the output off, sets how edges are counted and how fast the PWM runs (the latter from the next configure on), and is answered by features; since firmware 1.2. */
#define WIRE_SETUP 0x06u
#define WIRE_SETUP_SIZE 2u /* byte of body */
struct wire_setup {
    uint8_t quadrature; /* edges counted in a period of channel A: 1 (one polarity of A), 2 (both of A) or 4 (both of both) */
    uint8_t pwm; /* pwm */
};
static inline void wire_get_setup(const uint8_t *at, struct wire_setup *frame)
{
    frame->quadrature = wire_get_u8(at + 0);
    frame->pwm = wire_get_u8(at + 1);
}

/* From the host: switches the output off, sets which current of the motor switches it off, and is answered by protection; since firmware 1.4. */
#define WIRE_PROTECT 0x07u
#define WIRE_PROTECT_SIZE 10u /* byte of body */
struct wire_protect {
    uint16_t zero; /* [5 V/1024] at A1 without a current */
    uint16_t most; /* [5 V/1024] beside zero, either way: two samples in a row above it switch off, and ten without a conversion; 0: none does */
    uint16_t rated; /* [5 V/1024] beside zero; what lasts */
    uint32_t budget; /* sum over samples of (current^2/64 - rated^2/64) x sample_period/64 tick, never below 0, that switches off */
};
static inline void wire_get_protect(const uint8_t *at, struct wire_protect *frame)
{
    frame->zero = wire_get_u16(at + 0);
    frame->most = wire_get_u16(at + 2);
    frame->rated = wire_get_u16(at + 4);
    frame->budget = wire_get_u32(at + 6);
}

/* From the host: switches the output on (rule 3) or off. */
#define WIRE_ENABLE 0x03u
#define WIRE_ENABLE_SIZE 3u /* byte of body */
struct wire_enable {
    uint8_t on; /* 1: on, 0: off */
    uint8_t boot; /* of the latest telemetry or hello; not looked at when switching off */
    uint8_t latch; /* likewise */
};
static inline void wire_get_enable(const uint8_t *at, struct wire_enable *frame)
{
    frame->on = wire_get_u8(at + 0);
    frame->boot = wire_get_u8(at + 1);
    frame->latch = wire_get_u8(at + 2);
}

/* From the host: the duty to latch at the next sample tick. */
#define WIRE_COMMAND 0x04u
#define WIRE_COMMAND_SIZE 2u /* byte of body */
struct wire_command {
    int16_t duty; /* [1/pwm_top] signed, limited to ±pwm_top; positive drives forward */
};
static inline void wire_get_command(const uint8_t *at, struct wire_command *frame)
{
    frame->duty = wire_get_i16(at + 0);
}

/* From the host: asks for the time. */
#define WIRE_PING 0x05u
#define WIRE_PING_SIZE 4u /* byte of body */
struct wire_ping {
    uint32_t token; /* comes back in the pong */
};
static inline void wire_get_ping(const uint8_t *at, struct wire_ping *frame)
{
    frame->token = wire_get_u32(at + 0);
}

/* From the board: who the board is and how it samples; sent after a reset, as the answer to identify and configure, and to a frame of another version. */
#define WIRE_HELLO 0x81u
#define WIRE_HELLO_SIZE 27u /* byte of body */
struct wire_hello {
    uint8_t firmware_major;
    uint8_t firmware_minor;
    uint8_t firmware_patch;
    uint8_t board; /* board */
    uint16_t board_id; /* which of several; set when flashing, 0 if not */
    uint16_t edges_per_revolution; /* of one polarity; set when flashing, 0: unknown */
    uint8_t channels; /* encoder channels, 1 or 2 */
    uint16_t tick_ns; /* [ns] tick of every time and period */
    uint16_t pwm_top; /* duty of full voltage */
    uint8_t decay; /* decay */
    uint32_t sample_period; /* [tick] */
    uint32_t shortest_period; /* [tick] */
    uint16_t command_timeout; /* [ms] */
    uint8_t reset_cause; /* 0: not known, some bootloaders clear it */
    uint8_t boot; /* resets from an arbitrary start, over power-downs since firmware 1.4.3, wraps */
    uint8_t latch; /* times the output was switched off since the reset, from a start that changes as `boot` wraps; wraps */
};
static inline uint8_t *wire_put_hello(uint8_t *at, const struct wire_hello *frame)
{
    at = wire_put_u8(at, frame->firmware_major);
    at = wire_put_u8(at, frame->firmware_minor);
    at = wire_put_u8(at, frame->firmware_patch);
    at = wire_put_u8(at, frame->board);
    at = wire_put_u16(at, frame->board_id);
    at = wire_put_u16(at, frame->edges_per_revolution);
    at = wire_put_u8(at, frame->channels);
    at = wire_put_u16(at, frame->tick_ns);
    at = wire_put_u16(at, frame->pwm_top);
    at = wire_put_u8(at, frame->decay);
    at = wire_put_u32(at, frame->sample_period);
    at = wire_put_u32(at, frame->shortest_period);
    at = wire_put_u16(at, frame->command_timeout);
    at = wire_put_u8(at, frame->reset_cause);
    at = wire_put_u8(at, frame->boot);
    at = wire_put_u8(at, frame->latch);
    return at;
}

/* From the board: what was true at a sample tick. */
#define WIRE_TELEMETRY 0x82u
#define WIRE_TELEMETRY_SIZE 26u /* byte of body */
struct wire_telemetry {
    uint32_t time; /* [tick] of the sample: when its duty acts at the pins */
    int16_t duty; /* [1/pwm_top] latched at this sample and held until the next */
    uint32_t edge_count; /* edges since the reset, wraps; with two channels backward ones count down */
    uint32_t edge_time; /* [tick] of the latest edge up to the sample, if edge_valid */
    uint32_t edge_period; /* [tick] between the latest two edges, with quadrature 2 and 4 the mean over the latest period of A if there is one; 0: fewer than two, or too far apart */
    uint16_t supply; /* [mV] 65535: not measured */
    uint16_t command; /* seq of the newest command received, or of the enable since */
    uint8_t flags; /* flag */
    uint8_t errors; /* quadrature 4: transitions of both channels at once, which no motion makes, wraps; else 0 */
    uint8_t boot;
    uint8_t latch;
};
static inline uint8_t *wire_put_telemetry(uint8_t *at, const struct wire_telemetry *frame)
{
    at = wire_put_u32(at, frame->time);
    at = wire_put_i16(at, frame->duty);
    at = wire_put_u32(at, frame->edge_count);
    at = wire_put_u32(at, frame->edge_time);
    at = wire_put_u32(at, frame->edge_period);
    at = wire_put_u16(at, frame->supply);
    at = wire_put_u16(at, frame->command);
    at = wire_put_u8(at, frame->flags);
    at = wire_put_u8(at, frame->errors);
    at = wire_put_u8(at, frame->boot);
    at = wire_put_u8(at, frame->latch);
    return at;
}

/* From the board: telemetry of a board that was flashed to sense the motor's current, in place of it; since firmware 1.3. */
#define WIRE_SENSED 0x85u
#define WIRE_SENSED_SIZE 28u /* byte of body */
/* The body of telemetry, then:
   uint16_t current [5 V/1024] at A1 in the middle of a PWM pulse, at most 350 us before the tick, while the duty before this one still acts; 65535: none yet
*/

/* From the board: the time, as the answer to a ping. */
#define WIRE_PONG 0x83u
#define WIRE_PONG_SIZE 16u /* byte of body */
struct wire_pong {
    uint32_t token; /* of the ping */
    uint32_t received; /* [tick] when the last byte of the ping was there */
    uint32_t sent; /* [tick] when the first byte of this frame went out */
    uint16_t bad_frames; /* frames from the host that were dropped since the reset, wraps */
    uint16_t dropped_samples; /* ticks since the reset whose telemetry was not sent, wraps */
};
static inline uint8_t *wire_put_pong(uint8_t *at, const struct wire_pong *frame)
{
    at = wire_put_u32(at, frame->token);
    at = wire_put_u32(at, frame->received);
    at = wire_put_u32(at, frame->sent);
    at = wire_put_u16(at, frame->bad_frames);
    at = wire_put_u16(at, frame->dropped_samples);
    return at;
}

/* From the board: what holds, as the answer to protect; since firmware 1.4. */
#define WIRE_PROTECTION 0x86u
#define WIRE_PROTECTION_SIZE 10u /* byte of body */
struct wire_protection {
    uint16_t zero; /* [5 V/1024] */
    uint16_t most; /* [5 V/1024] 0 where the board was not flashed to sense the current */
    uint16_t rated; /* [5 V/1024] */
    uint32_t budget;
};
static inline uint8_t *wire_put_protection(uint8_t *at, const struct wire_protection *frame)
{
    at = wire_put_u16(at, frame->zero);
    at = wire_put_u16(at, frame->most);
    at = wire_put_u16(at, frame->rated);
    at = wire_put_u32(at, frame->budget);
    return at;
}

/* From the board: what holds, as the answer to setup; since firmware 1.2. */
#define WIRE_FEATURES 0x84u
#define WIRE_FEATURES_SIZE 3u /* byte of body */
struct wire_features {
    uint8_t quadrature; /* 1 where the board was not flashed for two channels */
    uint8_t pwm; /* pwm */
    uint8_t silent_decays; /* bit 0: silent PWM can brake, bit 1: it can coast */
};
static inline uint8_t *wire_put_features(uint8_t *at, const struct wire_features *frame)
{
    at = wire_put_u8(at, frame->quadrature);
    at = wire_put_u8(at, frame->pwm);
    at = wire_put_u8(at, frame->silent_decays);
    return at;
}

#endif
