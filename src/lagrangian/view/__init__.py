"""Pictures of runs: plots with labels, units and legends. Data in, figures out; knows no mechanics."""
