"""Small matrices are multiplied by one thread: on two cores BLAS threads made `tune` take twice its time."""

import os
import subprocess
import sys

import pytest

CODE = "import sys, os, {}; print(os.environ['OPENBLAS_NUM_THREADS'], 'numpy' in sys.modules)"


def threads(package: str, **environment: str) -> str:
    kept = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    done = subprocess.run(
        [sys.executable, "-c", CODE.format(package)], env=kept | environment, capture_output=True, text=True, check=True
    )
    return done.stdout


@pytest.mark.parametrize("package", ["motor_model", "motor_control", "motor_identification"])
def test_a_package_that_computes_says_so_before_numpy_is_loaded(package: str) -> None:
    assert threads(package) == "1 False\n"


def test_what_the_user_has_said_stays() -> None:
    assert threads("motor_control", OPENBLAS_NUM_THREADS="3") == "3 False\n"
