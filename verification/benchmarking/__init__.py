"""The benchmark's parts: running a program once, the read bandwidth of the memory, the table of the results."""
