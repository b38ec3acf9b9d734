from setuptools import find_packages, setup

package_name = "motor_examples"

setup(
    name=package_name,
    version="0.1.0",
    description="Robots made of the workbench's motors: a differential drive.",
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
            "diff_drive = motor_examples.programs:diff_drive",
        ],
    },
)
