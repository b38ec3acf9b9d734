"""What runs: a node of our own for one command, discovery of all others, their parameters, QoS that fits theirs."""
