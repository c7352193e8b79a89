"""`abu factory`: machines that a factory measured, beside what is predicted of them."""
