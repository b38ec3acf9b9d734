from setuptools import find_packages, setup

package_name = "motor_control"

setup(
    name=package_name,
    version="0.1.0",
    description="Speed controller that acts on every encoder sample: PI, observer, feed-forward, tuning.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=["setuptools", "numpy>=1.26", "scipy>=1.11", "matplotlib>=3.6", "control>=0.10", "numba>=0.59"],
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "motor_control = motor_control.programs:motor_control",
            "tune = motor_control.programs:tune",
        ],
    },
)
