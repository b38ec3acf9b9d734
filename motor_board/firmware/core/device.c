#include "device.h"

#define SHORTEST_TIMEOUT 10u /* [ms] */
#define LONGEST_TIMEOUT 1000u
#define UNMEASURED 0xFFFFu

#define FIRMWARE_MAJOR 1
#define FIRMWARE_MINOR 4
#define FIRMWARE_PATCH 6

/* 256 over the golden ratio: rounds of starts begin with latches that are far apart for long, so that a session which is
 * sent again without some of its ways off does not meet the one of another round. */
#define LATCH_STEP 159u

static uint32_t limited(uint32_t value, uint32_t low, uint32_t high)
{
    return value < low ? low : value > high ? high : value;
}

static void set_timeout(struct device *device, uint16_t milliseconds)
{
    device->timeout = (uint16_t)limited(milliseconds, SHORTEST_TIMEOUT, LONGEST_TIMEOUT);
    device->output.timeout = device->timeout * device->config->ticks_per_ms;
}

static void switch_off(struct device *device, enum guard_verdict why)
{
    output_off(&device->output);
    device->guard.tripped = (uint8_t)why;
}

/* No step is short: what is left after a longest one might be over before the counter is set to it, which then goes round
 * once more, and the clock of compare interrupts, by which a missing command is noticed, would fall behind. */
static uint16_t next_compare(struct device *device)
{
    uint32_t left = device->tick - device->compare;
    uint32_t half = left / 2u;
    uint32_t step = left <= DEVICE_LONGEST_STEP ? left : half < DEVICE_LONGEST_STEP ? half : DEVICE_LONGEST_STEP;
    device->compare += step;
    return (uint16_t)device->compare;
}

void device_start(struct device *device, const struct device_config *config, uint16_t start, uint8_t reset_cause)
{
    *device = (struct device){0};
    device->config = config;
    device->reset_cause = reset_cause;
    device->supply = device->current = UNMEASURED;
    device->output.boot = (uint8_t)start;
    device->output.latch = (uint8_t)((start >> 8) * LATCH_STEP);
    device->output.top = (int16_t)config->top;
    device->output.decay = config->first_decay;
    device->period = config->first_period;
    device->tick = config->first_period;
    device->quadrature = device->edges.fold = 1;
    device->asked = true;
    set_timeout(device, config->first_timeout);
    next_compare(device);
}

void device_overflow(struct device *device)
{
    edge_timer_overflow(&device->edges);
}

void device_capture(struct device *device, uint16_t counter, bool overflow_pending)
{
    edge_timer_capture(&device->edges, counter, overflow_pending);
}

void device_rise(struct device *device, uint16_t counter, bool overflow_pending, bool b_high)
{
    edge_timer_rise(&device->edges, counter, overflow_pending, b_high);
}

void device_fall(struct device *device, uint16_t counter, bool overflow_pending, bool b_high)
{
    edge_timer_fall(&device->edges, counter, overflow_pending, b_high);
}

static uint8_t flags_of(const struct device *device, const struct edge *edge)
{
    unsigned flags = 0;
    flags |= device->output.on ? WIRE_FLAG_ENABLED : 0u;
    flags |= device->output.timed_out ? WIRE_FLAG_TIMED_OUT : 0u;
    flags |= edge->valid ? WIRE_FLAG_EDGE_VALID : 0u;
    flags |= edge->reverse ? WIRE_FLAG_REVERSE : 0u;
    flags |= device->config->channels == 2 ? WIRE_FLAG_TWO_CHANNELS : 0u;
    flags |= device->guard.tripped == GUARD_OVERCURRENT ? WIRE_FLAG_OVERCURRENT : 0u;
    flags |= device->guard.tripped == GUARD_BLIND ? WIRE_FLAG_CURRENT_UNKNOWN : 0u;
    return (uint8_t)flags;
}

bool device_latch(struct device *device)
{
    bool ticks = device->compare == device->tick;
    output_check(&device->output, device->compare);
    edge_timer_forget(&device->edges, device->compare);
    if (ticks || !device->output.on) { /* off does not wait for a tick that may be far away */
        output_latch(&device->output);
    }
    return ticks;
}

uint16_t device_next(struct device *device)
{
    if (device->compare == device->tick) {
        device->latest = device->tick + device->config->lead;
        device->tick += device->period;
    }
    return next_compare(device);
}

bool device_is_behind(const struct device *device, uint32_t now)
{
    return (int32_t)(now - device->compare) > 0;
}

uint16_t device_catch_up(struct device *device, uint32_t now)
{
    while ((int32_t)(device->compare - now) < (int32_t)DEVICE_AHEAD) {
        if (device->compare == device->tick) {
            device->tick += device->period;
            device->dropped_samples++;
        }
        next_compare(device);
    }
    return (uint16_t)device->compare;
}

void device_sample(struct device *device, const struct edge_timer *edges)
{
    struct wire_telemetry *sample = &device->sample;
    struct edge edge = edges->fold > 1 ? quadrature_at(edges, device->latest)
                                       : edge_timer_at(edges, device->latest, device->config->channels == 2);
    enum guard_verdict verdict = guard_check(&device->guard, device->current, device->period);
    if (verdict != GUARD_WELL && device->output.on) {
        switch_off(device, verdict);
    }
    device->dropped_samples = (uint16_t)(device->dropped_samples + device->sampled);
    device->sampled = true;
    sample->time = device->latest;
    sample->duty = device->output.duty;
    sample->edge_count = edge.count;
    sample->edge_time = edge.time;
    sample->edge_period = edge.period;
    sample->supply = device->supply;
    sample->command = device->output.command;
    sample->flags = flags_of(device, &edge);
    sample->errors = edges->errors;
    sample->boot = device->output.boot;
    sample->latch = device->output.latch;
    device->sampled_current = device->current;
    device->current = UNMEASURED; /* none is reported twice */
}

static uint16_t top_of(const struct device *device, uint8_t decay)
{
    return device->output.pwm == WIRE_PWM_SILENT ? device->config->silent_top[decay] : device->config->top;
}

static void act_setup(struct device *device, const struct frame *frame, uint32_t now)
{
    (void)now;
    struct wire_setup setup;
    wire_get_setup(frame->body, &setup);
    bool folds = device->config->channels == 2 && (setup.quadrature == 2 || setup.quadrature == 4);
    switch_off(device, GUARD_WELL);
    device->quadrature = folds ? setup.quadrature : 1;
    device->pwm = setup.pwm == WIRE_PWM_SILENT ? WIRE_PWM_SILENT : WIRE_PWM_STANDARD;
    device->set_up = true;
}

static void act_protect(struct device *device, const struct frame *frame, uint32_t now)
{
    (void)now;
    struct wire_protect protect;
    wire_get_protect(frame->body, &protect);
    switch_off(device, GUARD_WELL);
    if (!device->config->senses_current) {
        protect.most = 0;
    }
    guard_set(&device->guard, &protect);
    device->guarded = true;
}

static void act_configure(struct device *device, const struct frame *frame, uint32_t now)
{
    (void)now;
    struct wire_configure configure;
    wire_get_configure(frame->body, &configure);
    switch_off(device, GUARD_WELL);
    set_timeout(device, configure.command_timeout);
    device->period = limited(configure.sample_period, device->config->shortest_period, DEVICE_LONGEST_PERIOD);
    device->output.decay = configure.decay == WIRE_DECAY_COAST ? WIRE_DECAY_COAST : WIRE_DECAY_BRAKE;
    device->output.pwm = device->config->silent_top[device->output.decay] > 0 ? device->pwm : WIRE_PWM_STANDARD;
    device->output.top = (int16_t)top_of(device, device->output.decay);
    device->tick = device->compare; /* a long period may be under way: the new one starts at the next interrupt */
    device->asked = true;
}

static void act_identify(struct device *device, const struct frame *frame, uint32_t now)
{
    (void)frame;
    (void)now;
    device->asked = true;
}

static void act_enable(struct device *device, const struct frame *frame, uint32_t now)
{
    struct wire_enable enable;
    wire_get_enable(frame->body, &enable);
    output_enable(&device->output, &enable, frame->seq, now);
    if (enable.on != 1 || device->output.on) {
        device->guard.tripped = GUARD_WELL;
    }
}

static void act_command(struct device *device, const struct frame *frame, uint32_t now)
{
    struct wire_command command;
    wire_get_command(frame->body, &command);
    output_command(&device->output, &command, frame->seq, now);
}

static void act_ping(struct device *device, const struct frame *frame, uint32_t now)
{
    wire_get_ping(frame->body, &device->ping);
    device->ping_received = now;
    device->pinged = true;
}

static const struct {
    uint8_t type, size;
    void (*act)(struct device *device, const struct frame *frame, uint32_t now);
} actions[] = {
    {WIRE_IDENTIFY, WIRE_IDENTIFY_SIZE, act_identify},
    {WIRE_CONFIGURE, WIRE_CONFIGURE_SIZE, act_configure},
    {WIRE_SETUP, WIRE_SETUP_SIZE, act_setup},
    {WIRE_PROTECT, WIRE_PROTECT_SIZE, act_protect},
    {WIRE_ENABLE, WIRE_ENABLE_SIZE, act_enable},
    {WIRE_COMMAND, WIRE_COMMAND_SIZE, act_command},
    {WIRE_PING, WIRE_PING_SIZE, act_ping},
};

bool device_act(struct device *device, const struct frame *frame, uint32_t now)
{
    if (frame->version != WIRE_VERSION) {
        device->asked = true;
        return false;
    }
    for (uint8_t i = 0; i < sizeof actions / sizeof actions[0]; i++) {
        if (frame->type == actions[i].type && frame->size == actions[i].size) {
            actions[i].act(device, frame, now);
            return true;
        }
    }
    return false;
}

static uint8_t *put_hello(const struct device *device, uint8_t *at)
{
    const struct device_config *config = device->config;
    struct wire_hello hello = {
        .firmware_major = FIRMWARE_MAJOR,
        .firmware_minor = FIRMWARE_MINOR,
        .firmware_patch = FIRMWARE_PATCH,
        .board = config->board,
        .board_id = config->board_id,
        .edges_per_revolution = config->edges_per_revolution,
        .channels = config->channels,
        .tick_ns = config->tick_ns,
        .pwm_top = (uint16_t)device->output.top,
        .decay = device->output.decay,
        .sample_period = device->period,
        .shortest_period = config->shortest_period,
        .command_timeout = device->timeout,
        .reset_cause = device->reset_cause,
        .boot = device->output.boot,
        .latch = device->output.latch,
    };
    return wire_put_hello(at, &hello);
}

static uint8_t *put_features(const struct device *device, uint8_t *at)
{
    const uint16_t *tops = device->config->silent_top;
    struct wire_features features = {
        .quadrature = device->quadrature,
        .pwm = device->pwm,
        .silent_decays = (uint8_t)((tops[WIRE_DECAY_BRAKE] > 0) | (tops[WIRE_DECAY_COAST] > 0) << 1),
    };
    return wire_put_features(at, &features);
}

static uint8_t *put_protection(const struct device *device, uint8_t *at)
{
    const struct wire_protect *limits = &device->guard.limits;
    struct wire_protection protection = {
        .zero = limits->zero,
        .most = limits->most,
        .rated = limits->rated,
        .budget = limits->budget,
    };
    return wire_put_protection(at, &protection);
}

static uint8_t *put_pong(const struct device *device, uint8_t *at, uint32_t now, uint16_t bad_frames)
{
    struct wire_pong pong = {
        .token = device->ping.token,
        .received = device->ping_received,
        .sent = now,
        .bad_frames = bad_frames,
        .dropped_samples = device->dropped_samples,
    };
    return wire_put_pong(at, &pong);
}

bool device_take(struct device *device, struct device_frame *frame, bool quiet, uint32_t now, uint16_t bad_frames)
{
    uint8_t *body = frame->data + FRAME_HEADER, *end;
    if (device->pinged && !quiet) {
        return false; /* what is going out ends soon, and the pong is next: its time has to be that of its first byte */
    }
    if (device->pinged) {
        device->pinged = false;
        frame->type = WIRE_PONG;
        end = put_pong(device, body, now, bad_frames);
    } else if (device->sampled) {
        device->sampled = false;
        frame->type = WIRE_TELEMETRY;
        end = wire_put_telemetry(body, &device->sample);
        if (device->config->senses_current) {
            frame->type = WIRE_SENSED; /* the same, and the current after it */
            end = wire_put_u16(end, device->sampled_current);
        }
    } else if (device->set_up) {
        device->set_up = false;
        frame->type = WIRE_FEATURES;
        end = put_features(device, body);
    } else if (device->guarded) {
        device->guarded = false;
        frame->type = WIRE_PROTECTION;
        end = put_protection(device, body);
    } else if (device->asked) {
        device->asked = false;
        frame->type = WIRE_HELLO;
        end = put_hello(device, body);
    } else {
        return false;
    }
    frame->size = (uint8_t)(end - body);
    frame->seq = device->seq++;
    return true;
}
