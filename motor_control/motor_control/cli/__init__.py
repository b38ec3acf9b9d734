"""Parse the command line of `tune`, call the library, print what it says; nothing is computed here."""
