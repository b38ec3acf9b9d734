"""The motor itself, without ROS: one compiled step, its effects, the encoder, roll-outs, profiles, model files."""
