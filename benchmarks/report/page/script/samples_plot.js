// ---- The figure of samples: in order, and how often each value is ------------------------------

function orderTrace(row, values, hue) {
    return {
        type: "scatter", mode: values.length > 400 ? "markers" : "lines+markers",
        name: plain(row.report.label), legendgroup: row.report.label, showlegend: severalReports,
        x: values.map((_, place) => place + 1), y: values,
        line: {color: hue, width: 1}, marker: {color: hue, size: values.length > 200 ? 3 : 5},
        hovertemplate: "sample %{x}: %{y:.4~g}<extra></extra>",
    };
}

function spreadTrace(row, values, hue) {
    const common = {name: plain(row.report.label), legendgroup: row.report.label, showlegend: false,
        y: values, xaxis: "x2"};
    if (samples.kind === "histogram")
        return {...common, type: "histogram", nbinsy: 30, opacity: severalReports ? 0.6 : 0.9,
            marker: {color: hue, line: {color: color("card"), width: 0.5}}};
    if (samples.kind === "violin")
        return {...common, type: "violin", line: {color: hue}, box: {visible: true},
            points: false, spanmode: "hard"};
    return {...common, type: "box", boxpoints: "outliers", line: {color: hue},
        marker: {color: hue}};
}

// The median as a line, its interval as a band.
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
    for (const row of found) {
        const metric = row.metrics[samples.metric], size = shownUnit(metric.unit).size;
        const values = metric.samples.map((value) => value / size);
        const hue = seriesColor(row.reportIndex);
        traces.push(orderTrace(row, values, hue), spreadTrace(row, values, hue));
        shapes.push(...medianShapes(row, hue));
    }
    const unit = metricUnits.get(samples.metric);
    drawFigure(div, traces, {
        barmode: "overlay", shapes, height: 420, legend: legendStyle(div, "report"),
        xaxis: axisStyle({title: "sample, in order", domain: [0, 0.66]}),
        xaxis2: axisStyle({title: samples.kind === "histogram" ? "samples" : "", domain: [0.7, 1]}),
        yaxis: axisStyle({title: plain(metricTitle(samples.metric ?? "", unit))}),
    });
    byId("samples-note").textContent = found.map(sampleNote).join(" ") +
        (found.length ? " Dashed: the median; band: its interval." : "");
}
