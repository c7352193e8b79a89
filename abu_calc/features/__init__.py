"""What people ask for: a folder for each feature."""
