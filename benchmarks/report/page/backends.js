// Compares strand back ends where a report has several: how their cost grows with the strands, how
// it compares with tessellation, and how far their pictures differ. C++ computes the slopes, ratios
// and intervals; this only draws them.

const kBackendAxis = "/strands/backend";
const backends = {xType: "log", yType: "log"};

// Returns the lines of all reports, each with the points that the filter shows.
function backendLines() {
    const shown = new Map(filteredOk().map((row) => [row.id, row]));
    return page.reports.flatMap((report, reportIndex) => (report.backends?.lines ?? []).map(
        (line) => ({...line, report, whole: line.points.length,
            points: line.points.map((point) => ({...point,
                row: shown.get(`${reportIndex}:${point.case}`)})).filter((point) => point.row)})))
        .filter((line) => line.points.length);
}

// "msaa 4". With several reports, the report's label too.
function heldText(line) {
    return [...Object.entries(line.held).filter(([pointer]) => axisOf.has(pointer)).map(
        ([pointer, value]) => `${axisOf.get(pointer).label} ${valueText(value)}`),
    severalReports ? line.report.label : ""].filter(Boolean).join(", ");
}

function backendName(line) { return [line.backend, heldText(line)].filter(Boolean).join(", "); }

function backendColor(backend) {
    return axisOf.get(kBackendAxis).values.findIndex((value) => valueText(value) === backend);
}

function lawText(law) {
    if (!law) return "";
    return `${law.exponent.toFixed(3)}` + (law.lower === undefined ? ""
        : ` (${law.lower.toFixed(3)} to ${law.upper.toFixed(3)})`);
}

function backendHover(line, point) {
    return [`<b>${plain(quantity(point.time, "ms"))}</b>`,
        point.lower === undefined ? ""
            : plain(`${number(point.lower)} to ${quantity(point.upper, "ms")}`),
        plain(`${number(point.strands)} strands`), plain(caseLabel(point.row)),
        ...cautions(point.row).map((text) => plain(`\u26a0 ${shortened(text, 70)}`))]
        .filter(Boolean).join("<br>");
}

function backendTraces(line, dashes) {
    const index = backendColor(line.backend), held = heldText(line);
    if (!dashes.has(held)) dashes.set(held, dashes.size);
    const hue = seriesColor(index), name = backendName(line);
    const style = {color: hue, width: 2, dash: seriesDash(dashes.get(held))};
    const bound = (key, sign) => line.points.map((point) =>
        point[key] === undefined ? NaN : Math.max(0, sign * (point[key] - point.time)));
    const measured = {
        type: "scatter", mode: line.law ? "markers" : "lines+markers", name: plain(name),
        legendgroup: name, showlegend: !line.law,
        x: line.points.map((point) => point.strands),
        y: line.points.map((point) => point.time),
        error_y: {type: "data", symmetric: false, thickness: 1.3, width: 4, color: hue,
            array: bound("upper", 1), arrayminus: bound("lower", -1)},
        marker: {color: hue, size: 8, symbol: line.points.map((point) =>
            seriesSymbol(index) + (cautions(point.row).length ? "-open" : ""))},
        line: style,
        text: line.points.map((point) => backendHover(line, point)), hoverinfo: "text",
        customdata: line.points.map((point) => point.row.id),
    };
    if (!line.law) return [measured];
    const ends = [line.points[0].strands, line.points.at(-1).strands];
    const law = {
        type: "scatter", mode: "lines", name: plain(name), legendgroup: name, showlegend: false,
        hoverinfo: "skip", line: style, x: ends,
        y: ends.map((strands) => line.law.factor * strands ** line.law.exponent),
    };
    // An empty trace for the legend only, with the marker and the line in one entry.
    return [measured, law, {...law, mode: "lines+markers", showlegend: true, x: [null], y: [null],
        marker: {color: hue, size: 8, symbol: seriesSymbol(index)}}];
}

function drawBackends() {
    const div = byId("backends-plot"), dashes = new Map(), lines = backendLines();
    drawFigure(div, lines.flatMap((line) => backendTraces(line, dashes)), {
        height: 500, legend: legendStyle(div, "back end"), showlegend: lines.length > 1,
        xaxis: axisStyle({...scaleStyle(backends.xType), title: "strands drawn",
            ...(backends.xType === "log" ? {exponentformat: "power", dtick: 1} : {})}),
        yaxis: axisStyle({...scaleStyle(backends.yType), title: "passes points and strands (ms)"}),
    });
    const partial = lines.filter((line) => line.law && line.points.length < line.whole).length;
    byId("backends-note").textContent = [
        "Lines: time = factor \u00d7 strands^exponent by least squares of the logarithms, for each " +
            "back end over all its cases that differ only in the number of strands.",
        partial ? `${counted(partial, "line has", "lines have")} cases that the filter hides.` : "",
        "Bars: the interval of the median. Open markers: cases with warnings, or not trusted."]
        .filter(Boolean).join(" ");
    fillTable(byId("backends-slopes"), kSlopeColumns, lines.filter((line) => line.law));
}

// ---- Tables -------------------------------------------------------------------------------------

const kSlopeColumns = [
    {title: "back end", text: (line) => line.backend},
    {title: "held", text: heldText},
    {title: "cases", numeric: true, text: (line) => `${line.whole}`, value: (line) => line.whole},
    {title: "exponent", numeric: true, hint: "of time over strands, and its 95 % interval",
        text: (line) => lawText(line.law), value: (line) => line.law.exponent},
];

function backendRatio(row) { return row.report.backends?.ratios[row.name]; }

function ratioText(row) {
    const found = backendRatio(row);
    if (!found) return "";
    return number(found.ratio) + (found.lower === undefined ? ""
        : ` (${number(found.lower)} to ${number(found.upper)})`);
}

function backendRows() {
    return filteredRows().filter((row) => row.report.backends && row.values[kBackendAxis]);
}

function backendColumns() {
    const others = axes.filter((axis) => axis.pointer !== kBackendAxis);
    const known = (name) => metricNames.includes(name);
    const of = (name, title, hint) => known(name)
        ? [{...metricColumn(name, title), hint}] : [];
    return [
        {title: "back end", text: (row) => valueText(row.values[kBackendAxis])},
        ...others.map(axisColumn),
        {title: "strands", numeric: true, value: (row) => row.counts?.strands,
            text: (row) => number(row.counts?.strands)},
        ...of("strands.time", "time", "passes points and strands, median"),
        {title: "\u00f7 tessellation", numeric: true,
            hint: "time over that of the same case by tessellation; the interval is of both medians'",
            value: (row) => backendRatio(row)?.ratio, text: ratioText},
        ...of("image.flip.tessellation", "FLIP to tessellation", "mean error of the pictures"),
        ...of("image.flip.many_samples", "FLIP to 64 samples", "mean error of the pictures"),
        ...of("strands.time_per_point", "point", "time over points that differ"),
        ...of("strands.time_per_sample", "sample", "time over samples that show hair"),
        ...of("strands.limit_share", "of the limit", "least time by the roofline over the time"),
        ...of("memory.device", "memory", "of the device"),
        {title: "reason", wide: true, text: (row) => row.reason ?? ""},
    ];
}

function buildBackends() {
    const section = byId("backends");
    if (!page.reports.some((report) => report.backends?.lines?.length)) {
        section.remove();
        return;
    }
    const columns = backendColumns();
    const change = (key) => (value) => {
        backends[key] = value;
        drawBackends();
    };
    showOnly(section, heading("Back ends"),
        element("div", {class: "controls"},
            choice("x scale", "backends-x", kScales, backends.xType, change("xType")),
            choice("y scale", "backends-y", kScales, backends.yType, change("yType"))),
        figure("backends-plot",
            "Time of the passes points and strands over the strands; the tables have the figures."),
        element("p", {class: "note", id: "backends-note"}),
        element("div", {class: "scroll", tabindex: "0", role: "region",
            "aria-label": "Table of slopes"}, element("table", {id: "backends-slopes"})),
        element("div", {class: "scroll tall", tabindex: "0", role: "region",
            "aria-label": "Table of back ends"}, element("table", {id: "backends-table"})));
    const update = () => {
        drawBackends();
        fillTable(byId("backends-table"), columns, backendRows());
    };
    update();
    onFilterChange(update);
    onThemeChange(drawBackends);
    byId("backends-plot").on("plotly_click", (event) => event.points[0].customdata &&
        showSamplesOf(event.points[0].customdata, "strands.time"));
}

// ---- Shaders ------------------------------------------------------------------------------------
// What the driver's compiler made of each shader: the worst of the filtered cases.

const kShaderMetric = /^shader\.([^.]+)\.(\w+)$/;
const kShaderFigures = [
    ["registers", "registers"], ["spills", "spills"], ["scratch", "scratch B"],
    ["shared_memory", "shared B"], ["waves", "waves"], ["instructions", "instructions"],
    ["code_size", "code B"], ["latency", "latency cycles"],
];

function shaderRows() {
    const found = new Map();
    for (const row of filteredOk())
        for (const [name, metric] of Object.entries(row.metrics)) {
            const [, stages, figure] = kShaderMetric.exec(name) ?? [];
            if (!stages) continue;
            const key = `${row.reportIndex} ${stages}`;
            if (!found.has(key)) found.set(key, {stages, report: row.report, figures: {}});
            const {figures} = found.get(key);
            const worst = metric.hint === "higher" ? Math.min : Math.max;
            figures[figure] = worst(figures[figure] ?? metric.median, metric.median);
        }
    return [...found.values()].sort((a, b) => a.stages.localeCompare(b.stages));
}

function buildShaders() {
    const section = byId("shaders");
    const isTold = ([figure]) => metricNames.some(
        (name) => kShaderMetric.exec(name)?.[2] === figure);
    const told = kShaderFigures.filter(isTold);
    if (!told.length) {
        section.remove();
        return;
    }
    const columns = [
        {title: "shader", text: (row) => row.stages},
        ...(severalReports ? [{title: "report", text: (row) => row.report.label}] : []),
        ...told.map(([figure, title]) => ({title, numeric: true, hint: `shader.*.${figure}`,
            value: (row) => row.figures[figure], text: (row) => `${row.figures[figure] ?? ""}`})),
    ];
    showOnly(section, heading("Shaders"),
        element("p", {class: "note"}, "What the driver's compiler made of each shader: " +
            "the worst of the cases above. These figures have no noise, and tell no time."),
        element("div", {class: "scroll tall", tabindex: "0", role: "region",
            "aria-label": "Table of shaders"}, element("table", {id: "shaders-table"})));
    const update = () => fillTable(byId("shaders-table"), columns, shaderRows());
    update();
    onFilterChange(update);
}
