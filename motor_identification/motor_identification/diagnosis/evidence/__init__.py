"""Judge what speaks for an effect: beside a torque, at rest, over the angle, in missed edges, in another's place."""
