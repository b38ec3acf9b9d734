"""The `ros2` command of the motor workbench, for machines on which ROS 2 came without one.

`verb_table` says what it can do and `main` finds the row; `verbs/` does it, with what `graph/` (nodes and topics that
run) and `interfaces/` (types and their values) offer.
"""
