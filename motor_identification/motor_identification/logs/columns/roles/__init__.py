"""Which column is which: those that were named by the user, then by their names, then by how their numbers behave."""
