"""Numbers with units, such as "40 N/m", and text with its place in a file."""
