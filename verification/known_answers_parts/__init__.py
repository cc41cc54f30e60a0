"""Benchmarks with known answers; `known_answers.py` beside this package is the place to start reading."""
