"""What is started together: which programs, with which parameters; launch files pass it on to ROS 2's launch system."""
