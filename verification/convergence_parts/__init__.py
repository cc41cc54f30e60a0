"""The error curve: nested lattices and their norms, the runs compared on them, tables and pictures."""
