"""Robots made of the workbench's motors: what stands above single motors and talks to them over their topics."""
