"""`ros2 interface`: definitions as the real command prints them."""

TWIST = """\
# A twist with reference coordinate frame and timestamp

std_msgs/Header header
	builtin_interfaces/Time stamp
		int32 sec
		uint32 nanosec
	string frame_id
Twist twist
	Vector3  linear
		float64 x
		float64 y
		float64 z
	Vector3  angular
		float64 x
		float64 y
		float64 z
"""

IDENTIFY = """\
string[] bag_uris
string topic_namespace
string[] effects
float64 start
float64 stop
uint32 particles
uint32 epochs
uint64 seed
---
bool success
string message
MotorModel model
	std_msgs/Header header
		builtin_interfaces/Time stamp
			int32 sec
			uint32 nanosec
		string frame_id
	string name
	string[] effects
	string[] parameter_names
	float64[] parameter_values
	float64[] standard_errors
	bool[] on_bound
	float64 residual_rms
	float64 noise_floor
	string[] bag_uris
float64 r_squared
float64 duration
string[] not_identifiable
string suggested_experiment
"""


def test_nested_types_follow_their_field_without_comments(ros2):
    assert ros2("interface", "show", "geometry_msgs/msg/TwistStamped").out == TWIST


def test_services_and_actions(ros2):
    assert ros2("interface", "show", "--no-comments", "motor_msgs/srv/Identify").out == IDENTIFY
    out = ros2("interface", "show", "--no-comments", "motor_msgs/action/Diagnose").out
    goal, result, feedback = (part.splitlines() for part in out.split("---\n"))
    assert goal == ["string[] bag_uris", "string[] validation_uris", "string topic_namespace", "string[] known_effects"]
    assert result[:4] == ["bool success", "string message", "string verdict", "string[] effects"]
    assert feedback == ["string stage", "float64 progress", "string best_effect", "float64 gap"]


def test_all_comments_and_constants(ros2):
    out = ros2("interface", "show", "--all-comments", "std_msgs/msg/Header").out
    assert "\t# The seconds component, valid over all int32 values.\n\tint32 sec\n" in out
    out = ros2("interface", "show", "diagnostic_msgs/msg/DiagnosticArray", "--no-comments").out
    assert "DiagnosticStatus[] status\n\tbyte OK=0\n\tbyte WARN=1\n" in out


def test_the_type_can_come_from_standard_input(ros2):
    assert ros2("interface", "show", "-", stdin="std_srvs/srv/Trigger\n").out.endswith(
        "---\nbool success   # indicate successful run of triggered service\n"
        "string message # informational, e.g. for error messages\n"
    )
    assert ros2("interface", "show", "-", status=1).err.startswith("No type came on standard input")


def test_list_names_every_kind(ros2):
    assert ros2("interface", "list", "-a").out == "Actions:\n    motor_msgs/action/Diagnose\n"
    out = ros2("interface", "list").out
    messages, services = out.index("Messages:\n"), out.index("Services:\n")
    assert messages < out.index("    motor_msgs/msg/MotorSpeed\n") < services < out.index("    std_srvs/srv/SetBool\n")
    assert "/_" not in out


def test_unknown_types_are_a_sentence(ros2):
    assert ros2("interface", "show", "motor_msgs/msg/MotorSped", status=1).err.startswith(
        "There is no interface 'motor_msgs/msg/MotorSped'; did you mean motor_msgs/msg/MotorSpeed"
    )
    assert ros2("interface", "show", "MotorSpeed", status=1).err == (
        "'MotorSpeed' is not a type name such as std_msgs/msg/Float64.\n"
    )
