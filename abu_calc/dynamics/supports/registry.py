"""Kinds of support, in the order of scene files.

A new support is a file beside this one and a line here.
"""

from typing import Final

from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import PlanarSupport
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.supports.tilting import TiltingSupport

SUPPORTS: Final[tuple[type[Support], ...]] = (PlanarSupport, TiltingSupport, SwingArmSupport)
