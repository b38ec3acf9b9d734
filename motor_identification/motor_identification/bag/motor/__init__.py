"""One motor out of a bag: its samples and what is known of it, or in a sentence why there are none."""
