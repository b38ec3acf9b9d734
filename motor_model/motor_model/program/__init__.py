"""How a program of the workbench starts, and what it says where it fails by a mistake of its own."""
