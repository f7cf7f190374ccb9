// The figures of what was measured: Scaling, Passes, Samples, and Quality and cost.

// ---- Scaling: a metric over an axis -------------------------------------------------------------

const scaling = {held: new Map()};  // pointer -> text of its fixed value; absent: all values

// Whether the axis's value follows from x's value. Tied axes change together, so they are not free.
function followsFrom(axis, x) {
    const seen = new Map();
    return rows.every((row) => {
        if (row.values[x.pointer] === undefined) return true;  // a case of another scene
        const at = valueText(row.values[x.pointer]), value = valueText(row.values[axis.pointer]);
        if (!seen.has(at)) seen.set(at, value);
        return seen.get(at) === value;
    });
}

function freeAxes() {
    const x = axisOf.get(scaling.x);
    return axes.filter((axis) => axis !== x && !followsFrom(axis, x));
}

function suitsLog(all) {
    const values = all.filter((value) => value !== undefined);
    return values.every((value) => value > 0) && Math.max(...values) >= 8 * Math.min(...values);
}

// Returns how many of the axis's values have results that the filter shows.
function measuredValues(axis) {
    return new Set(filteredOk().map((row) => row.values[axis.pointer])
        .filter((value) => value !== undefined).map(valueText)).size;
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

// If there would be too many lines to tell apart, fixes the other axes at the values of the first
// case shown.
function holdOthers() {
    const shown = filteredOk();
    const texts = (axis) => new Set(shown.map((row) => valueText(row.values[axis.pointer])));
    const others = freeAxes().filter(
        (axis) => ![scaling.color, scaling.facet, kReportAxis].includes(axis.pointer));
    const colors = axisOf.has(scaling.color) ? texts(axisOf.get(scaling.color)).size : 1;
    const lines = others.reduce((product, axis) => product * texts(axis).size, colors);
    scaling.held.clear();
    if (lines <= Math.max(6, colors)) return;
    const first = shown.find((row) => row.values[scaling.x] !== undefined);
    for (const axis of first ? others : [])
        scaling.held.set(axis.pointer, valueText(first.values[axis.pointer]));
}

function scalingRows() {
    return filteredOk().filter((row) => row.metrics[scaling.metric] &&
        row.values[scaling.x] !== undefined && [...scaling.held].every(([pointer, text]) =>
        // A value that an older report lacks matches any.
        row.values[pointer] === undefined || valueText(row.values[pointer]) === text));
}

// Returns the lines of the plot. The rows of a line differ only in x.
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
    const warned = scalingRows().some((row) => cautions(row).length);
    const bars = {interval: "Bars: the interval of the median, 95 % or what the samples allow.",
        quartiles: "Bars: first to third quartile of the samples.", none: ""}[scaling.spread];
    byId("scaling-note").textContent = [
        `${counted(lines.length, "line")}, ${counted(scalingRows().length, "case")}.`, bars,
        hasIntervals ? "" : "The report has no intervals of medians.",
        warned ? "Open markers: cases with warnings, or not trusted." : ""].filter(Boolean).join(" ");
}

// ---- Scaling: lines and axes --------------------------------------------------------------------

function xOf(row) {
    const axis = axisOf.get(scaling.x), value = row.values[scaling.x];
    return axis.numeric ? value : valueText(value);
}

function hoverText(row, name) {
    const metric = row.metrics[name], range = spread(metric, scaling.spread);
    const lines = [`<b>${plain(quantity(metric.median, metric.unit))}</b>`];
    if (range) lines.push(plain(`${number(range[0] / shownUnit(metric.unit).size)} to ` +
        quantity(range[1], metric.unit)));
    lines.push(...axes.map((axis) =>
        plain(`${axis.label}: ${valueText(row.values[axis.pointer])}`)));
    lines.push(...cautions(row).map((text) => plain(`\u26a0 ${shortened(text, 70)}`)));
    return lines.join("<br>");
}

// Returns error bars for Plotly around the medians.
function errorBars(metrics, kind) {
    const size = shownUnit(metrics[0]?.unit).size;
    const ends = metrics.map((metric) => spread(metric, kind));
    // Plotly draws nothing for NaN.
    const end = (place, length) => metrics.map((metric, i) =>
        ends[i] ? Math.max(0, length(ends[i][place], metric.median)) / size : NaN);
    return {
        type: "data", symmetric: false, thickness: 1.3, width: 4,
        array: end(1, (upper, middle) => upper - middle),
        arrayminus: end(0, (lower, middle) => middle - lower),
        visible: kind !== "none",
    };
}

// `seen` has the legend names and dashes of earlier lines.
function scalingTrace(line, facets, seen) {
    const color = axisOf.get(scaling.color), facet = axisOf.get(scaling.facet);
    const [first] = line;
    const index = color ? color.values.findIndex(
        (value) => valueText(value) === valueText(first.values[color.pointer])) : 0;
    const rest = freeAxes().filter((axis) => axis !== color && axis !== facet &&
        !scaling.held.has(axis.pointer));
    const restText = rest.map((axis) =>
        `${axis.label} ${valueText(first.values[axis.pointer])}`).join(", ");
    if (!seen.dashes.has(restText)) seen.dashes.set(restText, seen.dashes.size);
    const colorText = color ? valueText(first.values[color.pointer]) : "";
    const place = facet ? facets.indexOf(valueText(first.values[facet.pointer])) : 0;
    const axis = axisOf.get(scaling.x);
    const order = (row) => axis.values.findIndex(
        (value) => valueText(value) === valueText(row.values[scaling.x]));
    const sorted = [...line].sort((a, b) => order(a) - order(b));
    const metrics = sorted.map((row) => row.metrics[scaling.metric]);
    const size = shownUnit(metrics[0].unit).size;
    const name = [colorText, restText].filter(Boolean).join(", ") || scaling.metric;
    const isFirst = !seen.names.has(name);
    seen.names.add(name);
    return {
        type: "scatter", mode: "lines+markers", name: plain(name), legendgroup: name,
        showlegend: isFirst,
        x: sorted.map(xOf), y: metrics.map((metric) => metric.median / size),
        xaxis: place ? `x${place + 1}` : "x", yaxis: place ? `y${place + 1}` : "y",
        error_y: {...errorBars(metrics, scaling.spread), color: seriesColor(index)},
        line: {color: seriesColor(index), width: 2, dash: seriesDash(seen.dashes.get(restText))},
        marker: {
            color: seriesColor(index), size: 8,
            symbol: sorted.map((row) =>
                seriesSymbol(index) + (cautions(row).length ? "-open" : "")),
        },
        text: sorted.map((row) => hoverText(row, scaling.metric)), hoverinfo: "text",
        customdata: sorted.map((row) => row.id),
    };
}

// Lays out the axes of a grid of facets, side by side where there is room.
function facetAxes(div, facets) {
    const x = axisOf.get(scaling.x), count = Math.max(1, facets.length);
    const columns = Math.min(count, Math.max(1, Math.floor(div.clientWidth / 330)));
    const across = Math.ceil(count / columns);
    const values = x.values.filter((value) => value !== undefined);
    const ticks = x.numeric && values.length <= 10
        ? {tickmode: "array", tickvals: values, ticktext: values.map(String)} : {};
    const layout = {
        height: across === 1 ? 460 : 60 + 320 * across,
        annotations: [], grid: {rows: across, columns, pattern: "independent",
            xgap: 0.14, ygap: across > 1 ? 0.28 : 0.1},
    };
    for (let i = 0; i < count; ++i) {
        const suffix = i ? String(i + 1) : "", first = i % columns === 0;
        const last = i + columns >= count;
        layout[`xaxis${suffix}`] = axisStyle({
            ...scaleStyle(x.numeric ? scaling.xType : "category"), ...ticks,
            title: last ? plain(x.label) : "", ...(i ? {matches: "x"} : {})});
        layout[`yaxis${suffix}`] = axisStyle({
            ...scaleStyle(scaling.yType),
            ...(scaling.yType === "linear" ? {rangemode: "tozero"} : {}),
            title: first ? plain(metricTitle(scaling.metric, metricUnits.get(scaling.metric))) : "",
            ...(i ? {matches: "y"} : {})});
        if (facets.length) layout.annotations.push({
            text: plain(`${axisOf.get(scaling.facet).label} ${facets[i]}`), showarrow: false,
            xref: `x${suffix} domain`, yref: `y${suffix} domain`, x: 0.5, y: 1, yanchor: "bottom"});
    }
    return layout;
}

// ---- Scaling: choices ---------------------------------------------------------------------------

const kScales = [["linear", "linear"], ["log", "logarithmic"]];

function axisChoices(list) { return list.map((axis) => [axis.pointer, axis.label]); }

function changeScaling(key, rehold) {
    return (value) => {
        scaling[key] = value;
        const x = axisOf.get(scaling.x);
        if (key === "x") scaling.xType = x.numeric && suitsLog(x.values) ? "log" : "linear";
        const free = freeAxes();
        for (const each of ["color", "facet"])
            if (!free.includes(axisOf.get(scaling[each]))) scaling[each] = "";
        if (scaling.facet === scaling.color) scaling.facet = "";
        if (rehold) holdOthers();
        buildScalingControls();
        drawScaling();
        byId(`scaling-${key}`)?.focus();
    };
}

function heldChoice(axis) {
    const id = `scaling-held-${axis.pointer}`;
    return choice(axis.label, id, [["", "all"], ...axis.values.map(
        (value) => [valueText(value), valueText(value)])],
    scaling.held.get(axis.pointer) ?? "", (text) => {
        if (text) scaling.held.set(axis.pointer, text);
        else scaling.held.delete(axis.pointer);
        drawScaling();
    });
}

function buildScalingControls() {
    const free = freeAxes(), x = axisOf.get(scaling.x);
    const spreads = [["interval", "interval of the median"], ["quartiles", "quartiles"],
        ["none", "none"]].filter(([kind]) => kind !== "interval" || hasIntervals);
    const held = free.filter((axis) => ![scaling.color, scaling.facet].includes(axis.pointer));
    const facetable = free.filter((axis) => axis.pointer !== scaling.color &&
        axis.values.length <= 12);
    showOnly(byId("scaling-controls"),
        choice("metric", "scaling-metric", metricNames.map((name) => [name, name]),
            scaling.metric, changeScaling("metric", false)),
        choice("across", "scaling-x", axisChoices(sweptAxes), scaling.x, changeScaling("x", true)),
        choice("colour", "scaling-color", [["", "none"], ...axisChoices(free)], scaling.color,
            changeScaling("color", true)),
        choice("small multiples", "scaling-facet", [["", "none"], ...axisChoices(facetable)],
            scaling.facet, changeScaling("facet", true)),
        x.numeric ? choice("x scale", "scaling-xType", kScales, scaling.xType,
            changeScaling("xType", false)) : "",
        choice("y scale", "scaling-yType", kScales, scaling.yType, changeScaling("yType", false)),
        choice("bars", "scaling-spread", spreads, scaling.spread, changeScaling("spread", false)),
        ...held.map(heldChoice));
}

function buildScaling() {
    const section = byId("scaling");
    if (!metricNames.length || !sweptAxes.length) {
        showOnly(section, heading("Scaling"), note("No axis has more than one value here."));
        return;
    }
    startScaling();
    showOnly(section, heading("Scaling"),
        element("div", {class: "controls", id: "scaling-controls"}),
        figure("scaling-plot",
            "A metric over an axis of the sweep; the table below has the figures."),
        element("p", {class: "note", id: "scaling-note"}));
    buildScalingControls();
    drawScaling();
    onFilterChange(() => {
        // Another scene has other axes.
        if (severalScenes && !scalingRows().length && filteredOk().length) {
            startScaling();
            buildScalingControls();
        }
        drawScaling();
    });
    onThemeChange(drawScaling);
    byId("scaling-plot").on("plotly_click",
        (event) => showSamplesOf(event.points[0].customdata, scaling.metric));
}

// ---- Passes: where the time of a frame goes -----------------------------------------------------

const kBarHeight = 24;  // px
const passes = {order: "sweep", limit: 24, scale: "ms"};

function passSum(row) {
    return passMetrics.reduce((sum, name) => sum + (median(row, name) ?? 0), 0);
}

function passRows() {
    const measured = filteredOk().filter((row) => passMetrics.some((name) => row.metrics[name]));
    if (passes.order === "time") measured.sort((a, b) => passSum(b) - passSum(a));
    // Puts the same case of several reports side by side.
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
    // Plotly joins bars of equal names, so the bars are told apart by index and labelled by name.
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

// ---- Samples: all of a case and metric ----------------------------------------------------------

const samples = {kind: "histogram"};

function sampledRows() {
    return filteredOk().filter((row) => Object.values(row.metrics).some(
        (metric) => metric.samples?.length > 1));
}

function sampledMetrics(row) {
    return row ? Object.keys(row.metrics).filter(
        (name) => row.metrics[name].samples?.length > 1) : [];
}

// Returns the chosen case from every report that has it.
function sampleRows() {
    return rows.filter((row) => row.name === samples.name && row.metrics[samples.metric]?.samples);
}

function buildSampleControls() {
    const found = sampledRows();
    const names = [...new Map(found.map((row) => [row.name, row])).values()];
    if (!names.some((row) => row.name === samples.name)) samples.name = names[0]?.name;
    const row = found.find((each) => each.name === samples.name);
    const metrics = sampledMetrics(row);
    if (!metrics.includes(samples.metric)) samples.metric = preferred(metrics, "frame.time");
    const change = (key) => (value) => {
        samples[key] = value;
        buildSampleControls();
        drawSamples();
        byId(`samples-${key}`)?.focus();
    };
    showOnly(byId("samples-controls"),
        choice("case", "samples-name", names.map((each) => [each.name, each.name]),
            samples.name, change("name")),
        choice("metric", "samples-metric", metrics.map((name) => [name, name]), samples.metric,
            change("metric")),
        choice("as", "samples-kind", Object.keys(kSpreads).map((name) => [name, name]),
            samples.kind, change("kind")));
}

// Called on a click on a point or row elsewhere on the page.
function showSamplesOf(id, metric) {
    const row = rows.find((each) => each.id === id);
    if (!row || !byId("samples-plot")) return;
    samples.name = row.name;
    if (metric && row.metrics[metric]?.samples?.length > 1) samples.metric = metric;
    buildSampleControls();
    drawSamples();
    byId("distributions").scrollIntoView({behavior: "smooth"});
}

function buildSamples() {
    const section = byId("distributions");
    if (!sampledRows().length) {
        showOnly(section, heading("Samples"), note("No metric has more than one sample."));
        return;
    }
    showOnly(section, heading("Samples"),
        element("div", {class: "controls", id: "samples-controls"}),
        figure("samples-plot", "Samples of a metric in order, and how they are distributed."),
        element("p", {class: "note", id: "samples-note"}));
    const update = () => {
        buildSampleControls();
        drawSamples();
    };
    update();
    onFilterChange(update);
    onThemeChange(drawSamples);
}

function orderTrace(row, values, hue) {
    return {
        type: "scatter", mode: values.length > 400 ? "markers" : "lines+markers",
        name: plain(row.report.label), legendgroup: row.report.label, showlegend: severalReports,
        x: values.map((_, place) => place + 1), y: values,
        line: {color: hue, width: 1}, marker: {color: hue, size: values.length > 200 ? 3 : 5},
        hovertemplate: "sample %{x}: %{y:.4~g}<extra></extra>",
    };
}

const kBins = 30;

// Bins of equal width from the least to the greatest value of all reports, so that bars of several
// reports have the same bins.
function histogramTrace(common, values, range, hue) {
    const width = (range[1] - range[0]) / kBins || 1;
    const counts = new Array(kBins).fill(0);
    for (const value of values)
        ++counts[Math.min(kBins - 1, Math.floor((value - range[0]) / width))];
    const ends = counts.map((_, bin) => [range[0] + bin * width, range[0] + (bin + 1) * width]);
    return {...common, type: "bar", orientation: "h", x: counts, width,
        y: ends.map(([lower, upper]) => (lower + upper) / 2),
        opacity: severalReports ? 0.6 : 0.9,
        marker: {color: hue, line: {color: color("card"), width: 0.5}},
        hovertext: ends.map(([lower, upper], bin) => plain(
            `${counted(counts[bin], "sample")} from ${number(lower)} to ${number(upper)}`)),
        hoverinfo: "text", textposition: "none"};
}

// Draws the share of the samples that are not above each value.
function cumulativeTrace(common, values, hue) {
    const sorted = [...values].sort((a, b) => a - b);
    return {...common, type: "scatter", mode: "lines", line: {color: hue, width: 2, shape: "vh"},
        x: sorted.map((_, place) => 100 * (place + 1) / sorted.length), y: sorted,
        hovertemplate: "%{x:.3~g} % are at most %{y:.4~g}<extra></extra>"};
}

// Draws a box with whiskers from the report's quartiles and its 5th and 95th percentiles, as one
// line with gaps.
function boxTrace(common, row, hue) {
    const metric = row.metrics[samples.metric], size = shownUnit(metric.unit).size;
    const points = [], at = row.reportIndex;
    const line = (...ends) => points.push(...ends, [null, null]);
    const across = (name, half) => line([at - half, metric[name]], [at + half, metric[name]]);
    if (metric.first_quartile !== undefined) {
        const {first_quartile: lower, third_quartile: upper} = metric;
        line([at - 0.3, lower], [at + 0.3, lower], [at + 0.3, upper], [at - 0.3, upper],
            [at - 0.3, lower]);
        for (const [name, quartile] of [["percentile_5", lower], ["percentile_95", upper]])
            if (metric[name] !== undefined) {
                line([at, quartile], [at, metric[name]]);
                across(name, 0.15);
            }
    }
    across("median", 0.3);
    const known = (text, name) => metric[name] === undefined ? ""
        : `${text}: ${plain(quantity(metric[name], metric.unit))}`;
    return {...common, type: "scatter", mode: "lines", line: {color: hue, width: 2},
        x: points.map(([place]) => place),
        y: points.map(([, value]) => value === null ? null : value / size),
        text: [known("95th percentile", "percentile_95"), known("third quartile", "third_quartile"),
            known("median", "median"), known("first quartile", "first_quartile"),
            known("5th percentile", "percentile_5")].filter(Boolean).join("<br>"),
        hoverinfo: "text"};
}

// Plots beside the samples in order.
const kSpreads = {
    histogram: {title: "samples", trace: (common, row, values, range, hue) =>
        histogramTrace(common, values, range, hue)},
    cumulative: {title: "% of the samples", trace: (common, row, values, range, hue) =>
        cumulativeTrace(common, values, hue)},
    box: {title: "", trace: (common, row, values, range, hue) => boxTrace(common, row, hue)},
};

// Returns the median as a line and its interval as a band.
function medianShapes(row, hue) {
    const metric = row.metrics[samples.metric], size = shownUnit(metric.unit).size;
    const across = {xref: "paper", x0: 0, x1: 1, yref: "y", layer: "below"};
    const shapes = [{...across, type: "line", y0: metric.median / size, y1: metric.median / size,
        line: {color: hue, width: 1.5, dash: "dash"}}];
    if (metric.interval)
        shapes.push({...across, type: "rect", y0: metric.interval.lower / size,
            y1: metric.interval.upper / size, fillcolor: hue, opacity: 0.14, line: {width: 0}});
    return shapes;
}

function sampleNote(row) {
    const metric = row.metrics[samples.metric], size = shownUnit(metric.unit).size;
    const parts = [severalReports ? `${row.report.label}:` : "",
        `median ${quantity(metric.median, metric.unit)}`];
    if (metric.interval)
        parts.push(`(${number(metric.interval.lower / size)} to ` +
            `${number(metric.interval.upper / size)}, ${percent(metric.interval.confidence)})`);
    parts.push(`of ${counted(metric.samples.length, "sample")}`);
    if (metric.effective_samples)
        parts.push(`worth ${Math.round(metric.effective_samples)} independent ones`);
    if (metric.mode) parts.push(`, ${metric.mode}`);
    return `${parts.filter(Boolean).join(" ").replace(" ,", ",")}.`;
}

function drawSamples() {
    const div = byId("samples-plot"), found = sampleRows();
    const traces = [], shapes = [];
    const unit = metricUnits.get(samples.metric), size = shownUnit(unit).size;
    const valuesOf = (row) => row.metrics[samples.metric].samples
        .filter((value) => value !== null).map((value) => value / size);
    const all = found.flatMap(valuesOf);
    const range = [Math.min(...all), Math.max(...all)];
    const kind = kSpreads[samples.kind];
    for (const row of found) {
        const values = valuesOf(row), hue = seriesColor(row.reportIndex);
        const common = {name: plain(row.report.label), legendgroup: row.report.label,
            showlegend: false, xaxis: "x2"};
        traces.push(orderTrace(row, values, hue), kind.trace(common, row, values, range, hue));
        shapes.push(...medianShapes(row, hue));
    }
    drawFigure(div, traces, {
        barmode: "overlay", shapes, height: 420, legend: legendStyle(div, "report"),
        xaxis: axisStyle({title: "sample, in order", domain: [0, 0.66]}),
        xaxis2: axisStyle({title: kind.title, domain: [0.7, 1],
            ...(samples.kind === "box" ? {showticklabels: false, showgrid: false} : {})}),
        yaxis: axisStyle({title: plain(metricTitle(samples.metric ?? "", unit))}),
    });
    byId("samples-note").textContent = found.map(sampleNote).join(" ") +
        (found.length ? " Dashed: the median; band: its interval." : "") +
        (samples.kind === "box" ? " Box: the quartiles; whiskers: 5th and 95th percentile." : "");
}

// ---- Probes of guides over simulated time -------------------------------------------------------

const probes = {color: "", limit: 16};
const kFigureOf = (name) => `probes-${name.replaceAll(".", "-")}`;

function probeRows() {
    return filteredOk().filter((row) => row.metrics["probe.time"]?.samples?.length > 1);
}

function probeNames() {
    return metricNames.filter((name) => name.startsWith("probe.") && name !== "probe.time" &&
        name !== "probe.pass.time");
}

// Lines with one value of the coloured axis have its colour, and differ in their dashes.
function probeTraces(name, found) {
    const axis = axisOf.get(probes.color), rest = axes.filter((each) => each !== axis);
    const dashes = new Map();
    return found.filter((row) => row.metrics[name]?.samples).map((row, place) => {
        const value = axis ? valueText(row.values[axis.pointer]) : "";
        const index = axis ? axis.values.findIndex((each) => valueText(each) === value) : place;
        const text = rest.map((each) => valueText(row.values[each.pointer])).join(" \u00b7 ");
        if (!dashes.has(text)) dashes.set(text, dashes.size);
        const size = shownUnit(metricUnits.get(name)).size;
        return {
            type: "scatter", mode: "lines", name: plain(caseValues(row)),
            x: row.metrics["probe.time"].samples,
            y: row.metrics[name].samples.map((each) => each === null ? null : each / size),
            line: {color: seriesColor(index), width: 2,
                dash: axis ? seriesDash(dashes.get(text)) : "solid"},
            hovertemplate: `%{x:.4~g} s: %{y:.4~g}<br>${plain(caseLabel(row))}<extra></extra>`,
        };
    });
}

function drawProbes() {
    const all = probeRows(), found = all.slice(0, probes.limit);
    for (const name of probeNames()) {
        const div = byId(kFigureOf(name)), traces = probeTraces(name, found);
        div.hidden = !traces.length;
        if (traces.length) drawFigure(div, traces, {
            height: 340, showlegend: traces.length > 1, legend: legendStyle(div),
            title: {text: plain(name), font: {size: 14}}, margin: {l: 56, r: 16, t: 48, b: 48},
            xaxis: axisStyle({title: "simulated time (s)"}),
            yaxis: axisStyle({title: plain(shownUnit(metricUnits.get(name)).text)}),
        });
    }
    byId("probes-note").textContent = [
        "Of each frame from the start of the hair. Click a line of the legend to hide it.",
        found.length > 1 ? `Lines: ${caseValuesTitle()}.` : "",
        all.length > found.length ? `${found.length} of ${counted(all.length, "case")}: filter ` +
            "the cases, or show more." : ""].filter(Boolean).join(" ");
}

function buildProbes() {
    const section = byId("probes");
    if (!probeRows().length) {
        showOnly(section, heading("Probes"), note(
            "Nothing was asked of the guides in any case (/run/probes)."));
        return;
    }
    probes.color = severalReports ? kReportAxis : axes[0]?.pointer ?? "";
    const change = (key, convert) => (value) => {
        probes[key] = convert(value);
        drawProbes();
    };
    showOnly(section, heading("Probes"),
        element("div", {class: "controls"},
            choice("colour", "probes-color", [["", "by case"], ...axisChoices(axes)], probes.color,
                change("color", String)),
            choice("cases", "probes-limit", [[8, "8"], [16, "16"], [64, "64"], [1e9, "all"]],
                probes.limit, change("limit", Number))),
        element("p", {class: "note", id: "probes-note"}),
        element("div", {class: "probes"}, probeNames().map((name) =>
            figure(kFigureOf(name), `${name} over simulated time, a line for each case.`))));
    drawProbes();
    onFilterChange(drawProbes);
    onThemeChange(drawProbes);
}

// ---- Quality and cost: error against time -------------------------------------------------------

const quality = {};

// Errors, of which less is better: SSIM is shown as 1 - SSIM. PSNR stays as it is, and more of it
// is better.
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
const kQualityReferences = {
    "image.flip.tessellation": "the same case's picture by tessellation",
    "image.flip.many_samples": "the same hair with 64 samples a pixel",
};
function moreIsBetter() { return quality.error === "image.psnr"; }

function qualityRows() {
    return filteredOk().filter((row) => errorOf(row) !== undefined &&
        median(row, quality.time) !== undefined);
}

// Returns the Pareto front: cases that no other case beats in both time and error.
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
        `other case beats in both time and error. Reference: ${
            kQualityReferences[quality.error] ?? "the scene's /run/reference"}.`;
}

function buildQuality() {
    const section = byId("quality");
    if (!imageMetrics.length) {
        showOnly(section, heading("Quality and cost"), note(
            "No case was compared with a reference picture: the scene asks for none " +
            "(/run/reference, /run/compare_backends)."));
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
