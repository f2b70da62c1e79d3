"""Values given by name, converted to SI numbers, and the dimensions that they must have."""
