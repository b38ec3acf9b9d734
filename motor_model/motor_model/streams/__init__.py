"""Tell who goes on asking for a motion beyond what has ended it, and who begins: for all that take commands."""
