"""Figures of `abu check-fit` for each bearing: sketch, tolerance zones, interference, clearance left."""

from collections.abc import Iterator, Sequence

from abu_calc.report.drawing.zones import zones_drawing
from abu_calc.report.figures.chart import Axis, Bar, Bars
from abu_calc.report.figures.drawings import seat_figures
from abu_calc.report.figures.figure import Figure
from abu_calc.report.fits import Seats, by_bearing
from abu_calc.studies.check_fit import CheckFitResult
from abu_calc.studies.seat_parts import Clearance, Pair
from abu_calc.studies.seat_records import SeatResult


def check_fit_figures(result: CheckFitResult) -> Iterator[Figure]:
    """Figures of each bearing, below its heading; at the end if two of them have one name."""
    sketches = list(seat_figures(result, result.seats))
    for index, pair in enumerate(by_bearing(result.seats), 1):
        section = _section(pair, result.seats)
        yield sketches[index - 1]._replace(section=section)
        caption = (
            f"Zones of bearing {index} to scale in µm about the zero line, the nominal size: a shaft is tight where it "
            "stands above its ring, a housing where it stands below."
        )
        yield Figure(f"zones-{index}", section, zones_drawing(f"zones-{index}", *pair), caption)
        yield _interference(index, section, pair)
        if pair[0].internal_clearance is not None:
            yield _clearance(index, section, pair[0].internal_clearance)


def _section(pair: Seats, seats: Sequence[SeatResult]) -> str:
    """Sections are found by how their headings begin."""
    beginnings = [seat.name for seat in seats[::2] if seat.name.startswith(pair[0].name)]
    return f"Bearing seats: {pair[0].name}" if len(beginnings) == 1 else ""


def _interference(index: int, section: str, pair: Seats) -> Figure:
    """Figure of the interference from the tolerance classes, above the permitted interference."""
    values = [value for seat in pair for value in (*seat.interference_um, seat.permitted_interference_um)]
    low = 1.05 * min(0.0, *values)
    rows = []
    for seat in pair:
        rows += [
            _span(f"{seat.seat}: extreme", seat.interference_um, 1),
            _span(f"{seat.seat}: probable", seat.probable_interference_um, 1),
        ]
        needed, most = seat.needed_um, seat.permitted_interference_um
        text = f"≤ {most:g} µm" if needed is None else _told((needed, most))
        rows.append(Bar(f"{seat.seat}: permitted", most, text, 2, low if needed is None else needed))
    axis = Axis("interference [µm], below zero clearance", low, 1.05 * max(values))
    text = "; ".join(f"{bar.name} {bar.told}" for bar in rows)
    caption = (
        f"Interference in the seats of bearing {index}: what comes out should lie within what is permitted, from the "
        "least that the ring needs to the most that it bears."
    )
    return Figure(f"interference-{index}", section, Bars("Interference", text, axis, rows, (0.0, "neither")), caption)


def _clearance(index: int, section: str, left: Clearance) -> Figure:
    rows = [
        _span(f"group {left.group}, before mounting", left.initial_um, 2),
        _span("after mounting, extreme", left.mounted_um, 1),
        _span("after mounting, probable", left.probable_um, 1),
    ]
    ends = [0.0, *(end for bar in rows for end in (bar.start, bar.value))]
    axis = Axis("radial clearance [µm]", 1.05 * min(ends), 1.05 * max(ends))
    text = "; ".join(f"{bar.name} {bar.told}" for bar in rows)
    caption = f"Clearance left in bearing {index} after mounting and warming: it should stay right of the dashed line."
    chart = Bars("Clearance left in the bearing", text, axis, rows, (0.0, "none left"))
    return Figure(f"clearance-{index}", section, chart, caption)


def _span(name: str, ends: Pair, series: int) -> Bar:
    return Bar(name, ends[1], _told(ends), series, ends[0])


def _told(ends: Pair) -> str:
    return "{:.4g} … {:.4g}".format(*ends)
