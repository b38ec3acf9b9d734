"""A safe first run with a new board: samples and time in; voltages, prompts, findings and a parameter file out."""
