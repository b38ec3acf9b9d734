"""Every topic, service and action of the workbench as a table: name, type, QoS, and who sends it to whom."""

from dataclasses import dataclass

from rclpy.qos import QoSProfile

from motor_ros import qos


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic; its name is relative, so that a namespace makes a second motor."""

    name: str
    type_name: str
    qos: QoSProfile
    way: str  # who sends it to whom, and when
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Service:
    """A service or an action."""

    name: str
    type_name: str
    does: str
    of: str  # whose it is


TOPICS = (
    Topic("motor/speed", "motor_msgs/msg/MotorSpeed", qos.SPEED, "plant → all, every sample (200 Hz by default)"),
    Topic("motor/info", "motor_msgs/msg/MotorInfo", qos.INFO, "plant → all, at start and on change"),
    Topic("motor/voltage", "motor_msgs/msg/MotorVoltage", qos.VOLTAGE, "controller → plant; must keep coming"),
    Topic("motor/reference", "std_msgs/msg/Float64", qos.REFERENCE, "user → controller; once is enough", "rad/s"),
    Topic(
        "motor/position_reference",
        "std_msgs/msg/Float64",
        qos.REFERENCE,
        "user → controller; with observer and two channels",
        "rad",
    ),
    Topic(
        "motor/joint_command",
        "sensor_msgs/msg/JointState",
        qos.REFERENCE,
        "ros2_control → controller; must keep coming",
        "rad/s or V",
    ),
    Topic("motor/control_state", "motor_msgs/msg/ControlState", qos.CONTROL_STATE, "controller → all, every sample"),
    Topic("motor/model", "motor_msgs/msg/MotorModel", qos.MODEL, "identification → all, after each success"),
    Topic("motor/health", "motor_msgs/msg/MotorHealth", qos.HEALTH, "monitor → all, every half window"),
    Topic("joint_states", "sensor_msgs/msg/JointState", qos.JOINT_STATES, "plant → all, every sample"),
    Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", qos.DIAGNOSTICS, "plant, controller → all, 1 Hz"),
)
# Of a robot that several motors are part of; these are not the motors' own, and a recording of a motor lacks them.
ROBOT_TOPICS = (
    Topic("cmd_vel", "geometry_msgs/msg/Twist", qos.REFERENCE, "user → diff_drive; must keep coming", "m/s, rad/s"),
    Topic("odom", "nav_msgs/msg/Odometry", qos.ODOMETRY, "diff_drive → all, 50 Hz"),
    Topic("/tf", "tf2_msgs/msg/TFMessage", qos.TRANSFORMS, "diff_drive → all, 50 Hz, where tf2_msgs is installed"),
)
SERVICES = (
    Service("motor/enable", "std_srvs/srv/SetBool", "false switches the output off and latches that, true clears it",
            "plant"),
    Service("motor/reset", "std_srvs/srv/Trigger", "clears its latched stop", "controller"),
    Service("motor/release", "std_srvs/srv/Trigger", "drops the reference: 0 V, then others may drive", "controller"),
    Service("motor/identify", "motor_msgs/srv/Identify", "fit a model to bags", "identification"),
    Service("motor/cancel", "std_srvs/srv/Trigger", "end the fits that are computed or wait", "identification"),
    Service("motor/diagnose", "motor_msgs/action/Diagnose", "find what the model lacks", "identification"),
)  # fmt: skip
