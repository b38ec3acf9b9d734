"""The machine a benchmark ran on, in one line."""

import os
import platform
import subprocess
from pathlib import Path


def machine() -> str:
    """Processor, cores, Python."""
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    return (
        f"{model}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}, Python {platform.python_version()}"
    )


def commit() -> str:
    """The commit of the code, and whether there is more in the tree."""
    here = Path(__file__).parent
    head = ["git", "rev-parse", "--short", "HEAD"]
    known = subprocess.run(head, cwd=here, capture_output=True, text=True, check=True).stdout.strip()
    changed = subprocess.run(["git", "diff", "--quiet", "HEAD", "--", ":/*.py"], cwd=here, check=False).returncode
    return known + (" with changes" if changed else "")
