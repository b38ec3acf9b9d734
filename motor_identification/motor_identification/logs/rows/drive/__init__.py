"""What drives the rows: a voltage that no column has, and codes that are no duties."""
