"""Reports, hair and runs of hairbench in Python: docs/results.md."""

from .groom import Groom, read_groom, write_groom
from .program import (
    GateResult, ProgramError, RunResult, Simulation, gate, program, run, scenes, simulate)
from .report import read_probes, read_report

__all__ = [
    "GateResult", "Groom", "ProgramError", "RunResult", "Simulation", "gate", "program", "read_groom",
    "read_probes", "read_report", "run", "scenes", "simulate", "write_groom",
]
