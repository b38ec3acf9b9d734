"""Compare a running motor with its model: what was just heard of it goes in, how well the model predicts it comes out.

Nothing here commands a motor, or knows of ROS or of a clock.
"""
