"""Plants that swap, as processes, and a board in the test's own process whose truth can be looked at."""

from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import pytest
from board_fixtures import live  # noqa: F401  (a fixture)
from emulated_board import need_emulator
from ros_fixtures import bench, start  # noqa: F401  (fixtures)

from motor_model.model_file import save
from motor_model.parameters import Parameters, paper_motor

Start = Callable[..., "Popen[str]"]
StartPlant = Callable[..., "Popen[str]"]


@pytest.fixture(params=["motor_sim", "motor_driver"])
def start_plant(request: pytest.FixtureRequest, start: Start, tmp_path: Path) -> StartPlant:  # noqa: F811
    """Starts motor_sim, or motor_driver on an emulated board, with this motor and parameters; gives its process."""

    def begin(motor: Parameters | None = None, *parameters: str) -> "Popen[str]":
        save(tmp_path / "motor.yaml", motor or paper_motor())
        model = f"model:={tmp_path / 'motor.yaml'}"
        if request.param == "motor_sim":
            return start("motor_sim", "motor_sim", "--ros-args", *assigned(model, *parameters))
        need_emulator()
        port = tmp_path / "port"
        start("motor_board", "board_emulator", "--ros-args", *assigned(f"link:={port}", model))
        return start("motor_driver", "motor_driver", "--ros-args", *assigned(f"port:={port}", *parameters))

    return begin


def assigned(*parameters: str) -> list[str]:
    return [word for parameter in parameters for word in ("-p", parameter)]
