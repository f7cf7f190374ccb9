// ---- All samples of a case and metric ----------------------------------------------------------

const samples = {kind: "histogram"};

function sampledRows() {
    return filteredOk().filter((row) => Object.values(row.metrics).some(
        (metric) => metric.samples?.length > 1));
}

function sampledMetrics(row) {
    return row ? Object.keys(row.metrics).filter(
        (name) => row.metrics[name].samples?.length > 1) : [];
}

// The chosen case in every report that has it.
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
        choice("as", "samples-kind", [["histogram", "histogram"], ["violin", "violin"],
            ["box", "box"]], samples.kind, change("kind")));
}

// From a point or a row somewhere else on the page.
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
