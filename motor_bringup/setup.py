from pathlib import Path

from setuptools import find_packages, setup

package_name = "motor_bringup"
here = Path(__file__).parent


def files(*folders: str) -> list[tuple[str, list[str]]]:
    """Folders that the package needs beside its Python, for its share folder."""
    return [
        (
            f"share/{package_name}/{folder}",
            sorted(f"{folder}/{path.name}" for path in (here / folder).iterdir() if path.is_file()),
        )
        for folder in folders
    ]


setup(
    name=package_name,
    version="0.1.0",
    description="Launch files, parameter files and viewer layouts of the motor workbench.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        *files("launch", "config", "layouts", "security", "ros2_control"),
    ],
    install_requires=["setuptools", "PyYAML>=6.0"],
    zip_safe=False,
)
