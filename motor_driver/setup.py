from setuptools import find_packages, setup

package_name = "motor_driver"

setup(
    name=package_name,
    version="0.1.0",
    description="The real motor: talks over a serial port to the board that drives it and stamps its encoder edges.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=["setuptools", "numpy>=1.26", "pyserial>=3.5"],
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "motor_driver = motor_driver.programs:motor_driver",
            "check = motor_driver.programs:check",
        ],
    },
)
