"""Parse the command line of `check`, talk to the port, print what is found; nothing is decided here."""
