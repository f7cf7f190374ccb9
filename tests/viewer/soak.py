"""Runs the viewer for a long time: opens each scene of a suite and changes it, again and again.

soak.py PROGRAM MINUTES SUITE.json FOLDER

Writes the script and its outputs to FOLDER. Opens the scenes of the suite in turn, changes what
each draws and simulates, and at its end writes the viewer's state. Then reads the viewer's resident
memory and the time of the scene. Both are taken relative to the scene's own medians, so that scenes
may differ. Fails if memory grows (the Theil-Sen slope after the first third has a 95 % interval by
Kendall's statistic above 0.5 % per hour), if scenes become slower in the same sense by more than
10 % over the whole time, or if the viewer prints something unexpected or ends unexpectedly.
"""

import itertools
import json
import math
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import time

TURNS = 4000  # in the script; the time limit comes first
WARM_SHARE = 1 / 3  # of the turns, while caches fill
MOST_GROWTH = 0.005  # of the memory, per hour
MOST_SLOWING = 0.1  # of a turn, over the whole time

CHANGES = [
    {"/strands/density": 8},
    {"/render/msaa": 4},
    {"/simulation/wind/strength": 12},
    {"/strands/tessellation": 2},
    {"/lod/mode": "forced", "/lod/level": 1},
    {"/shading/model": "marschner"},
    {"/simulation/solver": "ftl", "/simulation/rest": "groom"},
    {"/groom/guides": 120},
    {"/camera/field_of_view": 30},
]


def steps_of(turn: int, scene: str) -> list[dict]:
    steps: list[dict] = [
        {"drop": scene},
        {"set": {"/render/width": 160, "/render/height": 120}},
        {"frames": 2},
    ]
    for change in CHANGES:
        steps += [{"set": change}, {"frames": 1}, {"expect": {"no_problem": True}}]
    return steps + [{"perform": "Undo"}, {"state": f"{turn}.json"}]


def start_display() -> tuple[subprocess.Popen, str]:
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[write_end],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write_end)
    with os.fdopen(read_end) as numbers:
        number = numbers.readline().strip()
    if not number:
        sys.exit("soak.py: no display: Xvfb did not start")
    return server, ":" + number


def resident_kib(process: int) -> int:
    status = pathlib.Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return int(re.search(r"VmRSS:\s+(\d+) kB", status).group(1))


def slope(times: list[float], values: list[float]) -> tuple[float, float, float]:
    """Returns the Theil-Sen slope and the ends of its 95 % interval (Sen 1968, section 6)."""
    slopes = sorted(
        (values[j] - values[i]) / (times[j] - times[i])
        for i, j in itertools.combinations(range(len(times)), 2)
    )
    n, count = len(times), len(slopes)
    spread = 1.96 * math.sqrt(n * (n - 1) * (2 * n + 5) / 18)
    low = max(0, math.floor((count - spread) / 2))
    high = min(count - 1, math.ceil((count + spread) / 2))
    return statistics.median(slopes), slopes[low], slopes[high]


def relative(samples: list[tuple], column: int, first: int, scenes: int) -> list[float]:
    """Returns samples from `first` on, each over the median of its own scene's from there on."""
    medians = [
        statistics.median(each[column] for i, each in enumerate(samples) if i >= first and i % scenes == scene)
        for scene in range(scenes)
    ]
    return [each[column] / medians[i % scenes] for i, each in enumerate(samples) if i >= first]


def main() -> int:
    program, minutes, suite, folder = sys.argv[1:]
    out = pathlib.Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    for old in out.glob("*.json"):
        old.unlink()
    suite_path = pathlib.Path(suite).resolve()
    scenes = [
        str(suite_path.parent / name)
        for name in json.loads(suite_path.read_text(encoding="utf-8"))["suite"]
    ]
    script = {
        "steps": [step for i in range(TURNS) for step in steps_of(i, scenes[i % len(scenes)])]
    }
    (out / "script.json").write_text(json.dumps(script), encoding="utf-8")

    server, display = start_display()
    environment = {**os.environ, "DISPLAY": display}
    environment.pop("WAYLAND_DISPLAY", None)
    samples: list[tuple[float, float, float]] = []  # s since the start, KiB, s per turn
    started = time.monotonic()
    last = started
    with open(out / "log", "w", encoding="utf-8") as log:
        viewer = subprocess.Popen(
            [program, "view", scenes[0], "--script", str(out / "script.json")],
            cwd=out,
            env=environment,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
        try:
            for turn in range(TURNS):
                while not (out / f"{turn}.json").exists():
                    if viewer.poll() is not None or time.monotonic() > started + 60 * float(minutes):
                        break
                    time.sleep(0.02)
                else:
                    now = time.monotonic()
                    samples.append((now - started, resident_kib(viewer.pid), now - last))
                    last = now
                    print(
                        f"{pathlib.Path(scenes[turn % len(scenes)]).stem}: {samples[-1][1]} KiB, "
                        f"{samples[-1][2]:.1f} s",
                        flush=True,
                    )
                    continue
                break
            ended_early = viewer.poll() is not None
        finally:
            viewer.send_signal(signal.SIGINT)
            status = viewer.wait(timeout=60)
            server.terminate()
            server.wait()

    said = (out / "log").read_text(encoding="utf-8", errors="replace")
    problems = [
        line
        for line in said.splitlines()
        if re.search(r"error|problem|validation|invalid|hazard", line, re.IGNORECASE)
    ]
    failures = [f"the viewer said: {line}" for line in problems]
    if ended_early or status != 130:
        failures.append(f"the viewer ended by itself, or not by the signal: status {status}")
    first = math.ceil(len(samples) * WARM_SHARE)
    if len(samples) - first < 3 * len(scenes):
        failures.append(f"{len(samples)} turns are too few to say how memory grows")
    else:
        times = [each[0] / 3600 for each in samples[first:]]
        hours = times[-1] - times[0]
        memory, growth_low, growth_high = slope(times, relative(samples, 1, first, len(scenes)))
        longer, longer_low, longer_high = slope(times, relative(samples, 2, first, len(scenes)))
        print(
            f"{len(samples)} turns in {samples[-1][0] / 60:.1f} min, at most "
            f"{max(each[1] for each in samples) / 1024:.0f} MiB; of the last {len(times)}: memory "
            f"{memory:+.2%} an hour ({growth_low:+.2%} to {growth_high:+.2%}), turns "
            f"{longer * hours:+.1%} longer over the time "
            f"({longer_low * hours:+.1%} to {longer_high * hours:+.1%})"
        )
        if growth_low > MOST_GROWTH:
            failures.append("memory grows")
        if longer_low * hours > MOST_SLOWING:
            failures.append("turns become longer")
    for failure in failures:
        print(f"soak.py: {failure}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
