"""What makes a scene: a design, a scene file, and the tables both are written in."""
