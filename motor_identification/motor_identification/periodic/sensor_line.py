"""Compare two sources of a line over the angle: a load, which the motor answers, and a sensor that errs with the angle.

Speeds that were logged may come from slots or windings that are no two alike: each turn shows the same errors, as a
share of the speed. A load's answer is the smaller the faster the motor turns, so that motion at several speeds tells.
"""

from collections.abc import Callable, Sequence

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.linear_response import Course
from motor_identification.periodic.run_alignment import align_runs
from motor_identification.periodic.whitened_run import whiten_runs
from motor_identification.recording import Floats

Shape = Callable[[Course, float], tuple[Floats, Floats]]  # increments (I,) of a line's sine and cosine


def explain_line(estimate: Estimate, tracks: Sequence[Track], cycles: float) -> tuple[float, float]:
    """Measure how much log likelihood a load, and a sensor's error, of so many cycles a turn explain.

    Either at these cycles or at the nearest whole number of them, as it fits best: a sensor on the shaft that it tells
    of has whole ones. estimate: without the line, of logged speeds.
    """
    runs = whiten_runs(estimate, tracks)

    def explain(shape: Shape, at: float) -> float:
        explained = 0.0
        for run, data in zip(runs, estimate.problem.intervals, strict=True):
            sums = run.sum_products_of(shape(run.course, at), run.course.run)
            explained += align_runs(sums, 0.0, data.counts_both_ways).explained
        return explained

    places = {cycles, max(float(np.round(cycles)), 1.0)}
    load = max(explain(Course.response, at) for at in places)
    sensor = max(explain(shape, at) for shape in (_err_at_end, _err_within) for at in places)
    return 0.5 * load, 0.5 * sensor


def _err_at_end(course: Course, cycles: float) -> tuple[Floats, Floats]:
    """Errors of speeds that are of their instants, as the latest slot's is."""
    travel = course.end - course.start
    return travel * np.sin(cycles * course.end), travel * np.cos(cycles * course.end)


def _err_within(course: Course, cycles: float) -> tuple[Floats, Floats]:
    """Errors of speeds that are means of their intervals."""
    ends = cycles * np.stack([course.start, course.end])
    return np.diff(np.sin(ends), axis=0)[0], np.diff(np.cos(ends), axis=0)[0]
