"""Text tables: bytes in, named columns of cells out; separators, decimal signs, headers and comments are found."""
