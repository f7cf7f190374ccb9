"""Finds and calls the program hairbench."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Union

if TYPE_CHECKING:
    import numpy
    import pandas

Value = Union[str, int, float, bool, "os.PathLike[str]"]
Option = Union[Value, Sequence[Value], None]
Progress = Callable[[str], object]  # called with each line that the program prints meanwhile

PROGRAM_VARIABLE = "HAIRBENCH_PROGRAM"
PACKAGE = Path(__file__).resolve().parent

# Exit statuses (README.md) that are results of a comparison, not failures.
VERDICTS = {0: "ok", 10: "slower", 11: "inconclusive", 12: "differs"}


class ProgramError(RuntimeError):
    """The program failed: `status` as in README.md, and the last message."""

    def __init__(self, status: int, message: str):
        super().__init__(message)
        self.status = status


def program() -> Path:
    """Returns $HAIRBENCH_PROGRAM, the program installed with this package, or that on the PATH.

    Raises FileNotFoundError if there is none.
    """
    wanted = os.environ.get(PROGRAM_VARIABLE)
    if wanted:
        if not os.access(wanted, os.X_OK):
            raise FileNotFoundError(f"{PROGRAM_VARIABLE}: {wanted} is not a program")
        return Path(wanted).resolve()
    installed = PACKAGE / "bin" / "hairbench"
    if installed.exists():
        return installed
    found = shutil.which("hairbench")
    if found:
        return Path(found).resolve()
    raise FileNotFoundError(
        f"no hairbench on the PATH: build it (scripts/bench) and name it in {PROGRAM_VARIABLE}")


def scenes() -> Path:
    """Returns the folder of the shipped scenes: beside the installed program, or in the source tree
    that it was built in. Raises FileNotFoundError if there is none."""
    start = program()
    for folder in start.parents:
        for place in (folder / "share" / "hairbench" / "scenes", folder / "scenes"):
            if (place / "scene.schema.json").is_file():
                return place
    raise FileNotFoundError(f"{start}: no scenes beside it")


def option_arguments(options: Mapping[str, Option]) -> list[str]:
    """{"max_time": 0.5, "no_pictures": True, "filter": None} -> --max-time 0.5 --no-pictures

    A sequence repeats its option. None and False omit it.
    """
    arguments: list[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            arguments.append(flag)
        elif isinstance(value, (str, int, float, os.PathLike)):
            arguments += [flag, os.fspath(value) if isinstance(value, os.PathLike) else str(value)]
        else:
            for each in value:
                arguments += [flag, str(each)]
    return arguments


def plain(value: Any) -> Any:
    """Returns numpy's arrays and scalars as lists and numbers."""
    return value.tolist() if hasattr(value, "tolist") else value


def json_text(value: object) -> str:
    """Returns a scene's value for the command line: "rod" without quotes, other types as JSON."""
    value = plain(value)
    return value if isinstance(value, str) else json.dumps(value)


def scene_arguments(
        axes: Mapping[str, object] | None, sets: Mapping[str, object] | None) -> list[str]:
    """`axes`: pointer -> values, or a range such as "pow2:6:12"; `sets`: pointer -> value."""
    arguments: list[str] = []
    for pointer, values in (axes or {}).items():
        values = plain(values)
        if not isinstance(values, str):
            if not isinstance(values, Sequence):
                raise TypeError(f"axes: {pointer}: {values!r} is not a list of values")
            values = ",".join(json_text(value) for value in values)
        arguments += ["--axis", f"{pointer}={values}"]
    for pointer, value in (sets or {}).items():
        arguments += ["--set", f"{pointer}={json_text(value)}"]
    return arguments


def to_stderr(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Finished:
    status: int
    text: str  # stdout
    errors: list[str]  # the lines of stderr


def call(arguments: Sequence[str], progress: Progress | None = to_stderr) -> Finished:
    """Runs the program and waits for it. Passes each line of its stderr to `progress`.

    A KeyboardInterrupt also interrupts the program, which first saves what is done.
    """
    with subprocess.Popen(
            [str(program()), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, encoding="utf-8", errors="replace") as process:
        said: list[str] = []
        errors: list[str] = []

        # A thread reads stdout meanwhile, so that a full pipe cannot block the program.
        def read(pipe: IO[str]) -> None:
            said.append(pipe.read())

        assert process.stdout and process.stderr
        reader = threading.Thread(target=read, args=(process.stdout,))
        reader.start()
        try:
            for line in process.stderr:
                errors.append(line.rstrip("\n"))
                if progress:
                    progress(errors[-1])
        except BaseException:
            # In a notebook, only Python receives the interrupt.
            process.send_signal(signal.SIGINT)
            for _ in process.stderr:
                pass
            raise
        finally:
            reader.join()
        status = process.wait()
    return Finished(status, "".join(said), errors)


def failure(finished: Finished, arguments: Sequence[str]) -> ProgramError:
    own = [line.removeprefix("hairbench: ") for line in finished.errors
           if line.startswith("hairbench: ")]
    # Errors of the command line have no such prefix, and a line about --help follows them.
    others = [line for line in finished.errors if line and not line.startswith("Run with --help")]
    said = own or others
    what = said[-1] if said else f"hairbench {arguments[0]} ended with status {finished.status}"
    return ProgramError(finished.status, what)


def succeed(arguments: Sequence[str], progress: Progress | None = to_stderr) -> Finished:
    """Like call(), but raises ProgramError unless the program succeeds."""
    finished = call(arguments, progress)
    if finished.status != 0:
        raise failure(finished, arguments)
    return finished


@dataclass(frozen=True)
class RunResult:
    """Result of a run: the report's file, the exit status and the printed table."""

    path: Path
    status: int
    text: str

    @property
    def verdict(self) -> str:
        """Returns the verdict against `baseline`, a value of VERDICTS; "ok" without a baseline."""
        return VERDICTS[self.status]

    def frame(self) -> pandas.DataFrame:
        from .report import read_report
        return read_report(self.path)

    def probes(self) -> pandas.DataFrame:
        from .report import read_probes
        return read_probes(self.path)


@dataclass(frozen=True)
class GateResult:
    """A gate's report (results/gate.schema.json), its file and its exit status."""

    path: Path
    status: int
    text: str
    report: dict[str, Any]

    @property
    def verdict(self) -> str:
        """Returns mismatch, regressed, inconclusive, improved or same."""
        return str(self.report["verdict"])

    @property
    def passed(self) -> bool:
        return self.status == 0

    def frame(self) -> pandas.DataFrame:
        """Returns a row per judged metric of each case, with its change and interval as shares."""
        import pandas
        return pandas.DataFrame(self.report.get("changes", []))


def compared(arguments: Sequence[str], progress: Progress | None) -> Finished:
    finished = call(arguments, progress)
    if finished.status not in VERDICTS:
        raise failure(finished, arguments)
    return finished


def run(
        scene: str | os.PathLike[str], *, out: str | os.PathLike[str] | None = None,
        axes: Mapping[str, object] | None = None, sets: Mapping[str, object] | None = None,
        progress: Progress | None = to_stderr, **options: Option) -> RunResult:
    """`hairbench run`: plays the cases of a scene or a suite and writes a report.

    axes     pointer -> values: replaces or adds axes of the sweep
    sets     pointer -> value for every case
    out      the report; the program's own default is results/local/<scene>.json
    options  as in `hairbench run --help`, with _ for -: max_time=0.5, no_pictures=True

    Raises ProgramError if the program fails, is interrupted or runs nothing.
    """
    path = Path(out) if out is not None else Path("results/local") / f"{Path(scene).stem}.json"
    arguments = [
        "run", os.fspath(scene), "--out", str(path), *scene_arguments(axes, sets),
        *option_arguments(options)]
    finished = compared(arguments, progress)
    return RunResult(path, finished.status, finished.text)


@dataclass(frozen=True)
class Simulation:
    """Guides of every case: case's name -> float32 [frame, guide, vertex, 3], m, root first.

    Arrays are mapped from their files, so only what is read is in memory.
    """

    positions: dict[str, numpy.ndarray]
    text: str  # that the program printed
    table: Path | None = None  # of probes; None: none were asked for

    def probes(self) -> pandas.DataFrame:
        """Returns a row per case, frame and probe: `case`, `frame` (from 0, the start of the hair),
        `time` (simulated s), `probe`, `value`.

        Raises ValueError if none were asked for.
        """
        import pandas

        if self.table is None:
            raise ValueError("no probes were asked for: sets={'/run/probes/speed': True}")
        wide = pandas.read_csv(self.table).rename(columns={"probe.time": "time"})
        tidy = wide.melt(["case", "frame", "time"], var_name="probe")
        tidy["probe"] = tidy["probe"].str.removeprefix("probe.")
        return tidy.dropna(subset="value", ignore_index=True)


def simulate(
        scene: str | os.PathLike[str], *, out: str | os.PathLike[str],
        axes: Mapping[str, object] | None = None, sets: Mapping[str, object] | None = None,
        frames: int = 60, progress: Progress | None = to_stderr, **options: Option) -> Simulation:
    """`hairbench simulate --guides`: plays every case of a scene, without pictures.

    out      folder for a file CASE.npy of each case, and probes.csv if axes or sets ask for probes
    axes     pointer -> values: replaces or adds axes of the sweep
    sets     pointer -> value for every case
    frames   frames of each case
    options  as in `hairbench simulate --help`, with _ for -

    Raises ProgramError if the program fails or is interrupted.
    """
    import numpy

    arguments = [
        "simulate", os.fspath(scene), "--guides", "--frames", str(frames),
        "--export", str(Path(out) / "{case}.npy"), *scene_arguments(axes, sets),
        *option_arguments(options)]
    asks = any(pointer.startswith("/run/probes") for pointer in (*(axes or ()), *(sets or ())))
    table = Path(out) / "probes.csv" if asks else None
    if table:
        arguments += ["--probes", str(table)]
    finished = succeed(arguments, progress)
    written = re.findall(
        r"^(.*\.npy): \d+ strands, \d+ points, frames 0 to \d+ of (.+), [\d.]+ \w+$", finished.text,
        re.MULTILINE)
    return Simulation(
        {case: numpy.load(path, mmap_mode="r") for path, case in written}, finished.text,
        table)


def gate(
        a: str | os.PathLike[str], b: str | os.PathLike[str], scene: str | os.PathLike[str], *,
        out: str | os.PathLike[str] | None = None, axes: Mapping[str, object] | None = None,
        sets: Mapping[str, object] | None = None, progress: Progress | None = to_stderr,
        **options: Option) -> GateResult:
    """`hairbench gate`: whether build B is slower than build A (docs/comparing.md).

    a, b     a build folder, a program, or a command line
    options  as in `hairbench gate --help`, like run(): pairs=24, calibrate=48, max_time=0

    A slower or different B is a result, not an exception: see `status`, `passed` and `verdict`.
    Raises ProgramError if the gate itself fails or is interrupted.
    """
    stem = f"gate-{Path(scene).stem}.json"
    path = Path(out) if out is not None else Path("results/local") / stem
    arguments = [
        "gate", "--a", os.fspath(a), "--b", os.fspath(b), "--scene", os.fspath(scene),
        "--out", str(path), *scene_arguments(axes, sets), *option_arguments(options)]
    finished = compared(arguments, progress)
    report = json.loads(path.read_text(encoding="utf-8"))
    return GateResult(path, finished.status, finished.text, report)


def main() -> None:
    """The command `hairbench` of a wheel: replaces itself by the program in the package."""
    installed = PACKAGE / "bin" / "hairbench"
    if not installed.exists():
        sys.exit(f"hairbench: {installed}: this package was installed without the program")
    os.execv(installed, [str(installed), *sys.argv[1:]])
