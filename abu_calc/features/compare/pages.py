"""Figures of a page of `abu compare`, of designs or of recorded starts."""

from abu_calc.features.compare.measured import MeasuredCompareResult
from abu_calc.features.compare.study import CompareResult
from abu_calc.reporting.charts.figure import Extras


def any_extras(result: CompareResult | MeasuredCompareResult) -> Extras:
    """Those of the one or the other."""
    if isinstance(result, MeasuredCompareResult):
        from abu_calc.features.compare.measured_view import measured_extras

        return measured_extras(result)
    from abu_calc.features.compare.view import compare_extras

    return compare_extras(result)
