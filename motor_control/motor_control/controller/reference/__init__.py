"""Make a reference of the speed of what is asked of the motor.

In goes what somebody asks for (`demand`; `joint_command` reads it out of a message for several joints), out comes the
speed that the law goes by: an angle asks for one by what is missing (`position_law`), and `ramp` limits its rate.
"""
