// ---- All cases with their figures --------------------------------------------------------------

// Half the median's interval over the median: how well it is known.
function precision(row) {
    const {interval, median: middle} = row.metrics["frame.time"] ?? {};
    return interval && middle ? (interval.upper - interval.lower) / 2 / middle : undefined;
}

function metricColumn(name, title) {
    const {text: unit, size} = shownUnit(metricUnits.get(name));
    const value = (row) => {
        const found = median(row, name);
        return found === undefined ? undefined : found / size;
    };
    return {title: unit ? `${title} ${unit}` : title, hint: `${name}, median`, numeric: true, value,
        text: (row) => number(value(row))};
}

function axisColumn(axis) {
    return {title: axis.label, hint: axis.pointer, numeric: axis.numeric,
        value: (row) => row.values[axis.pointer],
        text: (row) => valueText(row.values[axis.pointer])};
}

function numberCell(row) {
    const sampled = Object.values(row.metrics).some((metric) => metric.samples?.length > 1);
    return sampled ? element("button", {type: "button", class: "link",
        title: `${row.name}: show its samples`, onclick: () => showSamplesOf(row.id)},
    `${row.number}`)
        : element("span", {title: row.name}, `${row.number}`);
}

function noteText(row) {
    return [row.reason, ...row.warnings.map((text) => `\u26a0 ${text}`)].filter(Boolean).join("; ");
}

function caseColumns() {
    const known = (name) => metricNames.includes(name);
    return [
        {title: "#", hint: "place in the sweep; shows its samples", numeric: true,
            value: (row) => row.number, text: (row) => `${row.number}`, cell: numberCell},
        ...(axes.length ? axes.map(axisColumn) : [{title: "case", text: (row) => row.name}]),
        {title: "status", text: (row) => row.status,
            cell: (row) => element("span", {class: `badge ${row.status}`}, row.status)},
        ...(known("fps") ? [metricColumn("fps", "fps")].map(
            (column) => ({...column, title: "fps"})) : []),
        ...(known("frame.time") ? [metricColumn("frame.time", "frame")] : []),
        ...(hasIntervals ? [{title: "\u00b1", numeric: true,
            hint: "half the interval of frame.time's median / median", value: precision,
            text: (row) => precision(row) === undefined ? "" : percent(precision(row))}] : []),
        ...passMetrics.map((name) => metricColumn(name, passName(name))),
        ...(known("memory.device") ? [metricColumn("memory.device", "memory")] : []),
        ...imageMetrics.map((name) => metricColumn(name, name.slice("image.".length))),
        {title: "reason, warnings", wide: true, text: noteText},
    ];
}

function buildCases() {
    const columns = caseColumns();
    showOnly(byId("cases"), heading("Cases"),
        note("Medians. Click a heading to sort, a number in the first column to see the samples."),
        element("div", {class: "scroll tall", tabindex: "0", role: "region",
            "aria-label": "Table of cases"}, element("table", {id: "cases-table"})));
    const update = () => fillTable(byId("cases-table"), columns, filteredRows());
    update();
    onFilterChange(update);
}
