"""Judge what speaks for an effect: beside a random torque, at standstills, in missed edges, and in another's place."""
