"""`abu declare`: the declared vibration value of a type test, simulated for a machine or evaluated from recordings."""
