"""Names and what was given for them: SI numbers, and the dimensions that they must have."""
