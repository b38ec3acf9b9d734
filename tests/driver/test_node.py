"""The driver's node where the thread of its port has died."""

import rclpy
from workbench import DOMAIN

from motor_driver.node import NO_THREAD, MotorDriver
from motor_ros.run import stay_on_this_machine


class Dead:
    """A link whose thread has ended."""

    alive = False

    def take(self) -> list[object]:
        return []

    def write(self, data: bytes) -> None:
        assert data == b""

    def close(self) -> None:
        pass


def test_a_port_that_nobody_looks_after_is_said() -> None:
    stay_on_this_machine()
    rclpy.init(args=["--ros-args", "-p", "port:=nowhere"], domain_id=int(DOMAIN))
    node = MotorDriver()
    try:
        node._link.close()
        node._link = Dead()  # type: ignore[assignment]
        node._work()
        assert node._driver.refusal() == NO_THREAD and node._said == ""
        node._on_second()
        assert node._said == NO_THREAD
        node._work()
    finally:
        node.destroy_node()
        rclpy.shutdown()
