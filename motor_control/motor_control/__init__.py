"""PI speed controller that acts on every encoder sample."""
