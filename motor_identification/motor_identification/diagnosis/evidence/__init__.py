"""Judge what speaks for an effect beside a random torque, and what standstills alone say."""
