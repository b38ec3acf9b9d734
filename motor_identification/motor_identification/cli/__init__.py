"""The commands of this package: arguments in, one sentence or a table out."""
