"""Parse the command line of `flash`, call the library, print what it says; nothing is computed here."""
