"""Control the speed: an encoder sample and a reference in; a voltage and every term of it out. No clock, no ROS.

`controller` is the entry: it decides whether the motor may run (`latency` and `plant_watch` judge the sample).
`speed_law` answers the sample in a `run`, behind the `reference_ramp`: speed by `observer` or as reported,
`feedforward`, `voltage_range`, `pi`; `motion` and `faults` see whether the motor does what it should. `output` is what
comes out.
"""
