"""One file per solver library; each has `integrate(equations, tolerance, sample_times) -> Trajectory`."""
