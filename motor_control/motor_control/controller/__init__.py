"""Control the speed: an encoder sample and a reference in; a voltage and every term of it out. No clock, no ROS.

`controller` is the entry: it decides whether the motor may run (`latency` and `plant_watch` judge the sample,
`obstacles` name what speaks against it), by what the `state` remembers. `speed_law` answers the sample in a `run`:
`reference` makes a speed of what is asked for; the motor's own is by `observer` or as reported; `feedforward`,
`voltage_range`, `pi`; `motion` and `faults` see whether the motor does what it should. `output` is what comes out.
"""
