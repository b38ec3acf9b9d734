"""Map the board's wrapping counters to continuous nanoseconds, and the board's clock to ROS time for header stamps."""
