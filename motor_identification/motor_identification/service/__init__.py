"""Serve identification and diagnosis over ROS 2: the node, its worker process, jobs from bags to results.

`job` is what the command line runs too; `node`, `messages` and `diagnose_action` are the only files that know ROS.
"""
