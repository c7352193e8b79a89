"""Figures and formulas of a page of `abu declare`, simulated or measured."""

from abu_calc.features.declare.measured import MeasuredDeclareResult
from abu_calc.features.declare.study import DeclareResult
from abu_calc.reporting.charts.figure import Extras


def declare_extras(result: DeclareResult | MeasuredDeclareResult) -> Extras:
    """Those of the one or the other."""
    if isinstance(result, MeasuredDeclareResult):
        from abu_calc.features.declare.measured_view import measured_extras

        return measured_extras(result)
    from abu_calc.features.declare.view import simulated_extras

    return simulated_extras(result)
