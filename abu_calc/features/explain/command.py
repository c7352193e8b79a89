"""`abu explain [STEP|CODE|EFFECT|KEY|TABLE]`: a step's formulas, a check's question, an effect, a key or a table."""

from abu_calc.cli.command import Command, Option

COMMAND = Command(
    "explain.texts:explain",
    (
        Option(
            "step",
            str,
            "STEP|CODE|EFFECT|KEY|TABLE",
            "Step, code of a check, effect, or key or table of a machine file.",
        ),
    ),
    "Without an argument, the command lists them.",
)
