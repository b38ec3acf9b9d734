"""File formats other than text tables: each becomes a table, with what the file says about its columns."""
