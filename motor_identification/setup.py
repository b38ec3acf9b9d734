from setuptools import find_packages, setup

package_name = "motor_identification"

setup(
    name=package_name,
    version="0.1.0",
    description="Identifies motors from bags and names the effects that a model lacks; experiments, imports, monitor.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed", "reporting/html/*.html", "reporting/html/*.css"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=[
        "setuptools",
        "numpy>=1.26",
        "scipy>=1.11",
        "matplotlib>=3.6",
        "tqdm>=4.66",
        "rosbags>=0.10.9",
        "mcap>=1.5",
        "apsw",
        "zstandard",
        "lz4",
        "PyYAML>=6.0",
        "jinja2>=3.0",
    ],
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "motor_identification = motor_identification.programs:motor_identification",
            "identify = motor_identification.programs:identify",
            "diagnose = motor_identification.programs:diagnose",
            "explore = motor_identification.programs:explore",
            "compare = motor_identification.programs:compare",
            "experiment = motor_identification.programs:experiment",
            "record = motor_identification.programs:record",
            "play = motor_identification.programs:play",
            "monitor = motor_identification.programs:monitor",
            "import_csv = motor_identification.programs:import_csv",
            "inspect = motor_identification.programs:inspect",
            "import_log = motor_identification.programs:import_log",
        ],
    },
)
