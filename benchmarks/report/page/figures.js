// ---- Where the time of a frame goes ------------------------------------------------------------

const kBarHeight = 24;  // px
const passes = {order: "sweep", limit: 24, scale: "ms"};

function passSum(row) {
    return passMetrics.reduce((sum, name) => sum + (median(row, name) ?? 0), 0);
}

function passRows() {
    const measured = filteredOk().filter((row) => passMetrics.some((name) => row.metrics[name]));
    if (passes.order === "time") measured.sort((a, b) => passSum(b) - passSum(a));
    // The same case of several reports side by side.
    else measured.sort((a, b) => a.number - b.number || a.reportIndex - b.reportIndex);
    return measured;
}

function passHover(row, name) {
    const metric = row.metrics[name];
    if (!metric) return "";
    return [`<b>${plain(passName(name))}: ${plain(quantity(metric.median, metric.unit))}</b>`,
        `${percent(metric.median / passSum(row))} of the passes`,
        metric.mode ? plain(`timed: ${metric.mode}`) : "",
        plain(caseLabel(row))].filter(Boolean).join("<br>");
}

function passTrace(name, index, shown, labels) {
    const share = passes.scale === "share";
    return {
        type: "bar", orientation: "h", name: plain(passName(name)), y: labels,
        x: shown.map((row) => share
            ? 100 * (median(row, name) ?? 0) / passSum(row) : median(row, name) ?? null),
        marker: {color: seriesColor(index), line: {color: color("card"), width: 0.6},
            pattern: {shape: seriesPattern(index), fillmode: "overlay", size: 6}},
        hovertext: shown.map((row) => passHover(row, name)), hoverinfo: "text",
        textposition: "none",
    };
}

function wallTrace(shown, labels) {
    return {
        type: "scatter", mode: "markers", name: "frame.isolated.time", y: labels,
        x: shown.map((row) => median(row, "frame.isolated.time") ?? null),
        marker: {symbol: "diamond-tall-open", size: 10, color: color("text"), line: {width: 1.6}},
        hovertext: shown.map((row) => plain("CPU clock, submission to completion: " +
            quantity(median(row, "frame.isolated.time"), "ms"))),
        hoverinfo: "text",
    };
}

function drawPasses() {
    const div = byId("passes-plot");
    const all = passRows(), shown = all.slice(0, passes.limit);
    // Plotly joins bars of equal names: places tell them apart, names label them.
    const places = shown.map((_, place) => place);
    const used = passMetrics.filter((name) => shown.some((row) => row.metrics[name]));
    const traces = used.map((name) =>
        passTrace(name, passMetrics.indexOf(name), shown, places));
    if (passes.scale === "ms" && metricNames.includes("frame.isolated.time"))
        traces.push(wallTrace(shown, places));
    const narrow = isNarrow(div);
    drawFigure(div, traces, {
        barmode: "stack", bargap: 0.25, height: shown.length * kBarHeight + (narrow ? 220 : 110),
        xaxis: axisStyle({title: passes.scale === "share" ? "share (%)" : "time (ms)",
            rangemode: "tozero"}),
        yaxis: axisStyle({tickmode: "array", tickvals: places, ticktext: shown.map((row) =>
            plain(shortened(caseValues(row), narrow ? 24 : 60))), range: [shown.length - 0.5, -0.5],
        showgrid: false, zeroline: false, ticklabelstandoff: 4}),
        legend: {...legendStyle(div), traceorder: "normal"}, hovermode: "closest",
    });
    byId("passes-note").textContent = [
        axes.length ? `Rows: ${caseValuesTitle()}.` : "",
        shown.length < all.length
            ? `${shown.length} of ${all.length} cases; the filter chooses.` : "",
        "Medians. Each pass was timed by itself, between full barriers; overlapped frames may " +
            "take less.",
    ].filter(Boolean).join(" ");
}

function buildPasses() {
    const section = byId("passes");
    if (!passMetrics.length) {
        showOnly(section, heading("Passes"), note("No pass was timed."));
        return;
    }
    const change = (key, convert) => (value) => {
        passes[key] = convert(value);
        drawPasses();
    };
    const limits = [24, 60, 1000].map((limit) => [
        limit, limit === 1000 ? "all" : `first ${limit}`]);
    showOnly(section, heading("Passes"),
        element("div", {class: "controls"},
            choice("order", "passes-order",
                [["sweep", "as in the sweep"], ["time", "slowest first"]], passes.order,
                change("order", String)),
            choice("scale", "passes-scale", [["ms", "ms"], ["share", "share"]], passes.scale,
                change("scale", String)),
            choice("cases", "passes-limit", limits, passes.limit, change("limit", Number))),
        figure("passes-plot",
            "Times of the passes of each case, stacked; the table has the figures."),
        element("p", {class: "note", id: "passes-note"}));
    drawPasses();
    onFilterChange(drawPasses);
    onThemeChange(drawPasses);
}
