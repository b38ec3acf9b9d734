"""How long a test waits for what has to come."""

PATIENCE = 90.0  # [s] where everything is well it takes a second or two, on a machine with much else to do thirty
