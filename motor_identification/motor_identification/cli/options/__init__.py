"""Options that several commands share, one file a subject: a parser in, with its options; what they say out."""
