"""Words among mathematics."""
