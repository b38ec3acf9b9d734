from setuptools import find_packages, setup

package_name = "motor_ros"

setup(
    name=package_name,
    version="0.1.0",
    description="What all nodes do alike: QoS, parameter tables, the plant's shell, starting and stopping.",
    license="Apache-2.0",
    packages=find_packages(exclude=["test"]),
    package_data={package_name: ["py.typed", "loopback.xml", "quick_discovery.xml"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
)
