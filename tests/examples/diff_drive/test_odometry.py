"""A pose follows the exact arc, however finely the way is cut."""

from math import pi

import pytest

from motor_examples.diff_drive.kinematics import Geometry
from motor_examples.diff_drive.odometry import NEARLY_STRAIGHT, Pose, advance_pose

ROBOT = Geometry(0.05, 0.2)


def test_known_motions() -> None:
    assert advance_pose(ROBOT, Pose(1.0, 2.0, pi / 2.0), 20.0, 20.0) == pytest.approx((1.0, 3.0, pi / 2.0))
    assert advance_pose(ROBOT, Pose(), -2.0 * pi, 2.0 * pi) == pytest.approx((0.0, 0.0, pi))
    # A quarter of a circle of 1 m to the left: the wheels run on circles of 0.9 and 1.1 m.
    quarter = advance_pose(ROBOT, Pose(), 0.9 * pi / 2.0 / 0.05, 1.1 * pi / 2.0 / 0.05)
    assert quarter == pytest.approx((1.0, 1.0, pi / 2.0))


@pytest.mark.parametrize("pieces", [2, 1000])
@pytest.mark.parametrize(("left", "right"), [(3.0, 50.0), (-7.0, 7.0), (10.0, 10.0 + 0.1 * NEARLY_STRAIGHT)])
def test_pieces_of_an_arc_make_the_same_arc(left: float, right: float, pieces: int) -> None:
    pose = Pose(0.3, -0.2, 1.0)
    whole = advance_pose(ROBOT, pose, left, right)
    for _ in range(pieces):
        pose = advance_pose(ROBOT, pose, left / pieces, right / pieces)
    assert pose == pytest.approx(whole, abs=1e-9)


def test_the_series_meets_the_formula_where_it_takes_over() -> None:
    b_over_r = 0.2 / 0.05
    near = [advance_pose(ROBOT, Pose(), 10.0, 10.0 + share * NEARLY_STRAIGHT * b_over_r) for share in (0.999, 1.001)]
    assert near[0].x == pytest.approx(near[1].x, rel=1e-7)
    assert near[0].y == pytest.approx(near[1].y, rel=3e-3) and near[0].y > 0.0
