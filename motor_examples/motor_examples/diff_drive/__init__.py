"""A differential drive: velocities of the robot in, references of two wheels out, odometry of their counts back.

`node` is the shell; `drive` decides, `kinematics` and `odometry` compute, `wheel` follows one motor.
"""
