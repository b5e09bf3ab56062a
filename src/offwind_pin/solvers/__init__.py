"""Newton, eigenproblem, generalised-alpha, step policies: mathematics only."""
