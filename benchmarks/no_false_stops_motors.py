"""Draw one of the random motors of `no_false_stops.py`: plant, model, disc, loop, load and references."""

from math import pi

import numpy as np
from no_false_stops_conditions import Setup

from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig

VOLTAGES = (1.2, 6.0, 12.0, 24.0, 48.0)
EDGE_RATES = (90.0, 300_000.0)  # [edges/s] at top speed, and 4 to 4000 edges a turn


def draw(seed: int, rate: float, seconds: float, edge_rate: float) -> Setup:
    """Draw a setup; its load step comes once, at a random time."""
    rng = np.random.default_rng([seed, round(rate)])

    def log_uniform(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    supply, top, lag = float(rng.choice(VOLTAGES)), log_uniform(6.0, 600.0), log_uniform(0.02, 1.0)
    kv, ks = supply / top, float(rng.uniform(0.0, 0.1)) * supply
    single = bool(rng.integers(2))
    most = 0.45 * ks if single else 0.125 * supply  # one channel is not braked at 0 rad/s: friction has to hold it
    load = {name: float(rng.uniform(-1.0, 1.0)) * most for name in ("bias_voltage", "step_voltage")}
    values = {"kv": kv, "ka": kv * lag, "ks": ks, "breakaway_voltage": ks * float(rng.uniform(1.0, 2.0)) + 1e-9}
    values |= {"stribeck_speed": 0.03 * top, "step_time": float(rng.uniform(0.2, 0.8)) * seconds} | load
    plant = Parameters(values, ("static_friction", "load_bias", "load_step"), max_voltage=supply)
    off = {"kv": 1.0 + 0.02 * rng.standard_normal(), "ka": 1.0 + 0.1 * rng.standard_normal(), "ks": 0.9}
    known = {name: values[name] * float(factor) for name, factor in off.items()}
    model = Parameters(known | {"ks": min(known["ks"], values["breakaway_voltage"])}, ("coulomb_friction",), supply)
    edges = int(np.clip(round(log_uniform(EDGE_RATES[0], edge_rate) * 2.0 * pi / top), 4, 4000))
    board = BoardConfig(
        sample_rate=rate,
        edges_per_revolution=edges,
        slot_irregularity=float(rng.uniform(0.0, 0.05)),
        single_channel=single,
        seed=seed,
    )
    closed = max(0.03, 0.5 * lag) * float(rng.uniform(1.0, 3.0))
    loop: dict[str, object] = {"kp": kv * lag / closed, "ki": kv / closed, "voltage_limit": supply}
    observed = bool(rng.integers(2))
    loop |= {"speed_source": "observer" if observed else "measured", "feedforward": observed}
    share = 0.9 - (2.0 * ks + sum(abs(one) for one in load.values())) / supply
    references, time = [], 0.0
    while time < seconds:
        kind = rng.integers(4)
        speed = 0.0 if kind == 0 else float(rng.choice([-1.0, 1.0])) * top * share * log_uniform(0.05, 1.0)
        references.append((time, speed))
        time += float(rng.uniform(0.5, 2.5))
    return Setup(plant, model if observed or rng.integers(2) else None, board, loop, references)
