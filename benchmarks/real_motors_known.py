"""What is known of real motors from elsewhere: a static curve, and SysId's own regression of a drivetrain's log."""

import csv
import json
from math import tau
from pathlib import Path

import numpy as np

WHEELS = {"left": "leftSpeedRpm", "right": "rightSpeedRpm"}
LINEAR = (1.2, 2.0)  # [V] where the coasting bridge's static curve is straight: beyond, it bends
SIDES = {"left": (1, 5), "right": (2, 6)}  # columns of voltage and velocity
SPAN = 4  # rows from one end of a difference quotient to the other
MOVING = 0.1  # [m/s]


def fit_static_curve(path: Path, wheel: str) -> str:
    """Fit kv and ks to the straight part of a micromouse's static curve."""
    with path.open(encoding="utf-8") as file:
        rows = [
            {name.strip(): float(cell) for name, cell in row.items()}
            for row in csv.DictReader(file)
            if (row.get("time") or "").strip()
        ]
    volts = np.array([row["motorCommand"] / 255.0 * row["batteryVoltage"] * 1e-3 for row in rows])
    speed = np.array([row[WHEELS[wheel]] for row in rows]) * tau / 60.0
    some = (np.abs(volts) > LINEAR[0]) & (np.abs(volts) < LINEAR[1]) & (np.abs(speed) > 3.0)
    kv, ks = np.polyfit(np.abs(speed[some]), np.abs(volts[some]), 1)
    return f"kv {kv:.3f}, ks {ks:.2f} V"


def fit_like_sysid(path: Path, side: str) -> str:
    """Regress accelerations on speed, voltage and direction, as SysId does: dv/dt = αv + βu + γ·sign v."""
    log = json.loads(path.read_text(encoding="utf-8"))
    turn, (u, v) = log["unitsPerRotation"], SIDES[side]
    columns, accelerations = [], []
    for test in ("slow-forward", "slow-backward", "fast-forward", "fast-backward"):
        rows = np.array(log[test])
        slope = (rows[SPAN:, v] - rows[:-SPAN, v]) / (rows[SPAN:, 0] - rows[:-SPAN, 0])
        middle = rows[SPAN // 2 : -(SPAN // 2)]
        some = (np.abs(middle[:, v]) > MOVING) & (middle[:, u] != 0.0)
        columns.append(np.column_stack([middle[some, v], middle[some, u], np.sign(middle[some, v])]))
        accelerations.append(slope[some])
    alpha, beta, gamma = np.linalg.lstsq(np.vstack(columns), np.concatenate(accelerations), rcond=None)[0]
    metre = turn / tau  # [m/rad]
    return f"kv {-alpha / beta * metre:.4f}, ka {metre / beta:.4f}, ks {-gamma / beta:.3f} V"
