from setuptools import find_packages, setup

package_name = "motor_model"

setup(
    name=package_name,
    version="0.1.0",
    description="The motor itself, without ROS: one compiled step, its effects, the encoder, roll-outs, model files.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=["setuptools", "numpy>=1.26", "PyYAML>=6.0", "numba>=0.59"],
    zip_safe=False,
)
