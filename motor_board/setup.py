from pathlib import Path

from setuptools import find_packages, setup

package_name = "motor_board"
here = Path(__file__).parent


def files(*folders: str) -> list[tuple[str, list[str]]]:
    """Folders that the package needs beside its Python, for its share folder."""
    return [
        (f"share/{package_name}/{folder}", sorted(f"{folder}/{path.name}" for path in (here / folder).iterdir()))
        for folder in folders
    ]


setup(
    name=package_name,
    version="0.1.0",
    description="Firmware of the real board, its wire protocol, and its emulation with a simulated motor on the pins.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        *files("firmware/core", "firmware/board", "emulator", "protocol"),
    ],
    install_requires=["setuptools", "numpy>=1.26", "PyYAML>=6.0"],
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "board_emulator = motor_board.programs:board_emulator",
            "flash = motor_board.programs:flash",
        ],
    },
)
