"""The commands whose pages are looked at."""

import pytest

DRAG, IMBALANCE = "autobalancer.rolling_drag_per_s", "wheel.imbalance_g_mm"
GRID = ("--vary", f"{DRAG}=1:20:4", "--vary", f"{IMBALANCE}=200:1300:6", "--grid", IMBALANCE, DRAG)
COMMANDS = {
    # Passes, but hot oil warns: there is an action.
    "size": (
        "size",
        "avtovaz-707-222",
        "--set",
        "autobalancer.capacity_margin=1.2",
        "--set",
        "limits.quiet_time_s=0.8",
    ),
    "check-fit": ("check-fit", "mmg-3200k-knife-shaft"),
    "balance": ("balance", "sapropel-screw-rig"),
    "stability": ("stability", "avtovaz-707-222", "--speeds", "500:8000", "--arrangement", "fan", "--crossings"),
    "simulate": ("simulate", "avtovaz-707-222", "--duration", "0.3"),
    "compare-seats": ("compare", "mmg-3200k-knife-shaft", "--variant", "bearing.0.shaft_fit=m6"),
    "run-up": ("simulate", "avtovaz-707-222", "--scene", "run-up", "--set", "run_up.time_s=0.4"),
    "arm": ("stability", "swing-arm-grinder", "--speeds", "500:8000"),
    "compare": ("compare", "avtovaz-707-222", "msh-230", "avtovaz-707-305"),
    "grinding": ("grinding", "avtovaz-707-222"),
    "face": ("grinding", "msh-230"),
    "accuracy": ("accuracy", "avtovaz-707-222", "--time-budget", "10"),
    "sweep": ("sweep", "avtovaz-707-222", "--tolerances", "--runs", "12"),
    "sweep-many": ("sweep", "avtovaz-707-222", "--tolerances", "--runs", "64", "--workers", "1"),
    "sweep-grid": ("sweep", "avtovaz-707-222", "--workers", "1", *GRID),
    "arm-size": ("size", "swing-arm-grinder"),
}
"""By the names that tests call them."""
QUICK = ("size", "check-fit", "balance", "stability", "simulate", "compare-seats")
"""Those that every run of the tests looks at."""
PAGES = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in COMMANDS]
"""All of them, as parameters."""
ALSO = {
    "compare-seats": [("check-fit", "mmg-3200k-knife-shaft")],
    "compare": [("size", "avtovaz-707-222"), ("size", "msh-230"), ("size", "avtovaz-707-305")],
}
"""What pages show beside their own document: a comparison lists what all have alike."""
