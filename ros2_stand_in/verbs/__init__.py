"""One module a verb or family of verbs: its arguments, and the function that does it and returns the exit status."""
