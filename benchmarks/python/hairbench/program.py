"""Finds and calls the program hairbench."""

from __future__ import annotations

import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Union, overload

if TYPE_CHECKING:
    import numpy
    import pandas
    from typing_extensions import Unpack

    from .keywords import Axes, GateOptions, PhysicsOptions, RenderOptions, RunOptions, Sets
    from .keywords import SimulateOptions

    AnyPath = Union[str, os.PathLike[str]]

Progress = Callable[[str], object]  # called with each line that the program prints meanwhile

# Defaults. If None were allowed too, a checker would not say which pointer is wrong.
NO_AXES: Axes = {}
NO_SETS: Sets = {}
NO_LIMITS: Mapping[str, float] = {}

PROGRAM_VARIABLE = "HAIRBENCH_PROGRAM"
PACKAGE = Path(__file__).resolve().parent

# Exit statuses (README.md) that are results of a comparison, not failures.
VERDICTS = {0: "ok", 10: "slower", 11: "inconclusive", 12: "differs"}


class ProgramError(RuntimeError):
    """The program failed.

    status   as in docs/comparing.md
    pointer  JSON pointer of the field at fault, such as "/strands/density"; None: no single field is

    Its text is the program's last message, "file: /pointer: reason".
    """

    def __init__(self, status: int, message: str):
        super().__init__(message)
        self.status = status
        self.pointer = pointer_in(message)


def pointer_in(message: str) -> str | None:
    """Returns the last pointer before the reason. A path of the system also begins with a slash."""
    found = None
    for part in message.split(": ")[:-1]:
        if part.startswith("/") and " " not in part and not Path(part).exists():
            found = part
    return found


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


def option_arguments(options: Mapping[str, object]) -> list[str]:
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
        elif isinstance(value, Iterable):
            for each in value:
                arguments += [flag, str(each)]
        else:
            raise TypeError(f"{name}: {value!r} is not a value of an option")
    return arguments


def plain(value: Any) -> Any:
    """Returns numpy's arrays and scalars as lists and numbers."""
    return value.tolist() if hasattr(value, "tolist") else value


def json_text(value: object) -> str:
    """Returns a scene's value for the command line: "rod" without quotes, other types as JSON."""
    value = plain(value)
    return value if isinstance(value, str) else json.dumps(value)


def scene_arguments(axes: Axes, sets: Sets) -> list[str]:
    """`axes`: pointer -> values, or a range such as "pow2:6:12"; `sets`: pointer -> value."""
    arguments: list[str] = []
    for pointer, given in axes.items():
        values = plain(given)
        if not isinstance(values, str):
            if not isinstance(values, Sequence):
                raise TypeError(f"axes: {pointer}: {values!r} is not a list of values")
            values = ",".join(json_text(value) for value in values)
        arguments += ["--axis", f"{pointer}={values}"]
    for pointer, value in sets.items():
        arguments += ["--set", f"{pointer}={json_text(value)}"]
    return arguments


def to_stderr(line: str) -> None:
    """Prints progress. In a notebook, calls show one NotebookBar instead."""
    print(line, file=sys.stderr, flush=True)


def in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return hasattr(shell, "kernel")


class NotebookBar:
    """Shows the program's progress in a notebook as a bar, and its other lines as to_stderr() does.

    A line of progress is "[3/12] 0:41, about 1:50 left  smoke/msaa:4". The bar vanishes with close().
    """

    SECONDS = "1"  # between lines of progress

    def __init__(self) -> None:
        self.handle: Any = None

    def __call__(self, line: str) -> None:
        found = re.match(r"\[(\d+)/(\d+)\] ", line)
        if not found:
            to_stderr(line)
            return
        number, total = map(int, found.groups())
        self.show(f'<progress value="{number - 1}" max="{total}"></progress> {html.escape(line)}')

    def show(self, text: str) -> None:
        notebook = sys.modules["IPython"].display
        if self.handle is None:
            self.handle = notebook.display(notebook.HTML(text), display_id=True)
        else:
            self.handle.update(notebook.HTML(text))

    def close(self) -> None:
        if self.handle is not None:
            self.show("")


@dataclass(frozen=True)
class Finished:
    status: int
    text: str  # stdout
    errors: list[str]  # the lines of stderr


def call(arguments: Sequence[str], progress: Progress | None = to_stderr) -> Finished:
    """Runs the program and waits for it. Passes each line of its stderr to `progress`.

    A KeyboardInterrupt also interrupts the program, which first saves what is done.
    """
    if progress is to_stderr and in_notebook():
        bar = NotebookBar()
        try:
            return call(arguments, bar)
        finally:
            bar.close()
    environment = dict(os.environ)
    if isinstance(progress, NotebookBar):
        environment["HAIRBENCH_PROGRESS_SECONDS"] = NotebookBar.SECONDS
    with subprocess.Popen(
            [str(program()), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, encoding="utf-8", errors="replace", env=environment) as process:
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
    """A gate's report (results/gate.schema.json; of `probes` and `shaders` that of `hairbench compare
    --json`), its file and its exit status."""

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
        scene: AnyPath, *, out: AnyPath | None = None, axes: Axes = NO_AXES, sets: Sets = NO_SETS,
        progress: Progress | None = to_stderr, **options: Unpack[RunOptions]) -> RunResult:
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

    positions: dict[str, numpy.ndarray[Any, Any]]
    written: dict[str, Any] = field(repr=False)  # `hairbench simulate --json`
    table: Path | None = None  # of probes; None: none were asked for

    def probes(self) -> pandas.DataFrame:
        """Returns a row per case, frame and probe, as read_probes() does.

        Raises ValueError if none were asked for.
        """
        import pandas

        from .report import axis_value

        if self.table is None:
            raise ValueError("no probes were asked for: sets={'/run/probes/speed': True}")
        wide = pandas.read_csv(self.table).rename(columns={"probe.time": "time"})
        frames: list[pandas.DataFrame] = []
        axes = dict.fromkeys(pointer for case in self.written["cases"] for pointer in case["axes"])
        for case in self.written["cases"]:
            # Columns without a number are of probes that other cases have.
            own = wide[wide["case"] == case["name"]].dropna(axis="columns", how="all")
            frame = own.melt(["case", "frame", "time"], var_name="probe")
            frame["unit"] = frame["probe"].map(self.written["probes"]["units"])
            for pointer, value in case["axes"].items():
                frame[pointer] = pandas.Series([axis_value(value)] * len(frame))
            frames.append(frame)
        tidy = pandas.concat(frames, ignore_index=True)
        tidy["probe"] = tidy["probe"].str.removeprefix("probe.")
        return tidy.reindex(
            columns=["case", *axes, "frame", "time", "probe", "unit", "value"])


def simulate(
        scene: AnyPath, *, out: AnyPath, axes: Axes = NO_AXES, sets: Sets = NO_SETS,
        frames: int = 60, progress: Progress | None = to_stderr,
        **options: Unpack[SimulateOptions]) -> Simulation:
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
        "simulate", os.fspath(scene), "--guides", "--json", "--frames", str(frames),
        "--export", str(Path(out) / "{case}.npy"), *scene_arguments(axes, sets),
        *option_arguments(options)]
    asks = any(pointer.startswith("/run/probes") for pointer in (*axes, *sets))
    table = Path(out) / "probes.csv" if asks else None
    if table:
        arguments += ["--probes", str(table)]
    written = json.loads(succeed(arguments, progress).text)
    return Simulation(
        {case["name"]: numpy.load(case["file"], mmap_mode="r") for case in written["cases"]},
        written, table)


def draw(
        pattern: str, scene: AnyPath, arguments: Sequence[str], progress: Progress | None
) -> list[tuple[dict[str, Any], numpy.ndarray[Any, Any]]]:
    """Returns each case that `hairbench render` drew to files of this name, and its first picture."""
    import numpy

    with tempfile.TemporaryDirectory(prefix="hairbench-") as folder:
        written = json.loads(succeed(
            ["render", os.fspath(scene), "--json", "--out", str(Path(folder) / pattern),
             *arguments], progress).text)
        return [(case, numpy.load(case["pictures"][0]["file"])) for case in written["cases"]]


@overload
def render(
        scene: AnyPath, *, frame: int = 0, linear: bool = False,
        sets: Sets = NO_SETS, progress: Progress | None = to_stderr,
        **options: Unpack[RenderOptions]) -> numpy.ndarray[Any, Any]: ...


@overload
def render(
        scene: AnyPath, *, axes: Axes, frame: int = 0,
        linear: bool = False, sets: Sets = NO_SETS, progress: Progress | None = to_stderr,
        **options: Unpack[RenderOptions]) -> dict[str, numpy.ndarray[Any, Any]]: ...


def render(
        scene: AnyPath, *, frame: int = 0, linear: bool = False, axes: Axes = NO_AXES,
        sets: Sets = NO_SETS, progress: Progress | None = to_stderr,
        **options: Unpack[RenderOptions]
) -> numpy.ndarray[Any, Any] | dict[str, numpy.ndarray[Any, Any]]:
    """`hairbench render`: draws one frame of a scene, or of every case of a sweep.

    frame    frame to draw, from 0
    linear   linear radiance before exposure and tone map, instead of what a display shows
    axes     pointer -> values: draws a picture for each case
    sets     pointer -> value for every case
    options  as in `hairbench render --help`, with _ for -

    Returns uint8 [row, column, RGBA], or with `linear` float32 [row, column, RGB], top row first.
    With `axes` returns case's name -> such an array. Raises ProgramError if the program fails or is
    interrupted.
    """
    drawn = draw("{case}.npy" if axes else "picture.npy", scene, [
        "--frame", str(frame), *(["--linear"] if linear else []), *scene_arguments(axes, sets),
        *option_arguments(options)], progress)
    pictures = {case["name"]: picture for case, picture in drawn}
    return pictures if axes else next(iter(pictures.values()))


PictureMetric = Callable[["numpy.ndarray[Any, Any]", "numpy.ndarray[Any, Any]"], float]


@dataclass(frozen=True)
class PictureResult:
    """Metrics of every case's picture: case's name -> picture, and a row per case and metric."""

    pictures: dict[str, numpy.ndarray[Any, Any]] = field(repr=False)
    rows: list[dict[str, Any]] = field(repr=False)

    @property
    def passed(self) -> bool:
        """Returns whether no value is above its limit, or NaN with one."""
        return all(row["passed"] is not False for row in self.rows)

    def frame(self) -> pandas.DataFrame:
        """Returns a row per case and metric: `case`, the value on each axis under its pointer,
        `metric`, `value`, `limit` and `passed`, which are None without a limit."""
        import pandas
        return pandas.DataFrame(self.rows)


def measure_pictures(
        scene: AnyPath, metric: PictureMetric | Mapping[str, PictureMetric], *,
        reference: numpy.ndarray[Any, Any] | None = None, reference_sets: Sets = NO_SETS,
        axes: Axes = NO_AXES, sets: Sets = NO_SETS,
        at_most: float | Mapping[str, float] = NO_LIMITS, frame: int = 0, linear: bool = False,
        progress: Progress | None = to_stderr, **options: Unpack[RenderOptions]) -> PictureResult:
    """Draws a frame of every case of a sweep, and its distance from a reference by metrics of one's own.

    metric     function of a picture and its reference, arrays as render() returns; or several by name
    reference  a picture for all cases; or instead
    reference_sets  pointer -> value: each case's reference is the case with these values
    axes, sets, frame, linear, options  as for render()
    at_most    greatest value that passes, for all metrics or by name; NaN never passes

    Raises ProgramError if the program fails or is interrupted, ValueError without a reference or if one
    has another shape than its picture, and whatever a metric raises.
    """
    if (reference is None) == (not reference_sets):
        raise ValueError("expected either reference or reference_sets")
    metrics = metric if isinstance(metric, Mapping) else {
        getattr(metric, "__name__", type(metric).__name__): metric}
    common = ["--frame", str(frame), *(["--linear"] if linear else []), *option_arguments(options)]
    drawn = draw("{case}.npy", scene, [*common, *scene_arguments(axes, sets)], progress)

    from .report import axis_value

    def key(case: dict[str, Any]) -> tuple[Any, ...]:
        return tuple((pointer, axis_value(value)) for pointer, value in sorted(case["axes"].items())
                     if pointer not in reference_sets)

    wanted: dict[tuple[Any, ...], numpy.ndarray[Any, Any]] = {}
    if reference is None:
        changed: Any = {**axes, **{pointer: [value] for pointer, value in reference_sets.items()}}
        wanted = {key(case): picture for case, picture in draw(
            "{case}.npy", scene, [*common, *scene_arguments(changed, sets)], progress)}
    rows = []
    for case, picture in drawn:
        expected = wanted[key(case)] if reference is None else reference
        if expected.shape != picture.shape:
            raise ValueError(
                f"{case['name']}: the reference has the shape {expected.shape}, not {picture.shape}")
        for name, of in metrics.items():
            value = float(of(picture, expected))
            limit = at_most.get(name) if isinstance(at_most, Mapping) else at_most
            rows.append({
                "case": case["name"],
                **{pointer: axis_value(each) for pointer, each in case["axes"].items()},
                "metric": name, "value": value, "limit": limit,
                "passed": None if limit is None else value <= limit})
    return PictureResult({case["name"]: picture for case, picture in drawn}, rows)


def gate(
        a: AnyPath, b: AnyPath, scene: AnyPath, *, out: AnyPath | None = None,
        axes: Axes = NO_AXES, sets: Sets = NO_SETS, progress: Progress | None = to_stderr,
        **options: Unpack[GateOptions]) -> GateResult:
    """`hairbench gate`: whether build B is slower than build A (docs/comparing.md), or with
    probes=True whether its hair moves otherwise.

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


@dataclass(frozen=True)
class PhysicsResult:
    """A report of the checks of solvers (results/physics.schema.json), its file and exit status."""

    path: Path
    status: int
    text: str
    report: dict[str, Any]

    @property
    def passed(self) -> bool:
        return self.status == 0

    def frame(self) -> pandas.DataFrame:
        """Returns a row per outcome: `check`, `solver`, `quantity`, `measured`, `expected`, `error`,
        `tolerance`, `verdict` and others, and each parameter under its name."""
        import pandas

        rows = []
        for outcome in self.report["outcomes"]:
            row = {name: value for name, value in outcome.items() if name != "parameters"}
            for name, parameter in outcome.get("parameters", {}).items():
                row.setdefault(name, parameter["value"])
            rows.append(row)
        return pandas.DataFrame(rows)


CHECK_FAILED = 3  # exit status: a check of physics did not pass


def physics(
        *, out: AnyPath | None = None, progress: Progress | None = to_stderr,
        **options: Unpack[PhysicsOptions]) -> PhysicsResult:
    """`hairbench physics`: compares the solvers with theory (docs/physics.md).

    out      the report; the program's own default is results/local/physics.json
    options  as in `hairbench physics --help`: solver="rod", check="cantilever"

    A check that fails is a result, not an exception: see `passed`. Raises ProgramError if the
    program itself fails or is interrupted.
    """
    path = Path(out) if out is not None else Path("results/local") / "physics.json"
    arguments = ["physics", "--out", str(path), *option_arguments(options)]
    finished = call(arguments, progress)
    if finished.status not in (0, CHECK_FAILED):
        raise failure(finished, arguments)
    report = json.loads(path.read_text(encoding="utf-8"))
    return PhysicsResult(path, finished.status, finished.text, report)


def main() -> None:
    """The command `hairbench` of a wheel: replaces itself by the program in the package."""
    installed = PACKAGE / "bin" / "hairbench"
    if not installed.exists():
        sys.exit(f"hairbench: {installed}: this package was installed without the program")
    os.execv(installed, [str(installed), *sys.argv[1:]])
