"""What columns are by how their numbers behave, where their names tell nothing, or two things."""
