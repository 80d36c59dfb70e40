"""Mutated files for every reader, run in processes with limits, and judged by readers of others.

    python -m tests.fuzzing --minutes 60 --seed 1

`seeds` makes small valid files, `mutations` breaks them, `targets` gives them to a command and judges the answer,
`campaign` runs the cases in worker processes and keeps every failing file.
"""
