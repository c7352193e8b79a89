"""The ranges in which the formulas of bearing seats hold: one each, for the formulas and for what they are given."""

from typing import Final

from abu_calc.validity import Range

BEARING_SIZE: Final = Range("bearing size", 0.0, 10.0, "m", open_low=True)
SEAT_DIAMETER: Final = Range("diameter of the seat", 0.0, 10.0, "m", open_low=True)
SEAT_LENGTH: Final = Range("length of the seat", 0.0, 10.0, "m", open_low=True)
TUBE_RATIO: Final = Range("ratio of a tube's diameters", 0.0, 0.999)
ROUGHNESS: Final = Range("roughness Rz of the seat", 0.0, 1e-3, "m")
RADIAL_LOAD: Final = Range("radial load", 0.0, 1e9, "N")
WARMER_RING: Final = Range("temperature difference of a ring and its seat", -500.0, 500.0, "K")
WARMER_INSIDE: Final = Range("temperature of the inner ring above the outer one", -500.0, 500.0, "K")
WARMER_THAN_MOUNTED: Final = Range("temperature of the bearing above that of mounting", -300.0, 500.0, "K")
STRENGTH: Final = Range("strength of the part", 0.0, 1e10, "Pa", open_low=True)
RING_SPEED: Final = Range("ring speed", 0.0, 1e5, "rad/s")
STARTING_TORQUE: Final = Range("starting torque", 0.0, 1e7, "N·m")
SEAT_FRICTION: Final = Range("friction coefficient of the seat", 0.0, 1.0)
