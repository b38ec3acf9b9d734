"""Commands for several motors: they read what the other packages write, and start nothing."""
