"""The search of the whole box of parameters: swarm, starts, and when to stop."""
