"""Hostile parameters of nodes, and hostile values for what the stand-in sends to them."""

from pathlib import Path
from random import Random

import yaml
from hypothesis import strategies as st

from hostile.kind import Draw
from hostile.odd_values import NUMBERS, VALUES, WORDS
from hostile.yaml_files import yaml_text

ROWS = {
    "motor_sim": "name sample_rate edges_per_revolution max_voltage model edge_resolution seed gear_ratio",
    "motor_control": "kp ki voltage_limit model speed_source sample_timeout reference_rate_limit",
    "motor_driver": "port baud name sample_rate edges_per_revolution max_voltage",
    "monitor": "model mapping window tolerance",
    "motor_identification": "bag_directory model_file report_directory mapping particles queue_length time_limit",
    "board_emulator": "model gear_ratio quadrature bridge chip edges_per_revolution duty_cycle board_id supply_voltage",
    "diff_drive": "wheel_radius wheel_separation cmd_vel_timeout left right",
}


def parameters(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A node with odd parameters, on the command line or in a file."""
    name = random.choice(("motor_sim", *ROWS))
    rows = ROWS[name].split()
    odd = (*NUMBERS, *WORDS)
    if random.random() < 0.5:
        words = [
            word
            for _ in range(random.choice((1, 2)))
            for word in ("-p", f"{random.choice(rows)}:={random.choice(odd)}")
        ]
    else:
        content = {"/**": {"ros__parameters": {random.choice(rows): draw(VALUES)}}}
        (folder / "input.yaml").write_bytes(yaml_text(content, draw, random))
        words = ["--params-file", "input.yaml"]
    if random.random() < 0.2:
        words += random.choice(
            (["-r", "__ns:=bad-name"], ["--log-level", "x"], ["-r", "x"], ["--enclave", "x"], ["--nope"])
        )
    return [name, "--ros-args", *(word.replace("\0", "") for word in words)]


def values(draw: Draw, random: Random, folder: Path) -> list[str]:
    """What is typed behind `ros2 topic pub` and `ros2 service call`."""
    text = draw(st.one_of(st.text(max_size=40), VALUES.map(lambda value: yaml.safe_dump(value, allow_unicode=True))))
    fields = {
        "std_msgs/msg/Float64": ("data",),
        "motor_msgs/msg/MotorModel": ("name", "parameter_values", "effects", "header", "on_bound"),
        "motor_msgs/srv/Identify": ("bag_uris", "start", "particles", "seed"),
        **dict.fromkeys(("venv/__main__/X", "evil/msg/X", "../x", ""), ("data",)),
    }
    kind = random.choice([*fields] + 4 * [*fields][:3])
    whole = f"{random.choice(fields[kind])}:\n  " + text.replace("\n", "\n  ")
    return ["values", kind, text if random.random() < 0.2 else whole]


def fill_values(words: list[str]) -> int:
    """What the stand-in does with a type and a text, without a graph."""
    from motor_ros.command.shell import shell
    from ros2_stand_in.interfaces import interface_type
    from ros2_stand_in.interfaces import values as typed

    def work() -> int:
        kind = "srv" if "/srv/" in words[0] else "msg"
        found = interface_type.load(words[0], kind)
        typed.fill(found.Request() if kind == "srv" else found(), typed.parse(words[1]))
        return 0

    return shell(work)
