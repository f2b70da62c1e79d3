"""Numbers with units, as people write them: "40 N/m"; and text that knows its place."""
