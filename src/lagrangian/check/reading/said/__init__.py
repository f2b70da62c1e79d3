"""What sentences and lists say about letters."""
