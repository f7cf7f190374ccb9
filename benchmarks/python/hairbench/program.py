"""The program hairbench: where it is, and calls of it."""

from __future__ import annotations

import json
import os
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
    import pandas

Value = Union[str, int, float, bool, "os.PathLike[str]"]
Option = Union[Value, Sequence[Value], None]
Progress = Callable[[str], object]  # is given each line that the program says meanwhile

PROGRAM_VARIABLE = "HAIRBENCH_PROGRAM"
PACKAGE = Path(__file__).resolve().parent

# Exit statuses (README.md) that are findings of a comparison and no failure.
VERDICTS = {0: "ok", 10: "slower", 11: "inconclusive", 12: "differs"}


class ProgramError(RuntimeError):
    """The program failed: `status` as README.md lists them, and what it said last."""

    def __init__(self, status: int, message: str):
        super().__init__(message)
        self.status = status


def program() -> Path:
    """$HAIRBENCH_PROGRAM, the program that was installed with this package, or that on the PATH.

    Raises FileNotFoundError where there is none.
    """
    wanted = os.environ.get(PROGRAM_VARIABLE)
    if wanted:
        if not os.access(wanted, os.X_OK):
            raise FileNotFoundError(f"{PROGRAM_VARIABLE}: {wanted} is no program")
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
    """The folder of the shipped scenes: beside the program where it is installed, or in the source
    tree that it was built in. Raises FileNotFoundError where there is none."""
    start = program()
    for folder in start.parents:
        for place in (folder / "share" / "hairbench" / "scenes", folder / "scenes"):
            if (place / "scene.schema.json").is_file():
                return place
    raise FileNotFoundError(f"{start}: no scenes beside it")


def option_arguments(options: Mapping[str, Option]) -> list[str]:
    """{"max_time": 0.5, "no_pictures": True, "filter": None} -> --max-time 0.5 --no-pictures

    A sequence repeats its option; None and False leave it out.
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


def json_text(value: object) -> str:
    """As the command line takes a value of a scene: "rod" without quotes, others as JSON."""
    return value if isinstance(value, str) else json.dumps(value)


def scene_arguments(
        axes: Mapping[str, object] | None, sets: Mapping[str, object] | None) -> list[str]:
    """`axes`: pointer -> values, or a range such as "pow2:6:12"; `sets`: pointer -> value."""
    arguments: list[str] = []
    for pointer, values in (axes or {}).items():
        if not isinstance(values, str):
            if not isinstance(values, Sequence):
                raise TypeError(f"axes: {pointer}: {values!r} is no list of values")
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
    """Runs the program and waits for it. What it says on stderr goes to `progress` line by line.

    An interrupt of Python (KeyboardInterrupt) ends the program too, which saves what is done first.
    """
    with subprocess.Popen(
            [str(program()), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, encoding="utf-8", errors="replace") as process:
        said: list[str] = []
        errors: list[str] = []

        # Two pipes are read at a time, so that neither fills and holds the program up.
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
            # A notebook's interrupt reaches Python alone.
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
    # Faults of the command line itself have no name before them, and a line on --help after them.
    others = [line for line in finished.errors if line and not line.startswith("Run with --help")]
    said = own or others
    what = said[-1] if said else f"hairbench {arguments[0]} ended with status {finished.status}"
    return ProgramError(finished.status, what)


def succeed(arguments: Sequence[str], progress: Progress | None = to_stderr) -> Finished:
    """call(), where nothing but success will do."""
    finished = call(arguments, progress)
    if finished.status != 0:
        raise failure(finished, arguments)
    return finished


@dataclass(frozen=True)
class RunResult:
    """What a run left: the report's file, the exit status and the table that it printed."""

    path: Path
    status: int
    text: str

    @property
    def verdict(self) -> str:
        """What the comparison with `baseline` says, "ok" without one: a value of VERDICTS."""
        return VERDICTS[self.status]

    def frame(self) -> pandas.DataFrame:
        from .report import read_report
        return read_report(self.path)


@dataclass(frozen=True)
class GateResult:
    """A gate's report as results/gate.schema.json describes it, its file and its exit status."""

    path: Path
    status: int
    text: str
    report: dict[str, Any]

    @property
    def verdict(self) -> str:
        """mismatch, regressed, inconclusive, improved or same."""
        return str(self.report["verdict"])

    @property
    def passed(self) -> bool:
        return self.status == 0

    def frame(self) -> pandas.DataFrame:
        """A row for each judged metric of each case, with its change and interval as shares."""
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
    sets     pointer -> value of every case
    out      the report; the program's own default is results/local/<scene>.json
    options  of `hairbench run --help`, with _ for -: max_time=0.5, no_pictures=True

    Raises ProgramError where the program fails, is interrupted or runs nothing.
    """
    path = Path(out) if out is not None else Path("results/local") / f"{Path(scene).stem}.json"
    arguments = [
        "run", os.fspath(scene), "--out", str(path), *scene_arguments(axes, sets),
        *option_arguments(options)]
    finished = compared(arguments, progress)
    return RunResult(path, finished.status, finished.text)


def gate(
        a: str | os.PathLike[str], b: str | os.PathLike[str], scene: str | os.PathLike[str], *,
        out: str | os.PathLike[str] | None = None, axes: Mapping[str, object] | None = None,
        sets: Mapping[str, object] | None = None, progress: Progress | None = to_stderr,
        **options: Option) -> GateResult:
    """`hairbench gate`: whether build B is slower than build A (docs/comparing.md).

    a, b     a build folder, a program, or a command line
    options  of `hairbench gate --help`, as for run(): pairs=24, calibrate=48, max_time=0

    That B is slower or draws something else is a result and not an exception: see `status`,
    `passed` and `verdict`. Raises ProgramError where the gate itself fails or is interrupted.
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
    """The command `hairbench` of a wheel: becomes the program that lies in the package."""
    installed = PACKAGE / "bin" / "hairbench"
    if not installed.exists():
        sys.exit(f"hairbench: {installed}: this package was installed without the program")
    os.execv(installed, [str(installed), *sys.argv[1:]])
