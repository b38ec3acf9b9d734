"""Our programs as processes in a ROS domain of their own, and what the kernel says of them."""

import os
import signal
import subprocess
from pathlib import Path

from ament_index_python.packages import get_package_prefix

from motor_model.errors import MotorError

DOMAIN = "71"  # nobody else's motor hears these voltages
PATIENCE = 10.0  # [s] that a process may take to end


class Process:
    """A program that runs."""

    def __init__(self, *words: object) -> None:
        environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        self._name = str(words[0])
        self._process = subprocess.Popen([str(word) for word in words], env=environment)
        self._folder = Path("/proc", str(self._process.pid))

    def cpu(self) -> float:
        """[s] used up to now.

        Raises:
            MotorError: it has ended.
        """
        if self._process.poll() is not None:
            raise MotorError(f"{self._name} has ended by itself: see what it said above.")
        fields = (self._folder / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def memory(self) -> tuple[int, int]:
        """[KiB] resident, and what is the process's alone, swapped out or not."""
        lines = (self._folder / "status").read_text(encoding="utf-8").splitlines()
        table = {name: value.split()[0] for name, _, value in (line.partition(":") for line in lines) if value.strip()}
        return int(table["VmRSS"]), int(table["RssAnon"]) + int(table["VmSwap"])

    def end(self) -> None:
        """Ctrl-C, and what ends everything if that does not help."""
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()


def program(package: str, name: str, *parameters: str) -> Process:
    """One of the workbench's nodes."""
    words = [word for parameter in parameters for word in ("-p", parameter)]
    return Process(Path(get_package_prefix(package)) / "lib" / package / name, "--ros-args", *words)
