"""Time that somebody sets, and time that passes while a process stands still.

steady_timer  calls back however ROS time and the system's clock are set
hold_ups      whether what comes now may be old, because this process stood still
clock_watch   timers go on when the system's clock is set back
"""
