"""Parse command lines, call the library, print what it says: one file a command; nothing is computed here."""
