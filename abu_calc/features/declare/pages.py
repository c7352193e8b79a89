"""Figures and formulas of a page of `abu declare`, simulated or measured."""

from abu_calc.features.declare.measured import MeasuredDeclareResult
from abu_calc.features.declare.study import DeclareResult
from abu_calc.features.declare.two_race_records import TwoRaceDeclareResult
from abu_calc.reporting.charts.figure import Extras


def declare_extras(result: DeclareResult | TwoRaceDeclareResult | MeasuredDeclareResult) -> Extras:
    """Those of the one or the other."""
    if isinstance(result, MeasuredDeclareResult):
        from abu_calc.features.declare.measured_view import measured_extras

        return measured_extras(result)
    if isinstance(result, TwoRaceDeclareResult):
        from abu_calc.features.declare.two_race_view import two_race_declare_extras

        return two_race_declare_extras(result)
    from abu_calc.features.declare.view import simulated_extras

    return simulated_extras(result)
