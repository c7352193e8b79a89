"""`abu size MACHINE`: from one file about a machine to a sized and simulated design."""

from abu_calc.cli.command import EXPLAIN, IN_SIMULATIONS, MACHINE, SET, Command

COMMAND = Command(
    "design.study:size",
    (MACHINE, SET, EXPLAIN, IN_SIMULATIONS),
    drawn=(".dxf", ".svg", ".pdf", ".step", ".stp"),
    simulates=True,
)
