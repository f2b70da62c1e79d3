"""Where a system can rest: all equilibria that are found in a box."""
