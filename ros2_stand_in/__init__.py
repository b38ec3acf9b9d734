"""The `ros2` command of the motor workbench, for machines on which ROS 2 came without one."""
