"""Find how a log's rows are timed against each other, from the motion that they show.

In: recordings of speeds of which nobody said when they were made, and a first fit of the motor. Out: the timing that
the motion shows, to read them again by.
"""
