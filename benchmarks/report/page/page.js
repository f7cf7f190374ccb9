// Helpers for every section of the page, and the parts above all sections: the summary and the
// filter. Text is always inserted as text, never as HTML, because names of cases may come from
// anyone.

// ---- Elements -----------------------------------------------------------------------------------

function element(name, attributes, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes ?? {})) {
        if (value === undefined || value === false) continue;
        if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
        else if (key === "dataset") Object.assign(made.dataset, value);
        else made.setAttribute(key, value === true ? "" : value);
    }
    made.append(...children.flat(Infinity).filter((child) => (child ?? undefined) !== undefined));
    return made;
}

function byId(id) { return document.getElementById(id); }

// A labelled drop-down list; `options` are [value, text].
function choice(label, id, options, value, onChange) {
    const list = element("select", {id, onchange: () => onChange(list.value)},
        options.map(([each, text]) => element("option", {value: each}, text)));
    list.value = value;
    return element("label", {class: "choice", for: id}, element("span", {}, label), list);
}

// A button with an on state and an off state.
function toggle(text, on, onChange, attributes) {
    const button = element("button", {type: "button", class: "chip", "aria-pressed": String(on),
        onclick: () => {
            const now = button.getAttribute("aria-pressed") !== "true";
            button.setAttribute("aria-pressed", String(now));
            onChange(now);
        }, ...attributes}, text);
    return button;
}

function heading(text) { return element("h2", {}, text); }

function note(text) { return element("p", {class: "note"}, text); }

// An empty place for a figure, with a description for screen readers.
function figure(id, description) {
    return element("div", {id, class: "figure", role: "img", "aria-label": description});
}

function showOnly(section, ...children) { section.replaceChildren(...children.flat(Infinity)); }

// ---- Numbers and names for people ---------------------------------------------------------------

// Four significant digits; uses an exponent only for very small or large numbers.
function number(value) {
    if (value === undefined || value === null || !Number.isFinite(value)) return "";
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-5 || size >= 1e9)) return value.toExponential(3);
    const decimals = size === 0 ? 0 : Math.max(0, 3 - Math.floor(Math.log10(size)));
    const text = value.toFixed(Math.min(decimals, 9));
    return (text.includes(".") ? text.replace(/\.?0+$/, "") : text).replace("-", "\u2212");
}

function percent(share, digits = 1) {
    return `${(share * 100).toFixed(digits)} %`.replace("-", "\u2212");
}

// Formats a change in percent, with its sign.
function signedPercent(share) {
    return Number.isFinite(share) ? (share > 0 ? "+" : "") + percent(share) : "";
}

const kMebibyte = 1048576;

// Returns the unit to show a metric in, and how many of the metric's units make one of it.
function shownUnit(unit) {
    if (unit === "B") return {text: "MiB", size: kMebibyte};
    return {text: unit === "1" || !unit ? "" : unit, size: 1};
}

function quantity(value, unit) {
    const shown = shownUnit(unit);
    return shown.text ? `${number(value / shown.size)}\u00a0${shown.text}` : number(value);
}

function metricTitle(name, unit) {
    const shown = shownUnit(unit);
    return shown.text ? `${name} (${shown.text})` : name;
}

// Returns an axis value as text: a string as it is, anything else as JSON.
function valueText(value) {
    if (value === undefined) return "\u2013";
    return typeof value === "string" ? value : JSON.stringify(value);
}

// Escapes text for Plotly, which reads some HTML in its texts.
function plain(text) {
    return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function counted(count, one, many) { return `${count} ${count === 1 ? one : many ?? `${one}s`}`; }

function shortened(text, length) {
    return text.length <= length ? text : `${text.slice(0, length - 1)}\u2026`;
}

// ---- The reports as one list of cases -----------------------------------------------------------

const page = JSON.parse(byId("data").textContent);
const kReportAxis = "report";
const severalReports = page.reports.length > 1;

// Returns "thesis" for "scenes/thesis.json".
function sceneName(report) {
    return (report.scene?.path ?? "").split("/").at(-1).replace(/\.json$/, "");
}
const severalScenes = new Set(page.reports.map(sceneName)).size > 1;

// Returns the device's name, with the driver's version if another report has the same device with
// another driver.
function deviceName(report) {
    const {name, driver_version} = report.environment?.device ?? {};
    const twin = page.reports.some((each) => each.environment?.device?.name === name &&
        each.environment.device.driver_version !== driver_version);
    return twin ? `${name}, ${driver_version}` : name;
}

// Returns the back end that drew the strands. Older reports only know the back end that was asked
// for.
function drawnBy(report, each) {
    return each.backend?.name ?? each.axes["/strands/backend"] ??
        report.scene?.document?.strands?.backend;
}

// Returns the value that a JSON pointer (RFC 6901) names in a document, or undefined.
function valueAt(document, pointer) {
    return pointer.split("/").slice(1).reduce(
        (value, token) => value?.[token.replaceAll("~1", "/").replaceAll("~0", "~")], document);
}

// If only another report's sweep has an axis, a case's value on it is its scene's value.
const sweptPointers = [...new Set(page.reports.flatMap((report) => report.cases.flatMap(
    (each) => Object.keys(each.axes))))];
function allValues(report, each) {
    const filled = sweptPointers.map((pointer) => [pointer,
        each.axes[pointer] ?? valueAt(report.scene?.document, pointer)]);
    return {[kReportAxis]: report.label,
        ...Object.fromEntries(filled.filter(([, value]) => value !== undefined))};
}

// One row per case of every report. With several reports, the report is an axis of its own.
const rows = page.reports.flatMap((report, index) => report.cases.map((each, place) => ({
    ...each,
    report,
    reportIndex: index,
    number: each.index ?? place,
    id: `${index}:${each.name}`,
    metrics: each.metrics ?? {},
    warnings: each.trust?.warnings ?? [],
    reasons: each.verdict?.reasons ?? [],  // why it is not trusted
    facets: {scene: sceneName(report), device: deviceName(report),
        backend: drawnBy(report, each)},
    values: severalReports ? allValues(report, each) : each.axes,
})));

function axisValues(pointer) {
    const values = new Map();
    for (const row of rows) values.set(valueText(row.values[pointer]), row.values[pointer]);
    const found = [...values.values()];
    if (areNumbers(found)) found.sort((a, b) => a - b);
    return found;
}

// Cases of other scenes have no value on an axis; sort() puts undefined last.
function areNumbers(values) {
    const known = values.filter((value) => value !== undefined);
    return known.length > 0 && known.every((value) => typeof value === "number");
}

// Returns "density" for "/strands/density", unless two axes would get the same label.
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
        numeric: areNumbers(values),
    };
}).filter((axis) => axis.values.length > 1);
const axisOf = new Map(axes.map((axis) => [axis.pointer, axis]));

const sweptAxes = axes.filter((axis) => axis.pointer !== kReportAxis);

// Returns a label with the values that tell the case from others: "density 64, msaa 4".
function caseLabel(row, among = axes) {
    if (severalScenes) return `${row.report.label}: ${row.name}`;
    const parts = among.map((axis) => `${axis.label} ${valueText(row.values[axis.pointer])}`);
    return parts.length ? parts.join(", ") : row.name;
}

// Returns the case's values alone, "64 \u00b7 4". caseValuesTitle() names their axes.
function caseValues(row, among = axes) {
    if (severalScenes) return caseLabel(row);
    const parts = among.map((axis) => valueText(row.values[axis.pointer]));
    return parts.length ? parts.join(" \u00b7 ") : row.name;
}
function caseValuesTitle(among = axes) {
    return severalScenes ? "case" : among.map((axis) => axis.label).join(" \u00b7 ");
}

const metricUnits = new Map();
for (const row of rows)
    for (const [name, metric] of Object.entries(row.metrics)) metricUnits.set(name, metric.unit);
const metricNames = [...metricUnits.keys()];
const passMetrics = metricNames.filter((name) => Object.hasOwn(page.pass_times, name));
const imageMetrics = metricNames.filter((name) => Object.hasOwn(page.image_metrics, name));
const timeMetrics = metricNames.filter((name) => metricUnits.get(name) === "ms");

function passName(metric) { return page.pass_times[metric]; }

// Returns what a reader has to know before believing the case.
function cautions(row) { return [...row.reasons, ...row.warnings]; }

function median(row, metric) { return row.metrics[metric]?.median; }

// Returns [lower, upper] of the uncertainty to draw for a metric, if the report has it.
function spread(metric, kind) {
    if (kind === "interval" && metric.interval)
        return [metric.interval.lower, metric.interval.upper];
    if (kind === "quartiles" && metric.first_quartile !== undefined)
        return [metric.first_quartile, metric.third_quartile];
    return undefined;
}
const hasIntervals = rows.some((row) =>
    Object.values(row.metrics).some((metric) => metric.interval));

// Returns the preferred metric for a choice, otherwise the first one.
function preferred(names, ...wanted) {
    return wanted.find((name) => names.includes(name)) ?? names[0];
}

// ---- Light and dark -----------------------------------------------------------------------------

const themeListeners = [];

function onThemeChange(listener) { themeListeners.push(listener); }

function color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Okabe and Ito 2008, Color universal design: colour-blind people can tell them apart. The dark
// theme has lighter colours.
const kSeriesColors = {
    light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#d29200", "#3a9bd4", "#6a4c93", "#555555"],
    dark: ["#56b4e9", "#ff8a3d", "#2fc79a", "#e79bc4", "#f0c419", "#9ad0f5", "#b79ce0", "#bbbbbb"],
};
const kSymbols = ["circle", "square", "diamond", "triangle-up", "cross", "x", "star", "hexagon"];
const kDashes = ["solid", "dash", "dot", "dashdot", "longdash", "longdashdot"];
const kPatterns = ["", "/", "x", "."];

function theme() { return document.documentElement.dataset.theme; }
function seriesColor(index) {
    const colors = kSeriesColors[theme()];
    return colors[index % colors.length];
}
function seriesSymbol(index) { return kSymbols[index % kSymbols.length]; }
function seriesDash(index) { return kDashes[index % kDashes.length]; }
// Tells series apart by pattern once the colours repeat.
function seriesPattern(index) {
    return kPatterns[Math.floor(index / kSeriesColors.light.length) % kPatterns.length];
}

function setTheme(name) {
    if (theme() === name) return;
    document.documentElement.dataset.theme = name;
    const button = byId("theme");
    button.textContent = name === "dark" ? "\u2600 light" : "\u263e dark";
    button.setAttribute("aria-label", `Switch to ${name === "dark" ? "light" : "dark"} colours`);
    for (const listener of themeListeners) listener();
}

function startTheme() {
    const system = matchMedia("(prefers-color-scheme: dark)");
    const systemTheme = () => (system.matches ? "dark" : "light");
    setTheme(systemTheme());
    system.addEventListener("change", () => setTheme(systemTheme()));
    byId("theme").addEventListener("click", () => setTheme(theme() === "dark" ? "light" : "dark"));
    // Paper is white.
    let screen;
    addEventListener("beforeprint", () => {
        screen = theme();
        setTheme("light");
    });
    addEventListener("afterprint", () => setTheme(screen));
}

// ---- Helpers for all figures --------------------------------------------------------------------

const kNarrow = 620;  // px: on narrower figures, the legend goes below

function isNarrow(div) { return div.clientWidth < kNarrow; }

function axisStyle(extra) {
    return {
        gridcolor: color("grid"), linecolor: color("line"), zerolinecolor: color("line"),
        automargin: true, ...extra, title: {text: extra?.title ?? "", standoff: 10},
    };
}

// With dtick undefined, a short logarithmic axis has ticks at 1, 2 and 5.
function scaleStyle(type) {
    return type === "log" ? {type: "log", dtick: undefined, exponentformat: "none"} : {type};
}

function legendStyle(div, title) {
    const style = {title: {text: plain(title ?? "")}, bgcolor: "rgba(0,0,0,0)", itemwidth: 44};
    return isNarrow(div)
        ? {...style, orientation: "h", yref: "container", y: 0, yanchor: "bottom", x: 0}
        : style;
}

// Stands in for Plotly where the browser cannot unpack it.
function drawNothing(div) {
    div.textContent = "This browser cannot draw the figures: it lacks DecompressionStream, which"
        + " Chrome 80, Firefox 113 and Safari 16.4 and later have. The tables are complete.";
    div.on = () => {};
}

function drawFigure(div, traces, layout) {
    if (typeof Plotly === "undefined") return drawNothing(div);
    const fonts = {family: "inherit", size: 13, color: color("text")};
    return Plotly.react(div, traces, {
        font: fonts, paper_bgcolor: color("card"), plot_bgcolor: color("card"),
        margin: {l: 56, r: 16, t: 24, b: 48}, hovermode: "closest", height: 460,
        hoverlabel: {bgcolor: color("card"), bordercolor: color("line"), font: fonts,
            align: "left"},
        modebar: {bgcolor: "rgba(0,0,0,0)", color: color("faint"), activecolor: color("accent")},
        ...layout,
    }, {
        responsive: true, displaylogo: false,
        // Only these buttons: Plotly's default list has one that sends the figure to its cloud.
        modeBarButtons: [["toImage"], ["zoom2d", "pan2d"],
            ["zoomIn2d", "zoomOut2d", "resetScale2d"]],
        plotlyServerURL: "",
        // Saves a vector picture, for papers.
        toImageButtonOptions: {format: "svg", filename: `hairbench-${div.id}`},
    });
}

// ---- Tables that sort by a clicked column -------------------------------------------------------

// Columns have title; text(row); numeric; value(row), the key to sort by; cell(row), its element.
function sortValue(column, row) {
    return column.numeric ? (column.value ?? column.text)(row) : column.text(row);
}

// Puts unknown values last in either direction.
function compareRows(column, direction) {
    return (a, b) => {
        const left = sortValue(column, a), right = sortValue(column, b);
        const leftMissing = left === undefined || left === "";
        const rightMissing = right === undefined || right === "";
        if (leftMissing || rightMissing) return leftMissing - rightMissing;
        return direction * (column.numeric ? left - right
            : String(left).localeCompare(String(right), "en", {numeric: true}));
    };
}

function headerCell(table, columns, column, index) {
    const sort = table.sort?.index === index ? table.sort.direction : 0;
    return element("th", {scope: "col", class: column.numeric ? "numeric" : undefined,
        "aria-sort": sort > 0 ? "ascending" : sort < 0 ? "descending" : "none"},
    element("button", {type: "button", title: column.hint, onclick: () => {
        table.sort = {index, direction: sort > 0 ? -1 : 1};
        fillTable(table, columns, table.rowsShown);
        table.querySelectorAll("thead button")[index].focus();
    }}, column.title, element("span", {class: "arrow", "aria-hidden": "true"},
        sort > 0 ? "\u25b2" : sort < 0 ? "\u25bc" : "")));
}

function bodyCell(column, row, index) {
    const content = column.cell ? column.cell(row) : column.text(row) ?? "";
    return element(index === 0 ? "th" : "td", {
        scope: index === 0 ? "row" : undefined,
        class: [column.numeric && "numeric", column.wide && "wide"].filter(Boolean).join(" ")
            || undefined}, content);
}

function fillTable(table, columns, shown) {
    table.rowsShown = shown;
    const sorted = table.sort
        ? [...shown].sort(compareRows(columns[table.sort.index], table.sort.direction)) : shown;
    showOnly(table,
        element("thead", {}, element("tr", {},
            columns.map((column, index) => headerCell(table, columns, column, index)))),
        element("tbody", {}, sorted.map((row) => element("tr",
            {dataset: {status: row.status ?? ""}},
            columns.map((column, index) => bodyCell(column, row, index))))));
}

// ---- Summary ------------------------------------------------------------------------------------
// The measured cases, the machines, and warnings about the results.

function described(terms) {
    return element("dl", {}, terms.filter(([, value]) => value !== undefined && value !== "")
        .map(([term, value]) => [element("dt", {}, term), element("dd", {}, value)]));
}

function statusCounts(cases) {
    return ["ok", "skipped", "failed"].map((status) => [
        status, cases.filter((each) => each.status === status).length]);
}

const kTrustLevels = ["trusted", "doubtful", "untrusted"];

// "5 trusted, 11 doubtful"
function trustCounts(cases) {
    return kTrustLevels
        .map((level) => [level, cases.filter((each) => each.verdict?.level === level).length])
        .filter(([, count]) => count > 0).map(([level, count]) => `${count} ${level}`).join(", ");
}

// Returns the badge class of the worst verdict among the cases.
function worstTrust(cases) {
    return [...kTrustLevels].reverse().find(
        (level) => cases.some((each) => each.verdict?.level === level)) ?? "ok";
}

function statusBadges(cases) {
    return element("span", {class: "badges"}, statusCounts(cases)
        .filter(([status, count]) => count > 0 || status === "ok")
        .map(([status, count]) => {
            const trust = status === "ok" ? trustCounts(cases) : "";
            return element("span", {class: `badge ${trust ? worstTrust(cases) : status}`},
                `${count} ${status}${trust ? `: ${trust}` : ""}`);
        }));
}

function deviceText(device) {
    return [device?.name, device?.type && `(${device.type})`].filter(Boolean).join(" ");
}

// Some drivers repeat their name in their version.
function driverText(device) {
    return [device?.driver, device?.driver_version,
        device?.api_version && `Vulkan ${device.api_version}`].filter(Boolean).join(", ");
}

function buildText(build) {
    if (!build) return undefined;
    const dirty = build.dirty && !build.commit?.endsWith("-dirty") ? " with changes" : "";
    return [`${build.commit ?? ""}${dirty}`, build.compiler, build.type].filter(Boolean).join(", ");
}

function extreme(report, sign) {
    const measured = rows.filter((row) => row.report === report && median(row, "frame.time") > 0);
    measured.sort((a, b) => sign * (median(a, "frame.time") - median(b, "frame.time")));
    if (!measured.length) return undefined;
    const [row] = measured;
    const fps = median(row, "fps");
    return `${quantity(median(row, "frame.time"), "ms")}` +
        `${fps ? ` (${number(fps)} fps)` : ""}: ${caseLabel(row, sweptAxes)}`;
}

function reportCard(report) {
    const sampled = report.cases.flatMap((each) => each.sampling ?? []);
    const seconds = sampled.reduce((sum, each) => sum + (each.seconds ?? 0), 0);
    const warned = report.cases.filter((each) => each.trust?.warnings?.length).length;
    return element("article", {class: "card"},
        element("h3", {}, severalReports ? `${report.label}: ${report.file}` : report.file),
        described([
            ["Device", deviceText(report.environment?.device)],
            ["Driver", driverText(report.environment?.device)],
            ["Build", buildText(report.environment?.build)],
            ["Measured", report.environment?.started?.replace("T", " ").replace("Z", " UTC")],
            ["Cases", statusBadges(report.cases)],
            ["Fastest", extreme(report, 1)],
            ["Slowest", extreme(report, -1)],
            ["Sampling", seconds > 0 ? `${number(seconds)} s` : undefined],
            ["Warnings", warned ? `${counted(warned, "case")} with warnings` : "none"],
        ]),
        report.untrusted ? note(`\u26a0 Not to be trusted: ${report.untrusted}`) : "",
        report.corrections ? note(`Corrected: ${report.corrections}.`) : "",
        report.interrupted
            ? note("The run was stopped: these are the cases that were done.") : "",
        report.environment?.validation
            ? note("The validation layer was on: these times can't be used.") : "");
}

// Groups the cases of equal sentences.
function grouped(pairs) {
    const groups = new Map();
    for (const [text, row] of pairs) groups.set(text, [...(groups.get(text) ?? []), row]);
    return [...groups].sort((a, b) => b[1].length - a[1].length);
}

function findings(title, pairs) {
    if (!pairs.length) return "";
    return element("details", {class: "findings"},
        element("summary", {}, title),
        element("ul", {}, grouped(pairs).map(([text, found]) => element("li", {}, text,
            element("span", {class: "faint"}, " \u2013 " + (found.length > 3
                ? `${found.length} cases` : found.map((row) => caseLabel(row)).join("; ")))))));
}

function buildSummary() {
    const [first] = page.reports;
    byId("title").textContent = page.title;
    const description = first.scene?.document?.description;
    byId("description").textContent = severalScenes ? "" : description ?? "";
    showOnly(byId("reports"), ...page.reports.map(reportCard));
    const warnings = rows.flatMap((row) => row.warnings.map((text) => [text, row]));
    const left = rows.filter((row) => row.status !== "ok")
        .map((row) => [`${row.status}: ${row.reason ?? "no reason was given"}`, row]);
    const doubts = rows.filter((row) => row.verdict && row.verdict.level !== "trusted");
    // By check, because sentences differ in their figures; the table of cases has them.
    const reasons = doubts.flatMap((row) => row.reasons.map((text) => [text.split(":")[0], row]));
    showOnly(byId("findings"),
        page.left_out.length ? element("div", {},
            note("Left out, because they are not reports of 'hairbench run':"),
            element("ul", {}, page.left_out.map(({file, reason}) =>
                element("li", {}, `${file}: ${reason}`)))) : "",
        findings(`\u26a0 ${counted(doubts.length, "case is", "cases are")} not trusted: ` +
            trustCounts(doubts), reasons),
        findings(`\u26a0 ${counted(warnings.length, "warning")}`, warnings),
        findings(`${counted(left.length, "case")} without figures`, left));
}

// ---- Filter -------------------------------------------------------------------------------------
// One filter of the cases for all figures and tables.

const filter = {text: "", hidden: new Map()};  // pointer -> texts of the hidden values
const filterListeners = [];

function onFilterChange(listener) { filterListeners.push(listener); }

function rowText(row) {
    return [row.name, row.status, row.reason, row.verdict?.level, ...cautions(row)].filter(Boolean).join("\n");
}

// Matches a regular expression, or a plain text if it is not one. Ignores case.
function textMatcher(text) {
    if (!text) return () => true;
    try {
        const pattern = new RegExp(text, "i");
        return (row) => pattern.test(rowText(row));
    } catch {
        const lower = text.toLowerCase();
        return (row) => rowText(row).toLowerCase().includes(lower);
    }
}

const kFacets = [["scene", "scene"], ["device", "device"], ["backend", "back end"]];

function filterValue(row, key) {
    if (key === "status") return row.status;
    if (key === "trust") return valueText(row.verdict?.level);
    return valueText(key in row.facets ? row.facets[key] : row.values[key]);
}

function filteredRows() {
    const matches = textMatcher(filter.text);
    return rows.filter((row) => matches(row) && [...filter.hidden].every(
        ([key, hidden]) => !hidden.has(filterValue(row, key))));
}

// Returns the filtered cases with results to plot.
function filteredOk() { return filteredRows().filter((row) => row.status === "ok"); }

function filterChanged() {
    byId("filter-count").textContent =
        `${filteredRows().length} of ${counted(rows.length, "case")}`;
    for (const listener of filterListeners) listener();
}

function chipsOf(key, label, texts) {
    const hidden = filter.hidden.get(key) ?? new Set();
    filter.hidden.set(key, hidden);
    const chips = texts.map((text) => toggle(text, !hidden.has(text), (on) => {
        if (on) hidden.delete(text);
        else hidden.add(text);
        filterChanged();
    }, {dataset: {filter: key, value: text}}));
    return element("div", {class: "chips", role: "group", "aria-label": label, title: key},
        element("span", {class: "chips-label"}, label), chips);
}

function buildFilter() {
    let waiting;
    const box = element("input", {type: "search", id: "filter-text", "aria-label": "Filter",
        placeholder: "text or regular expression, e.g. density:(16|32)",
        oninput: () => {
            clearTimeout(waiting);
            waiting = setTimeout(() => {
                filter.text = box.value;
                filterChanged();
            }, 150);
        }});
    const statuses = [...new Set(rows.map((row) => row.status))];
    const facets = severalReports ? kFacets.map(([key, label]) => [key, label,
        [...new Set(rows.map((row) => filterValue(row, key)))]])
        .filter(([, , texts]) => texts.length > 1) : [];
    // Figures of several scenes at once are meaningless, so the page starts with the first scene.
    if (severalScenes) filter.hidden.set("scene", new Set(page.reports.map(sceneName).filter(
        (name) => name !== sceneName(page.reports[0]))));
    const groups = [
        ...facets.map(([key, label, texts]) => chipsOf(key, label, texts)),
        ...axes.map((axis) => chipsOf(axis.pointer, axis.label, axis.values.map(valueText)))];
    if (statuses.length > 1) groups.push(chipsOf("status", "status", statuses));
    const levels = [...kTrustLevels, valueText(undefined)].filter(
        (level) => rows.some((row) => filterValue(row, "trust") === level));
    if (levels.length > 1) groups.push(chipsOf("trust", "trust", levels));
    const reset = element("button", {type: "button", id: "filter-reset", onclick: () => {
        box.value = filter.text = "";
        for (const hidden of filter.hidden.values()) hidden.clear();
        for (const chip of byId("filter").querySelectorAll(".chip"))
            chip.setAttribute("aria-pressed", "true");
        filterChanged();
    }}, "show all");
    showOnly(byId("filter"),
        element("div", {class: "filter-row"}, box,
            element("output", {id: "filter-count", "aria-live": "polite"}), reset),
        groups.length ? element("details", {open: innerWidth >= 800},
            element("summary", {}, "by axis"), groups) : "");
    byId("filter-count").textContent =
        `${filteredRows().length} of ${counted(rows.length, "case")}`;
}
