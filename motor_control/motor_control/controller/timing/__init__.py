"""Tell how late samples and answers are: in go a sample's own time and ours, out come its age and what follows of it.

latency      the age of a sample, and whether the plant applies what was asked for long ago
timekeeping  whether the loop keeps its time, and what it may ask for while it does not
sample_rate  lower gains, where the plant's samples come too seldom for those that are set
"""
