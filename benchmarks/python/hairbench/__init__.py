"""Reports, hair and runs of hairbench in Python: docs/results.md."""

from typing import TYPE_CHECKING

from .groom import Groom, read_groom, write_groom
from .program import (
    GateResult, PhysicsResult, PictureResult, ProgramError, RunResult, Simulation, gate,
    measure_pictures, physics, program, render, run, scenes, simulate)
from .report import read_probes, read_report

if TYPE_CHECKING:
    from .keywords import Axes, Sets

__version__ = "0.1.0"  # of the program that this module belongs to

__all__ = [
    "Axes", "GateResult", "Groom", "PhysicsResult", "PictureResult", "ProgramError", "RunResult", "Sets",
    "Simulation", "gate", "measure_pictures", "physics", "program", "read_groom", "read_probes",
    "read_report", "render", "run", "scenes", "simulate", "write_groom",
]


def __getattr__(name: str) -> object:
    # Only annotations need these types, and making them takes longer than the rest of the import.
    if name in ("Axes", "Sets"):
        from . import keywords
        return getattr(keywords, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
