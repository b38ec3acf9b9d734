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
            "motor_identification = motor_identification.service.node:main",
            "identify = motor_identification.cli.identify:main",
            "diagnose = motor_identification.cli.diagnose:main",
            "explore = motor_identification.cli.explore:main",
            "compare = motor_identification.cli.compare:main",
            "experiment = motor_identification.cli.experiment:main",
            "record = motor_identification.cli.record:main",
            "play = motor_identification.cli.play:main",
            "monitor = motor_identification.live.monitor_node:main",
            "import_csv = motor_identification.cli.import_csv:main",
            "inspect = motor_identification.cli.inspect:main",
            "import_log = motor_identification.cli.import_log:main",
        ],
    },
)
