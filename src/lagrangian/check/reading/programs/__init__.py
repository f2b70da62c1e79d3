"""What programs type and print."""
