"""Random profiles of turned parts, of straight edges and arcs."""

import math

from hypothesis import strategies as st

from abu_calc.reporting.solids.assembly import SAME, ProfileCorner, RevolvedSolid

LENGTHS = st.floats(0.5, 200.0)


@st.composite
def turned_solids(draw: st.DrawFn) -> RevolvedSolid:
    """Solids with steps, cones, grooves and beads; some reach the axis."""
    x, low = 0.0, draw(st.sampled_from([0.0, 0.0, 5.0, 40.0]))
    top = list[ProfileCorner]()
    for _ in range(draw(st.integers(1, 5))):
        long, r = draw(LENGTHS), low + draw(LENGTHS)
        to = draw(st.sampled_from([r, low + draw(LENGTHS)]))
        # Flat arcs on edges along the axis stay clear of the neighbours; their centres lie above the axis.
        bulge = draw(st.sampled_from([0.0, 0.1, -0.1])) if to == r and 3 * long < r - low else 0.0
        top += [(x, r, bulge), (x + long, to, 0.0)]
        x += long
    # From left to right along the top is clockwise: back along it, the bulges of edges change their sign and place.
    back = list[ProfileCorner]()
    for index in reversed(range(len(top))):
        px, pr, _ = top[index]
        bulge = -top[index - 1][2] if index else 0.0
        if not back or math.dist((px, pr), back[-1][:2]) >= SAME:
            back.append((px, pr, bulge))
        else:
            back[-1] = (px, pr, bulge)
    return RevolvedSolid("part", ((0.0, low, 0.0), (x, low, 0.0), *back), "steel", 7800.0)
