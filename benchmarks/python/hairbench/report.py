"""Reads reports of `hairbench run` as pandas frames. results/README.md has every field."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas

SCHEMA = "hairbench-report/1."

# Members of a metric, except its median, that become columns under their own names.
OTHER_FIGURES = (
    "mad", "mean", "minimum", "first_quartile", "third_quartile", "maximum",
    "percentile_5", "percentile_95", "percentile_99", "relative_deviation", "effective_samples",
    "missing_samples")


def axis_value(value: Any) -> Any:
    """Returns a hashable value, for grouping: lists as tuples, objects as JSON."""
    if isinstance(value, list):
        return tuple(axis_value(each) for each in value)
    return json.dumps(value) if isinstance(value, dict) else value


def case_columns(case: dict[str, Any]) -> dict[str, Any]:
    columns = {"case": case["name"]}
    columns |= {pointer: axis_value(value) for pointer, value in case["axes"].items()}
    columns |= {
        "status": case["status"],
        "reason": case.get("reason"),
        "backend": case.get("backend", {}).get("name"),
        "warnings": len(case.get("trust", {}).get("warnings", [])),
        "verdict": case.get("trust", {}).get("verdict"),
        "reasons": "; ".join(case.get("trust", {}).get("reasons", [])),
    }
    return columns | {f"counts.{name}": count for name, count in case.get("counts", {}).items()}


def metric_columns(name: str, metric: dict[str, Any]) -> dict[str, Any]:
    interval = metric.get("interval", {})
    columns = {
        "metric": name, "unit": metric["unit"], "hint": metric.get("hint"),
        "mode": metric.get("mode"), "median": metric.get("median"),
        "lower": interval.get("lower"), "upper": interval.get("upper"),
        "confidence": interval.get("confidence"),
        "samples": metric.get("sample_count", len(metric.get("samples", [])))}
    return columns | {figure: metric.get(figure) for figure in OTHER_FIGURES}


def parsed(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Raises ValueError "path: reason" if the file is not a report."""
    try:
        report: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{path}: is not JSON: {error}") from None
    schema = report.get("schema", "") if isinstance(report, dict) else ""
    if not isinstance(schema, str) or not schema.startswith(SCHEMA):
        raise ValueError(f"{path}: /schema: {schema!r} is not {SCHEMA}*, a report of hairbench run")
    return report


def samples_of(
        path: Path, case: str, metric: str, entry: dict[str, Any]) -> list[float | None]:
    """Returns the samples of a metric, from the file beside the report if they are many. None stands
    for a frame in which a probe has no finite value."""
    samples: list[float | None]
    if "samples_file" not in entry:
        samples = entry["samples"]
        return samples
    with open(path.parent / entry["samples_file"], encoding="utf-8") as lines:
        for line in map(json.loads, lines):
            if (line["case"], line["metric"]) == (case, metric):
                samples = line["samples"]
                return samples
    raise ValueError(f"{path}: {entry['samples_file']} lacks {metric} of {case}")


def read_probes(path: str | os.PathLike[str]) -> pandas.DataFrame:
    """Returns a row per probe (/run/probes), frame and case: what the guides did over time.

    Columns: `case`, the value on each axis under its JSON pointer, `frame` (from 0, the start of
    the hair), `time` (simulated s), `probe` ("tip_displacement.mean"), `unit`, `value` (NaN where it
    is not finite). No rows without probes.

    Raises ValueError "path: reason" if the file is not a report.
    """
    import pandas

    report = parsed(path)
    frames = []
    axes = dict.fromkeys(pointer for case in report["cases"] for pointer in case["axes"])
    columns = ["case", *axes, "frame", "time", "probe", "unit", "value"]
    for case in report["cases"]:
        probes = {
            name: metric for name, metric in (case.get("metrics") or {}).items()
            if name.startswith("probe.") and name != "probe.pass.time"}
        if "probe.time" not in probes:
            continue
        times = samples_of(Path(path), case["name"], "probe.time", probes.pop("probe.time"))
        common = {"case": case["name"]}
        common |= {pointer: axis_value(value) for pointer, value in case["axes"].items()}
        for name, metric in probes.items():
            frame = pandas.DataFrame({
                "frame": range(len(times)), "time": times, "probe": name.removeprefix("probe."),
                "unit": metric["unit"],
                "value": pandas.Series(
                    samples_of(Path(path), case["name"], name, metric), dtype=float)})
            for column, value in common.items():
                frame[column] = pandas.Series([value] * len(frame))
            frames.append(frame)
    joined = pandas.concat(frames, ignore_index=True) if frames else pandas.DataFrame()
    return joined.reindex(columns=columns)


def read_report(path: str | os.PathLike[str]) -> pandas.DataFrame:
    """Returns a row per metric of each case, and one without metrics for a skipped or failed case.

    Columns: `case`, the value on each axis under its JSON pointer, `status`, `reason`, `backend`,
    `warnings` (their number), `verdict` (trusted, doubtful or untrusted; missing from older reports)
    and its `reasons`, `counts.strands` and other counts; `metric`, `unit`, `hint` (whether
    lower or higher is better), `mode`, `median`, the bounds `lower` and `upper` of its interval,
    `confidence`, and the metric's other figures under their names. Unknown values are missing.
    `frame.attrs` has `path`, `schema`, `scene`, `environment` and `interrupted`.

    Raises ValueError "path: reason" if the file is not a report.
    """
    import pandas

    report = parsed(path)
    rows = []
    for case in report["cases"]:
        common = case_columns(case)
        metrics = case.get("metrics") or {}
        rows += [common | metric_columns(name, metric) for name, metric in metrics.items()]
        if not metrics:
            rows.append(common)
    axes = dict.fromkeys(pointer for case in report["cases"] for pointer in case["axes"])
    counts = dict.fromkeys(
        name for row in rows for name in row if name.startswith("counts."))
    columns = [
        "case", *axes, "status", "reason", "backend", "warnings", "verdict", "reasons", *counts,
        "metric", "unit", "hint", "mode", "median", "lower", "upper", "confidence", "samples",
        *OTHER_FIGURES]
    frame = pandas.DataFrame(rows, columns=columns)
    for name in columns[columns.index("median"):]:
        frame[name] = pandas.to_numeric(frame[name])
    frame.attrs = {
        "path": str(path), "schema": report["schema"], "scene": report["scene"]["path"],
        "environment": report["environment"], "interrupted": report.get("interrupted", False)}
    return frame
