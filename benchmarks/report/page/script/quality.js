// ---- Error against time ------------------------------------------------------------------------

const quality = {};

// Errors, of which less is better: 1 - SSIM, and PSNR as it is.
const kErrors = {
    "image.ssim": {title: "1 \u2212 image.ssim", of: (value) => 1 - value},
};
function errorOf(row) {
    const value = median(row, quality.error);
    return value === undefined ? undefined : (kErrors[quality.error]?.of(value) ?? value);
}
function errorTitle(name) {
    return kErrors[name]?.title ?? metricTitle(name, metricUnits.get(name));
}
function moreIsBetter() { return quality.error === "image.psnr"; }

function qualityRows() {
    return filteredOk().filter((row) => errorOf(row) !== undefined &&
        median(row, quality.time) !== undefined);
}

// Cases that no other one beats in both.
function bestRows(found) {
    const sign = moreIsBetter() ? -1 : 1;
    const sorted = [...found].sort((a, b) =>
        median(a, quality.time) - median(b, quality.time) || sign * (errorOf(a) - errorOf(b)));
    let least = Infinity;
    return sorted.filter((row) => {
        if (sign * errorOf(row) >= least) return false;
        least = sign * errorOf(row);
        return true;
    });
}

function qualityTrace(found, index, name) {
    const metrics = found.map((row) => row.metrics[quality.time]);
    return {
        type: "scatter", mode: "markers", name: plain(name),
        x: metrics.map((metric) => metric.median), y: found.map(errorOf),
        error_x: {...errorBars(metrics, "interval"), color: seriesColor(index), thickness: 1},
        marker: {color: seriesColor(index), size: 10, symbol: seriesSymbol(index)},
        hoverinfo: "text", customdata: found.map((row) => row.id),
        text: found.map((row) => plain(`${quantity(median(row, quality.time), "ms")}, ` +
            `${errorTitle(quality.error)} ${number(errorOf(row))}`) +
            `<br>${plain(caseLabel(row))}`),
    };
}

function drawQuality() {
    const div = byId("quality-plot"), found = qualityRows(), axis = axisOf.get(quality.color);
    const traces = axis
        ? axis.values.map((value, index) => qualityTrace(found.filter((row) =>
            valueText(row.values[axis.pointer]) === valueText(value)), index, valueText(value)))
        : [qualityTrace(found, 0, "cases")];
    const best = bestRows(found);
    traces.push({
        type: "scatter", mode: "lines", name: "not beaten", hoverinfo: "skip",
        x: best.map((row) => median(row, quality.time)), y: best.map(errorOf),
        line: {color: color("faint"), width: 1.5, dash: "dot", shape: "hv"},
    });
    drawFigure(div, traces, {
        legend: legendStyle(div, axis?.label),
        xaxis: axisStyle({...scaleStyle(quality.xType), title: metricTitle(quality.time, "ms")}),
        yaxis: axisStyle({...scaleStyle(quality.yType), title: plain(errorTitle(quality.error))}),
    });
    byId("quality-note").textContent = `${counted(found.length, "case")}. Dotted: those that no ` +
        "other case beats in both time and error. Reference: the scene's /run/reference.";
}

function buildQuality() {
    const section = byId("quality");
    if (!imageMetrics.length) {
        showOnly(section, heading("Quality and cost"), note(
            "No case was compared with a reference picture: the scene names none " +
            "(/run/reference)."));
        return;
    }
    Object.assign(quality, {
        error: preferred(imageMetrics, "image.flip"), time: preferred(timeMetrics, "frame.time"),
        color: severalReports ? kReportAxis : axes[0]?.pointer ?? "", xType: "linear",
        yType: "linear"});
    const change = (key) => (value) => {
        quality[key] = value;
        drawQuality();
    };
    showOnly(section, heading("Quality and cost"),
        element("div", {class: "controls"},
            choice("error", "quality-error", imageMetrics.map((name) => [name, errorTitle(name)]),
                quality.error, change("error")),
            choice("time", "quality-time", timeMetrics.map((name) => [name, name]), quality.time,
                change("time")),
            choice("colour", "quality-color", [["", "none"], ...axisChoices(axes)], quality.color,
                change("color")),
            choice("x scale", "quality-x", kScales, quality.xType, change("xType")),
            choice("y scale", "quality-y", kScales, quality.yType, change("yType"))),
        figure("quality-plot", "Error of the pictures against time; the table has the figures."),
        element("p", {class: "note", id: "quality-note"}));
    drawQuality();
    onFilterChange(drawQuality);
    onThemeChange(drawQuality);
    byId("quality-plot").on("plotly_click",
        (event) => event.points[0].customdata &&
            showSamplesOf(event.points[0].customdata, quality.time));
}
