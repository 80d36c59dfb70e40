"""How long a sliced print takes."""
