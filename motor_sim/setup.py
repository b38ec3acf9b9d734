from setuptools import find_packages, setup

package_name = "motor_sim"

setup(
    name=package_name,
    version="0.1.0",
    description="A simulated motor with an honest encoder that swaps in for the real board.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "motor_sim = motor_sim.programs:motor_sim",
        ],
    },
)
