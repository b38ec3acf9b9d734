"""What a run begins with."""

from bench_board import motor, settings

from motor_control.controller.motion import Motion
from motor_control.controller.run import begin
from motor_model.sample import Info, Sample


def test_a_run_begins_with_what_is_known_of_the_motor() -> None:
    known = Motion(steady_speed=100.0, steady_voltage=7.0)
    run = begin(settings(motor(), Info()), Sample(0, 40.0, 3.0, 17), known)
    assert (run.motion.steady_speed, run.motion.edge_count, run.motion.speed) == (100.0, 17, 40.0)
    assert run.reference == 40.0 and run.watched is not None
