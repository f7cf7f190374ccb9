// Compares reports of several devices, scenes or builds.

// ---- Devices ------------------------------------------------------------------------------------

// Returns the entry of a report in page.devices: its times over those of its scene's first report.
function onDevice(report) { return page.devices[page.reports.indexOf(report)]; }

function isFirst(report) { return page.reports[onDevice(report).first] === report; }

function timesText(ratio) {
    return `${number(ratio.mean)} (${number(ratio.least)} to ${number(ratio.greatest)})`;
}

function deviceNote(report) {
    const {first, ratio, differences} = onDevice(report);
    return [
        report.untrusted ? `\u26a0 not to be trusted: ${report.untrusted}` : "",
        !isFirst(report) && !ratio
            ? `no case in common with ${page.reports[first].label}` : "",
        ...differences,
    ].filter(Boolean).join("; ");
}

// Returns the reports with a case that the filter shows.
function filteredReports() {
    const shown = new Set(filteredRows().map((row) => row.report));
    return page.reports.filter((report) => shown.has(report));
}

function backendsOf(report) {
    return [...new Set(rows.filter((row) => row.report === report && row.status === "ok")
        .map((row) => row.facets.backend).filter(Boolean))].join(", ");
}

const kDeviceColumns = [
    {title: "report", text: (report) => `${report.label}: ${report.file}`},
    {title: "scene", text: (report) => sceneName(report)},
    {title: "device", text: (report) => deviceText(report.environment?.device)},
    {title: "cases", numeric: true, hint: "that ran",
        value: (report) => report.cases.filter((each) => each.status === "ok").length,
        text: (report) => `${report.cases.filter((each) => each.status === "ok").length}`},
    {title: "frame time \u00f7 first", numeric: true,
        hint: "geometric mean, least and greatest over the cases in common with the scene's first",
        value: (report) => isFirst(report) ? 1 : onDevice(report).ratio?.mean,
        text: (report) => isFirst(report) ? "1, the first"
            : onDevice(report).ratio ? timesText(onDevice(report).ratio) : ""},
    {title: "in common", numeric: true, hint: "cases that both measured",
        value: (report) => onDevice(report).ratio?.cases,
        text: (report) => `${onDevice(report).ratio?.cases ?? ""}`},
    {title: "driver", text: (report) => driverText(report.environment?.device)},
    {title: "processor", text: (report) => report.environment?.host?.processor ?? ""},
    {title: "back ends", hint: "that drew strands", text: backendsOf},
    {title: "build", text: (report) => report.environment?.build?.commit ?? ""},
    {title: "measured", text: (report) => report.environment?.started?.slice(0, 10) ?? ""},
    {title: "notes", wide: true, text: deviceNote},
];

function drawDevices() {
    const div = byId("devices-plot");
    const shown = filteredReports().filter((report) => onDevice(report).ratio);
    div.hidden = !shown.length;
    if (!shown.length) return;
    const ratios = shown.map((report) => onDevice(report).ratio);
    const labels = shown.map((report) => plain(shortened(`${report.label}: ${sceneName(report)}, ` +
        `${report.environment?.device?.name ?? ""}`, isNarrow(div) ? 22 : 60)));
    drawFigure(div, [{
        type: "scatter", mode: "markers", x: ratios.map((ratio) => ratio.mean),
        y: shown.map((_, place) => place),
        marker: {size: 10, color: shown.map((report) => seriesColor(page.reports.indexOf(report)))},
        error_x: {type: "data", symmetric: false, color: color("text"), thickness: 1.3, width: 4,
            array: ratios.map((ratio) => ratio.greatest - ratio.mean),
            arrayminus: ratios.map((ratio) => ratio.mean - ratio.least)},
        hoverinfo: "text", hovertext: shown.map((report, place) => plain(
            `${report.file}: ${timesText(ratios[place])} times ` +
            `${page.reports[onDevice(report).first].file}`)),
    }], {
        height: 130 + 34 * shown.length, showlegend: false,
        shapes: [{type: "line", xref: "x", yref: "paper", x0: 1, x1: 1, y0: 0, y1: 1,
            line: {color: color("faint"), width: 1.5, dash: "dash"}, layer: "below"}],
        xaxis: axisStyle({title: "frame time \u00f7 the scene's first report", type: "log"}),
        yaxis: axisStyle({tickmode: "array", tickvals: shown.map((_, place) => place),
            ticktext: labels, range: [shown.length - 0.5, -0.5], showgrid: false, zeroline: false}),
    });
}

function buildDevices() {
    const section = byId("devices");
    if (!severalReports) {
        section.remove();
        return;
    }
    showOnly(section, heading("Devices"),
        element("div", {class: "scroll", tabindex: "0", role: "region",
            "aria-label": "Table of reports and their devices"},
        element("table", {id: "devices-table"})),
        figure("devices-plot",
            "Times of frames over those of each scene's first report; the table has the figures."),
        note("Medians of frame.time of cases of equal settings. Other builds may draw different hair: " +
            "Comparison says where pictures and states differ. The filter chooses the reports."));
    const update = () => {
        fillTable(byId("devices-table"), kDeviceColumns, filteredReports());
        drawDevices();
    };
    update();
    onFilterChange(update);
    onThemeChange(drawDevices);
}
