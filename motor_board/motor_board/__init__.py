"""The board: firmware that drives a bridge and stamps encoder edges, how to flash it, and its emulation."""
