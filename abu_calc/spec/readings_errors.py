"""Errors that readings and data of the rig may have."""

from pydantic import Field

from abu_calc.spec.table import Table
from abu_calc.spec.usual import usual


class Errors(Table):
    """How far readings, masses put on and data of the rig may be off: one standard deviation each."""

    amplitude_percent: float = Field(
        default=1.0,
        description="Of each amplitude [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 20),
    )
    phase_deg: float = Field(
        default=1.0,
        description="Of each phase [degrees]; {range}. Default: {default}, assumed.",
        ge=0,
        le=90,
        json_schema_extra=usual(0.01, 20),
    )
    speed_percent: float = Field(
        default=0.1,
        description="Of the speed [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=50,
        json_schema_extra=usual(0.001, 10),
    )
    support_mass_percent: float = Field(
        default=2.0,
        description="Of what moves of each support [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    stiffness_percent: float = Field(
        default=2.0,
        description="Of each stiffness [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    damping_ratio: float = Field(
        default=0.01,
        description="Of rig.damping_ratio; {range}. Default: {default}, assumed.",
        ge=0,
        le=0.5,
        json_schema_extra=usual(0.0001, 0.2),
    )
    rotor_mass_percent: float = Field(
        default=0.5,
        description="Of the roll's mass [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    inertia_percent: float = Field(
        default=2.0,
        description="Of the roll's inertia [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    length_mm: float = Field(
        default=1.0,
        description="Of each of the four lengths [mm]; {range}. Default: {default}, assumed.",
        ge=0,
        le=1000,
        json_schema_extra=usual(0.01, 100),
    )
    placed_mass_percent: float = Field(
        default=1.0,
        description="Of each mass put on or taken off, trial or correction [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    placed_angle_deg: float = Field(
        default=1.0,
        description="Of the angle at which it is [degrees]; {range}. Default: {default}, assumed.",
        ge=0,
        le=90,
        json_schema_extra=usual(0.01, 20),
    )
