"""Programs that derive or solve equations, carried out on symbols within bounds; nothing of them is run."""
