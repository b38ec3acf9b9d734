"""Messages as text, as `ros2 topic echo` prints them."""

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseWithCovariance
from std_msgs.msg import Float64MultiArray, Header, String

from motor_msgs.msg import MotorModel
from ros2_stand_in.interfaces.rendering import to_csv, to_yaml

MODEL = """\
header:
  stamp:
    sec: 1
    nanosec: 2
  frame_id: m
name: motor
effects:
- coulomb_friction
parameter_names: []
parameter_values:
- 0.0689
- 1.0e-06
- .nan
standard_errors: []
on_bound:
- true
- false
residual_rms: 0.0
noise_floor: .inf
bag_uris: []
"""


def model() -> MotorModel:
    return MotorModel(
        header=Header(stamp=Time(sec=1, nanosec=2), frame_id="m"),
        name="motor",
        effects=["coulomb_friction"],
        parameter_values=[0.0689, 1e-6, float("nan")],
        on_bound=[True, False],
        noise_floor=float("inf"),
    )


def test_fields_keep_their_order_and_lists_are_blocks():
    assert to_yaml(model()) == MODEL


def test_flow_style_is_one_line():
    assert to_yaml(Header(frame_id="a"), flow_style=True) == "{stamp: {sec: 0, nanosec: 0}, frame_id: a}\n"


def test_csv_has_all_values_in_order():
    assert to_csv(model()) == "1,2,m,motor,coulomb_friction,0.0689,1e-06,nan,True,False,0.0,inf"


def test_long_arrays_and_texts_are_cut():
    assert to_yaml(Float64MultiArray(data=range(4)), longest=2).endswith("data:\n- 0.0\n- 1.0\n- '...'\n")
    assert to_yaml(Float64MultiArray(data=range(2)), longest=2).endswith("data:\n- 0.0\n- 1.0\n")
    assert to_yaml(String(data="abcd"), longest=3) == "data: abc...\n"
    assert to_yaml(String(data="abc"), longest=3) == "data: abc\n"


def test_bytes_fixed_arrays_and_lists_of_messages():
    status = DiagnosticStatus(level=b"\x02", message="rev/s · 2π", values=[KeyValue(key="a", value="1")])
    assert to_yaml(status) == (
        "level: \"\\x02\"\nname: ''\nmessage: rev/s · 2π\nhardware_id: ''\nvalues:\n- key: a\n  value: '1'\n"
    )
    assert to_yaml(PoseWithCovariance()).count("- 0.0\n") == 36
