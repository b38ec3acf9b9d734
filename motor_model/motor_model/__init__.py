"""The motor itself, without ROS: one compiled step, its effects, the encoder, roll-outs, profiles, model files."""

import os

# Our matrices are small and our own threads use the cores: BLAS threads on top would only fight for them. Takes effect
# where NumPy is not loaded yet, which is so in every program of ours.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
