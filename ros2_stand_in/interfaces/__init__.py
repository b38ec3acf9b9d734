"""Packages and interface types that are installed, and messages as YAML: read from the command line, printed."""
