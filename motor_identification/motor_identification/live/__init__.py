"""Drive and hear a running graph: the plan of an experiment sample by sample, topics into bags and out of them.

What the commands `experiment`, `explore`, `record` and `play` share; all of it needs ROS 2.
"""
