"""Control the speed: one encoder sample and a reference in; a voltage and every term of it out. No clock, no ROS.

`controller` is the entry: it decides whether the motor may run; `speed_law` answers a sample, with feed-forward and
`pi`.
"""
