"""A motor in ohms, newton-metres and kilograms: the quantities behind the lumped gains, and what was found of them."""
