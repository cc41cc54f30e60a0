"""Parts of the verification oracle; `oracle.py` beside this package is the place to start reading."""
