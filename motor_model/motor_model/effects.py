"""The table of effects: every physical effect the workbench knows, its parameters, their units and where to search.

The equation they belong to, in armature voltages throughout (see `motor.py`, which is its one home):

    ka dω/dt = drive − friction(ω) − loads,    drive = u_eff − kv ω,    dθ/dt = ω

An effect is its row here and its term in `dynamics/` (or `sensing/`): whatever else the workbench does with effects, it
reads in the row (`effect.py` says what the columns mean). What is most common comes first: of two effects that explain
a recording equally well, a diagnosis names the first.

Speed and angle are those of the output. What turns with the encoder (on the motor, before a gear) is of the encoder's
shaft: `ripple_cycles` counts its turns, `eccentricity` and both phases are angles of it. Without a gear these are one.
"""

from math import inf, pi

from motor_model.effect import DURATION, Effect, ParameterSpec, Scale
from motor_model.errors import ModelError

P = ParameterSpec
VOLTAGE, SPEED, SAMPLE = Scale(voltage=1), Scale(speed=1), Scale(sample=1)
TURN = Scale(speed=1, sample=1)

BASE = (
    P("kv", "V·s/rad", 0.0, 0.1, 4.0, Scale(voltage=1, speed=-1), True),
    # ka = kv · time constant; 0.04 to 12,000 samples of it are searched: 0.2 ms to 60 s at 200 Hz.
    P("ka", "V·s²/rad", 0.0, 0.04, 12_000.0, Scale(voltage=1, speed=-1, sample=1), True, of_motion=True),
)

EFFECTS = (
    Effect(
        "coulomb_friction",
        "constant friction against the motion: ks·sign ω",
        "ramps",
        "the friction level (ks)",
        (P("ks", "V", 0.0, 0.0, 0.8, VOLTAGE, starts=(0.03,)),),
        linear_onset=True,
        holds=True,
    ),
    Effect(
        "static_friction",
        "Stribeck friction at low speed, and a breakaway voltage at rest",
        "ramps",
        "the breakaway level (static_friction)",
        (
            P("breakaway_voltage", "V", 0.0, 0.0, 1.0, VOLTAGE, starts=(0.1, 0.03), at_least="ks"),
            P("stribeck_speed", "rad/s", 1.0, 0.002, 0.3, SPEED, True, minimum=1e-6, starts=(0.01, 0.035, 0.1)),
        ),
        implies="coulomb_friction",
        holds=True,
    ),
    Effect(
        "quadratic_drag",
        "drag·ω·|ω|",
        "staircase",
        "drag (quadratic_drag)",
        # A fan's winding takes half of the voltage at its largest speed; with nine tenths of it a motor nearly stalls.
        (P("drag", "V·s²/rad²", 0.0, 0.0, 0.7, Scale(voltage=1, speed=-2), starts=(0.05,)),),
        linear_onset=True,
    ),
    Effect(
        "load_bias",
        "constant load, the same in both directions",
        "staircase",
        "a constant load (load_bias)",
        (P("bias_voltage", "V", 0.0, -0.5, 0.5, VOLTAGE, minimum=-inf, starts=(0.02,)),),
        linear_onset=True,
    ),
    Effect(
        "load_step",
        "a load that appears once and stays",
        "rich",
        "a load step (load_step)",
        (
            P("step_voltage", "V", 0.0, -0.5, 0.5, VOLTAGE, minimum=-inf, starts=(0.03, -0.03)),
            P("step_time", "s", 0.0, 0.0, 1.0, DURATION, of_recording=True, starts=(0.1, 0.3, 0.5, 0.7, 0.9)),
        ),
        anywhere=True,
        constant="load_bias",
    ),
    Effect(
        "dead_zone",
        "no output below this voltage: drop of the bridge",
        "coast",
        "a dead zone of the bridge (dead_zone)",
        # As that of friction: geared motors behind an L298 have been met that move from 95 of 255 on.
        (P("dead_zone_voltage", "V", 0.0, 0.0, 0.8, VOLTAGE, starts=(0.03,)),),
        linear_onset=True,
        holds=True,
    ),
    Effect(
        "voltage_limit",
        "the output saturates at this voltage, below max_voltage",
        "staircase",
        "the voltage limit (voltage_limit)",
        (P("limit_voltage", "V", inf, 0.2, 1.0, VOLTAGE, starts=(0.97, 0.85, 0.7)),),
    ),
    Effect(
        "direction_asymmetry",
        "another gain for negative commands",
        "staircase",
        "a difference between the directions (direction_asymmetry)",
        (P("reverse_gain", "–", 1.0, 0.5, 1.5, starts=(0.97,)),),
    ),
    Effect(
        "coast_drive",
        "the bridge coasts in the off time: less braking by back-EMF at low duty",
        "coast",
        "coasting in the off time (coast_drive)",
        (P("coast_share", "–", 0.0, 0.0, 1.0, maximum=1.0, starts=(0.2,)),),
        of_supply=True,
        stands_for="Viscous friction brakes a motor that coasts, too: where kv holds some that is not told apart, "
        "coast_share reads lower by as much.",
    ),
    Effect(
        "supply_sag",
        "the supply voltage drops under load",
        "staircase",
        "sag of the supply (supply_sag)",
        (P("sag", "–", 0.0, 0.0, 1.0, starts=(0.05,)),),
        of_supply=True,
        splits_kv=True,
        stands_for="A motor whose magnets saturate weakens with the current as a supply does that sags: log the "
        "supply's voltage to tell.",
    ),
    Effect(
        "transport_delay",
        "dead time between command and output",
        "prbs",
        "the delay (transport_delay)",
        (
            P(
                "delay",
                "s",
                0.0,
                0.0,
                40.0,
                SAMPLE,
                starts=(0.4, 2.0, 8.0, 32.0),
                usual=(0.0, 1.0),
                most_duration=0.1,
            ),
        ),  # fmt: skip
    ),
    Effect(
        "armature_inductance",
        "first-order lag of the drive (L/R)",
        "prbs",
        "the inductance (armature_inductance)",
        (P("electrical_time_constant", "s", 0.0, 2e-3, 6.0, SAMPLE, True, starts=(0.1, 0.8), usual=(1e-5, 0.1)),),
    ),
    Effect(
        "torque_ripple",
        "load periodic in the shaft angle",
        "ramps",
        "the torque ripple (torque_ripple)",
        (
            P("ripple_voltage", "V", 0.0, 0.0, 3.0, VOLTAGE),
            P("ripple_cycles", "1/rev", 1.0, 1.0, 48.0, of_encoder=True),
            P("ripple_phase", "rad", 0.0, -2 * pi, 2 * pi, minimum=-inf, of_recording=True),
        ),
        periodic=True,
    ),
    Effect(
        "encoder_eccentricity",
        "the encoder disc is off centre: angle error e·sin(θ + phase)",
        "staircase",
        "the eccentricity of the disc (encoder_eccentricity)",
        (
            P("eccentricity", "rad", 0.0, 0.0, 0.2, maximum=0.9),
            P("eccentricity_phase", "rad", 0.0, -2 * pi, 2 * pi, minimum=-inf, of_recording=True),
        ),
        periodic=True,
        on_disc=True,
    ),
    Effect(
        "backlash",
        "gear play: after a reversal the load is decoupled until the play is taken up",
        "reversals",
        "the backlash (backlash)",
        (
            # Starts and box by what the shaft turns in a sample, 0.75 rad at 150 rad/s and 200 Hz. Behind a gear the
            # play of an output's degrees is whole turns of the motor's shaft.
            P("backlash_angle", "rad", 0.0, 0.0, 30.0, TURN, starts=(4.0, 0.067, 0.53), usual=(0.0, 1.0)),
            P("load_fraction", "–", 0.0, 0.0, 0.95, maximum=0.99, starts=(0.3, 0.7)),
        ),
        after_reversals=True,
    ),
    Effect(
        "warm_up",
        "the winding heats up: ka, friction and loads grow by 1 + rise·(1 − e^(−t/τ))",
        "rich",
        "the warming-up (warm_up)",
        (
            P("resistance_rise", "–", 0.0, 0.0, 0.6, starts=(0.1,)),
            # A winding needs many times longer to heat up than a motor to gain speed: what is over within a tenth
            # of a recording is no warming-up; but within an hour it may be.
            P("warm_up_time", "s", 1.0, 0.1, 20.0, DURATION, True, starts=(0.15, 0.5, 3.5), usual=(10.0, 0.0)),
        ),
        anywhere=True,
        splits_kv=True,
    ),
    Effect(
        "missed_edges",
        "this share of the edges is not counted",
        "staircase",
        "the missed edges (missed_edges)",
        (P("miss_rate", "–", 0.0, 0.0, 0.2, maximum=0.9),),
        fitted=False,
    ),
)

# What shapes nearly every motor's motion, and that of one which is driven both ways: fitted beside whatever else is to
# be learned from the motion.
SHAPING = ("coulomb_friction", "transport_delay")
SHAPING_BOTH_WAYS = ("coulomb_friction", "load_bias", "direction_asymmetry", "transport_delay")
LAGGING = ("armature_inductance",)  # what makes a motion late by the motor's own doing, beside a dead time
LAGS = ("transport_delay", *LAGGING)  # what a recording may be late by itself

EFFECT_BY_NAME = {effect.name: effect for effect in EFFECTS}
SPECS = BASE + tuple(spec for effect in EFFECTS for spec in effect.parameters)
SPEC_BY_NAME = {spec.name: spec for spec in SPECS}

# Of kv, what is viscous friction and not back-EMF: told apart only by effects that treat the two differently
# (`splits_kv`). A motor has it as its torque constant.
VISCOUS_SHARE = P("viscous_share", "–", 0.0, 0.0, 0.75, starts=(0.2,))

# The vector the compiled code works on: every parameter in the order of the table, then the supply, then how many times
# longer than full accuracy allows a piece of the motion may be, then what a measured current adds (`physical/`),
# then turns of the encoder's (the motor's) shaft per turn of the output: what is periodic in the angle is so over it,
# then the share of a backlash that is open where a standing motor's motion begins.
MAX_VOLTAGE, COARSENESS, GEAR_RATIO, OPEN_PLAY = "max_voltage", "coarseness", "gear_ratio", "open_play"
ELECTRICAL = (
    P("resistance", "Ω", 0.0, 0.02, 20.0, logarithmic=True, minimum=1e-6),  # times the voltage per largest current
    P("torque_constant", "N·m/A", 0.0, 0.2, 1.2),  # times kv; 0 is kv
    P("current_offset", "A", 0.0, -0.2, 0.2, minimum=-inf, of_recording=True),  # times the largest current
    P("current_lag", "s", 0.0, 0.0, 1.0, minimum=-inf),  # sample periods by which a reading is older, beyond whole ones
)
VECTOR_NAMES = (*SPEC_BY_NAME, MAX_VOLTAGE, COARSENESS, *(spec.name for spec in ELECTRICAL), GEAR_RATIO, OPEN_PLAY)
INDEX = {name: i for i, name in enumerate(VECTOR_NAMES)}


def normalised(effects: tuple[str, ...]) -> tuple[str, ...]:
    """Return the effects with what they imply, each once, in the order of the table.

    Raises:
        ModelError: an effect is not in the table.
    """
    wanted = set()
    for name in effects:
        if name not in EFFECT_BY_NAME:
            raise ModelError(f"'{name}' is not an effect; the effects are {', '.join(EFFECT_BY_NAME)}.")
        wanted.add(name)
        implied = EFFECT_BY_NAME[name].implies
        if implied is not None:
            wanted.add(implied)
    return tuple(name for name in EFFECT_BY_NAME if name in wanted)


def specs_of(effects: tuple[str, ...]) -> tuple[ParameterSpec, ...]:
    """kv, ka and the parameters of these effects, in the order of the table."""
    return BASE + tuple(spec for name in normalised(effects) for spec in EFFECT_BY_NAME[name].parameters)


def do_split_kv(effects: tuple[str, ...]) -> bool:
    """Whether any of these effects tells back-EMF and viscous friction, which kv is both of, apart."""
    return any(EFFECT_BY_NAME[name].splits_kv for name in effects)
