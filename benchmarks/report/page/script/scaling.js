// ---- A metric over an axis ---------------------------------------------------------------------

const scaling = {held: new Map()};  // pointer -> text of the value it is held at; absent: all

// An axis whose value follows from x's is no other axis: tied axes move together.
function followsFrom(axis, x) {
    const seen = new Map();
    return rows.every((row) => {
        const at = valueText(row.values[x.pointer]), value = valueText(row.values[axis.pointer]);
        if (!seen.has(at)) seen.set(at, value);
        return seen.get(at) === value;
    });
}

function freeAxes() {
    const x = axisOf.get(scaling.x);
    return axes.filter((axis) => axis !== x && !followsFrom(axis, x));
}

function suitsLog(values) {
    return values.every((value) => value > 0) && Math.max(...values) >= 8 * Math.min(...values);
}

// How many of an axis's values have figures.
function measuredValues(axis) {
    return new Set(rows.filter((row) => row.status === "ok")
        .map((row) => valueText(row.values[axis.pointer]))).size;
}

function startScaling() {
    const sized = [...sweptAxes].sort(
        (a, b) => b.numeric - a.numeric || measuredValues(b) - measuredValues(a));
    scaling.x = sized[0].pointer;
    const free = freeAxes().sort((a, b) => measuredValues(b) - measuredValues(a));
    scaling.color = severalReports ? kReportAxis : free[0]?.pointer ?? "";
    scaling.facet = "";
    scaling.metric = preferred(metricNames, "frame.time");
    scaling.spread = hasIntervals ? "interval" : "quartiles";
    scaling.xType = sized[0].numeric && suitsLog(sized[0].values) ? "log" : "linear";
    scaling.yType = "linear";
    holdOthers();
}

// More lines than anyone tells apart: the other axes are held at their first value.
function holdOthers() {
    const others = freeAxes().filter(
        (axis) => ![scaling.color, scaling.facet, kReportAxis].includes(axis.pointer));
    const colors = axisOf.get(scaling.color)?.values.length ?? 1;
    const lines = others.reduce((product, axis) => product * axis.values.length, colors);
    scaling.held.clear();
    if (lines > Math.max(6, colors))
        for (const axis of others) scaling.held.set(axis.pointer, valueText(axis.values[0]));
}

function scalingRows() {
    return filteredOk().filter((row) => row.metrics[scaling.metric] && [...scaling.held].every(
        ([pointer, text]) => valueText(row.values[pointer]) === text));
}

// Lines of the plot: the rows that differ in x only.
function scalingLines() {
    const free = freeAxes();
    const lines = new Map();
    for (const row of scalingRows()) {
        const key = free.map((axis) => valueText(row.values[axis.pointer])).join("\n");
        lines.set(key, [...(lines.get(key) ?? []), row]);
    }
    return [...lines.values()];
}

function drawScaling() {
    const div = byId("scaling-plot");
    const facet = axisOf.get(scaling.facet);
    const shown = new Set(scalingRows().map(
        (row) => facet && valueText(row.values[facet.pointer])));
    const facets = facet ? facet.values.map(valueText).filter((text) => shown.has(text)) : [];
    const lines = scalingLines(), seen = {dashes: new Map(), names: new Set()};
    const traces = lines.map((line) => scalingTrace(line, facets, seen));
    drawFigure(div, traces, {
        ...facetAxes(div, facets), showlegend: traces.length > 1,
        legend: legendStyle(div, axisOf.get(scaling.color)?.label),
    });
    const warned = scalingRows().some((row) => row.warnings.length);
    const bars = {interval: "Bars: the interval of the median, 95 % or what the samples allow.",
        quartiles: "Bars: first to third quartile of the samples.", none: ""}[scaling.spread];
    byId("scaling-note").textContent = [
        `${counted(lines.length, "line")}, ${counted(scalingRows().length, "case")}.`, bars,
        hasIntervals ? "" : "The report has no intervals of medians.",
        warned ? "Open markers: cases with warnings." : ""].filter(Boolean).join(" ");
}
