"""Sources of a scene: a design, a scene file, and the tables in which both are written."""
