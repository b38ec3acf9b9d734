"""Compile the plant ahead of time, `python -m plant`: else every process of the tests does, at the same time."""

from plant import record

record({"kv": 0.07, "ka": 0.0055}, [0.0, 0.1, 0.2], [0.0, 5.0, 0.0])
