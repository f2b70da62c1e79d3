"""What every motion keeps, and the functions of Hamilton and Routh."""
