// ---- The reports as one list of cases ----------------------------------------------------------

const page = JSON.parse(byId("data").textContent);
const kReportAxis = "report";
const severalReports = page.reports.length > 1;

// One row a case of a report; the report counts as one more axis where there are several.
const rows = page.reports.flatMap((report, index) => report.cases.map((each, place) => ({
    ...each,
    report,
    reportIndex: index,
    number: each.index ?? place,
    id: `${index}:${each.name}`,
    metrics: each.metrics ?? {},
    warnings: each.trust?.warnings ?? [],
    values: severalReports ? {[kReportAxis]: report.label, ...each.axes} : each.axes,
})));

function axisValues(pointer) {
    const values = new Map();
    for (const row of rows) values.set(valueText(row.values[pointer]), row.values[pointer]);
    const found = [...values.values()];
    if (found.every((value) => typeof value === "number")) found.sort((a, b) => a - b);
    return found;
}

// "/strands/density" is "density", unless two axes would be called the same.
function axisLabel(pointer, pointers) {
    const parts = pointer.split("/");
    const last = parts.at(-1);
    const twins = pointers.filter((each) => each.split("/").at(-1) === last);
    return twins.length > 1 ? parts.slice(-2).join("/") : last;
}

const pointers = [...new Set(rows.flatMap((row) => Object.keys(row.values)))];
const axes = pointers.map((pointer) => {
    const values = axisValues(pointer);
    return {
        pointer,
        label: axisLabel(pointer, pointers),
        values,
        numeric: values.every((value) => typeof value === "number"),
    };
}).filter((axis) => axis.values.length > 1);
const axisOf = new Map(axes.map((axis) => [axis.pointer, axis]));

const sweptAxes = axes.filter((axis) => axis.pointer !== kReportAxis);

// What tells a case from the others, by name: "density 64, msaa 4".
function caseLabel(row, among = axes) {
    const parts = among.map((axis) => `${axis.label} ${valueText(row.values[axis.pointer])}`);
    return parts.length ? parts.join(", ") : row.name;
}
// By value alone, "64 \u00b7 4", and what these are values of.
function caseValues(row, among = axes) {
    const parts = among.map((axis) => valueText(row.values[axis.pointer]));
    return parts.length ? parts.join(" \u00b7 ") : row.name;
}
function caseValuesTitle(among = axes) { return among.map((axis) => axis.label).join(" \u00b7 "); }

const metricUnits = new Map();
for (const row of rows)
    for (const [name, metric] of Object.entries(row.metrics)) metricUnits.set(name, metric.unit);
const metricNames = [...metricUnits.keys()];
const passMetrics = metricNames.filter((name) => Object.hasOwn(page.pass_times, name));
const imageMetrics = metricNames.filter((name) => Object.hasOwn(page.image_metrics, name));
const timeMetrics = metricNames.filter((name) => metricUnits.get(name) === "ms");

function passName(metric) { return page.pass_times[metric]; }

function median(row, metric) { return row.metrics[metric]?.median; }

// [lower, upper] of what is drawn as a metric's uncertainty, if the report has it.
function spread(metric, kind) {
    if (kind === "interval" && metric.interval)
        return [metric.interval.lower, metric.interval.upper];
    if (kind === "quartiles" && metric.first_quartile !== undefined)
        return [metric.first_quartile, metric.third_quartile];
    return undefined;
}
const hasIntervals = rows.some((row) =>
    Object.values(row.metrics).some((metric) => metric.interval));

// The metric that comes first where one is to be chosen.
function preferred(names, ...wanted) {
    return wanted.find((name) => names.includes(name)) ?? names[0];
}
