"""`verify`: the referee that compares a post-processed print with the print that it was made from."""
