// Sections Comparison, Pictures, Cases and Environment, and the start of the page.

// ---- Comparison ---------------------------------------------------------------------------------
// The verdicts come from hairbench compare; this decides nothing.

const kVerdicts = {
    regressed: "\u25b2", improved: "\u25bc", same: "=", inconclusive: "?", mismatch: "\u2260",
};
const comparison = {place: 0, hidden: new Set()};

function comparedCases() { return new Set(filteredRows().map((row) => row.name)); }

function shownChanges() {
    const names = comparedCases();
    const {mismatches, changes} = page.comparisons[comparison.place];
    const differing = mismatches.map((each) => ({...each, verdict: "mismatch", metric: each.what}));
    return [...differing, ...changes].filter(
        (each) => names.has(each.case) && !comparison.hidden.has(each.verdict));
}

function rangeText(change) {
    const bound = (share) => (share === undefined ? "\u2026" : signedPercent(share));
    return change.lower === undefined && change.upper === undefined
        ? "too few samples" : `${bound(change.lower)} to ${bound(change.upper)}`;
}

// Returns the label in two lines on a narrow page.
function changeLabel(metric, name, narrow) {
    return narrow ? `${plain(shortened(metric, 24))}<br>${plain(shortened(name, 24))}`
        : plain(shortened(`${name}  ${metric}`, 70));
}

// Draws the largest changes with their intervals, worst first.
function drawChanges() {
    const kMost = 40;
    const all = shownChanges().filter((each) => Number.isFinite(each.change))
        .sort((a, b) => Math.abs(b.change) - Math.abs(a.change));
    const found = all.slice(0, kMost).sort((a, b) => b.change - a.change);
    byId("comparison-shown").textContent = found.length < all.length
        ? `The ${kMost} largest of ${all.length} changes; the table has them all.` : "";
    const div = byId("comparison-plot");
    div.hidden = !found.length;
    if (!found.length) return;
    const places = found.map((_, place) => place);
    const names = new Map(rows.map((row) => [row.name, caseValues(row, sweptAxes)]));
    const traces = Object.keys(kVerdicts).map((verdict) => {
        const mine = places.filter((place) => found[place].verdict === verdict);
        const of = (pick) => mine.map((place) => pick(found[place]));
        const bound = (each, key) => each[key] === undefined
            ? NaN : 100 * Math.abs(each[key] - each.change);
        return {
            type: "scatter", mode: "markers", name: `${kVerdicts[verdict]} ${verdict}`, y: mine,
            x: of((each) => 100 * each.change),
            marker: {color: color(verdict), size: 9,
                symbol: {regressed: "triangle-right", improved: "triangle-left", same: "circle",
                    inconclusive: "circle-open", mismatch: "x"}[verdict]},
            error_x: {type: "data", symmetric: false, color: color(verdict), thickness: 1.5,
                width: 3,
                array: of((each) => bound(each, "upper")),
                arrayminus: of((each) => bound(each, "lower"))},
            hoverinfo: "text", text: of((each) => plain(
                `${each.case}: ${each.metric} ${signedPercent(each.change)}, ${rangeText(each)}`)),
        };
    }).filter((trace) => trace.y.length);
    const tau = 100 * (found[0].decisive_change ?? 0);
    const narrow = isNarrow(div);
    drawFigure(div, traces, {
        height: 130 + (narrow ? 60 : 0) + found.length * (narrow ? 36 : 22),
        legend: legendStyle(div), showlegend: true,
        shapes: [{type: "rect", xref: "x", yref: "paper", x0: -tau, x1: tau, y0: 0, y1: 1,
            fillcolor: color("line"), opacity: 0.35, line: {width: 0}, layer: "below"}],
        xaxis: axisStyle({title: "change (%)", zeroline: true, nticks: narrow ? 5 : 10,
            tickangle: 0}),
        yaxis: axisStyle({tickmode: "array", tickvals: places, showgrid: false, zeroline: false,
            ticktext: found.map((each) => changeLabel(
                each.metric, names.get(each.case) ?? each.case, narrow)),
            range: [found.length - 0.5, -0.5]}),
    });
}

function verdictBadge(verdict) {
    return element("span", {class: `verdict ${verdict}`}, `${kVerdicts[verdict]} ${verdict}`);
}

function comparedLabel(change) {
    const row = rows.find((each) => each.name === change.case);
    return row ? caseValues(row, sweptAxes) : change.case;
}

const kComparisonColumns = [
    {title: sweptAxes.length ? caseValuesTitle(sweptAxes) : "case", text: comparedLabel,
        cell: (each) => element("span", {title: each.case}, comparedLabel(each))},
    {title: "metric", text: (each) => each.metric},
    {title: "verdict", text: (each) => each.verdict, cell: (each) => verdictBadge(each.verdict)},
    {title: "change", hint: "of the cost: positive is worse", numeric: true,
        value: (each) => each.change, text: (each) => signedPercent(each.change)},
    {title: "interval", numeric: true, value: (each) => each.lower,
        text: (each) => each.verdict === "mismatch" ? "" : rangeText(each)},
    {title: "A", numeric: true, value: (each) => each.verdict === "mismatch" ? undefined : each.a,
        text: (each) => each.verdict === "mismatch" ? each.a : quantity(each.a, each.unit)},
    {title: "B", numeric: true, value: (each) => each.verdict === "mismatch" ? undefined : each.b,
        text: (each) => each.verdict === "mismatch" ? each.b : quantity(each.b, each.unit)},
];

function drawComparison() {
    const found = page.comparisons[comparison.place];
    const first = page.reports[found.with], other = page.reports[found.report];
    const all = [...found.mismatches.map(() => "mismatch"),
        ...found.changes.map((each) => each.verdict)];
    const chips = Object.keys(kVerdicts).map((verdict) => [verdict,
        all.filter((each) => each === verdict).length]).filter(([, count]) => count > 0)
        .map(([verdict, count]) => toggle(`${kVerdicts[verdict]} ${count} ${verdict}`,
            !comparison.hidden.has(verdict), (on) => {
                if (on) comparison.hidden.delete(verdict);
                else comparison.hidden.add(verdict);
                fillComparison();
            }, {dataset: {verdict}}));
    showOnly(byId("comparison-head"),
        element("p", {class: "lead"},
            `${first.label}: ${first.file}, ${other.label}: ${other.file}. Overall: `,
            verdictBadge(found.verdict)),
        element("div", {class: "chips", role: "group", "aria-label": "Verdicts"}, chips),
        found.warnings.length ? element("details", {class: "warnings",
            open: found.warnings.length <= 3},
        element("summary", {}, `\u26a0 ${counted(found.warnings.length, "warning")}`),
        element("ul", {}, found.warnings.map((text) => element("li", {}, text)))) : "",
        found.unmatched.length ? note(`Not compared: ${found.unmatched.slice(0, 8).join("; ")}` +
            (found.unmatched.length > 8 ? " \u2026" : "")) : "");
    byId("comparison-note").textContent = [
        "Positive is worse. Shaded in the figure: below the threshold.",
        found.too_short.length
            ? `${counted(found.too_short.length, "metric")} too short to judge left out.` : "",
        found.caveat].filter(Boolean).join(" ");
    fillComparison();
}

function fillComparison() {
    fillTable(byId("comparison-table"), kComparisonColumns, shownChanges());
    drawChanges();
}

function buildComparison() {
    const section = byId("comparison");
    if (!page.comparisons.length) {
        section.remove();
        return;
    }
    const others = page.comparisons.map((each, place) => {
        const first = page.reports[each.with], other = page.reports[each.report];
        return [place, `${other.label}: ${other.file}, with ${first.label}`];
    });
    showOnly(section, heading("Comparison"),
        others.length > 1 ? element("div", {class: "controls"},
            choice("reports", "comparison-other", others, 0, (place) => {
                comparison.place = Number(place);
                drawComparison();
            })) : "",
        element("div", {id: "comparison-head"}),
        figure("comparison-plot", "Changes with their intervals; the table below has the figures."),
        element("p", {class: "note", id: "comparison-shown"}),
        element("div", {class: "scroll tall", tabindex: "0", role: "region",
            "aria-label": "Table of changes"}, element("table", {id: "comparison-table"})),
        element("p", {class: "note", id: "comparison-note"}));
    drawComparison();
    onFilterChange(fillComparison);
    onThemeChange(drawChanges);
}

// ---- Pictures: one per case ---------------------------------------------------------------------

const kMostCards = 60;
const pictures = {mode: "slider", gain: "1"};

function pictureOf(row) { return page.pictures[row.picture_id]; }
function rowsWithPictures() { return rows.filter((row) => row.picture_id !== undefined); }
function rowById(id) { return rows.find((row) => row.id === id); }

function pictureElement(row, attributes) {
    return element("img",
        {src: pictureOf(row), alt: `Picture of ${caseLabel(row)}`, ...attributes});
}

function chosenPictures() { return [rowById(pictures.left), rowById(pictures.right)]; }

function drawPictures() {
    const [left, right] = chosenPictures();
    const view = {slider: sliderView, pair: pairView, difference: differenceView}[pictures.mode];
    showOnly(byId("picture-view"), view(left, right),
        element("p", {class: "sides"}, element("span", {}, `left: ${caseLabel(left)}`),
            element("span", {}, `right: ${caseLabel(right)}`)),
        note(sameImageText(left, right)));
}

function buildPictureControls() {
    const options = rowsWithPictures().map((row) => [row.id, caseLabel(row)]);
    const change = (key) => (value) => {
        pictures[key] = value;
        buildPictureControls();
        drawPictures();
        byId(`picture-${key}`)?.focus();
    };
    showOnly(byId("picture-controls"),
        choice("left", "picture-left", options, pictures.left, change("left")),
        choice("right", "picture-right", options, pictures.right, change("right")),
        choice("view", "picture-mode", [["slider", "slider"], ["pair", "side by side"],
            ["difference", "difference"]], pictures.mode, change("mode")),
        pictures.mode === "difference" ? choice("times", "picture-gain",
            ["1", "4", "16", "64"].map((gain) => [gain, gain]), pictures.gain,
            change("gain")) : "");
}

function sideButton(row, side) {
    return element("button", {type: "button", "aria-label": `${caseLabel(row)} on the ${side}`,
        onclick: () => {
            pictures[side] = row.id;
            buildPictureControls();
            drawPictures();
            byId("pictures").scrollIntoView({behavior: "smooth"});
        }}, side);
}

function pictureCard(row) {
    const {unit, median: time} = row.metrics["frame.time"] ?? {};
    return element("figure", {class: "thumbnail"}, pictureElement(row, {loading: "lazy"}),
        element("figcaption", {}, caseLabel(row),
            time === undefined ? "" : element("span", {class: "faint"}, ` ${quantity(time, unit)}`),
            element("span", {class: "sides"}, sideButton(row, "left"), sideButton(row, "right"))));
}

function fillThumbnails() {
    const shown = filteredRows().filter((row) => row.picture_id !== undefined);
    showOnly(byId("thumbnails"), ...shown.slice(0, kMostCards).map(pictureCard));
    const missing = filteredRows().filter((row) => row.picture_missing).length;
    byId("thumbnails-note").textContent = [
        shown.length > kMostCards
            ? `${kMostCards} of ${shown.length} pictures; the filter chooses.` : "",
        missing ? `${counted(missing, "picture file is", "picture files are")} missing.`
            : ""].filter(Boolean).join(" ");
}

// Returns the same case of two reports, or two cases of a single report.
function firstPair(found) {
    const [left] = found;
    const right = found.find((row) => row.name === left.name && row !== left) ?? found[1] ?? left;
    return [left.id, right.id];
}

function buildPictures() {
    const section = byId("pictures"), found = rowsWithPictures();
    if (!found.length) {
        const missing = rows.filter((row) => row.picture_missing);
        showOnly(section, heading("Pictures"), note(missing.length
            ? `All ${counted(missing.length, "picture file")} are missing, the ` +
                `first: ${missing[0].picture_missing}`
            : "The cases have no pictures."));
        return;
    }
    [pictures.left, pictures.right] = firstPair(found);
    showOnly(section, heading("Pictures"),
        element("div", {class: "controls", id: "picture-controls"}),
        element("div", {id: "picture-view"}),
        element("details", {open: found.length <= 12 || innerWidth >= 800},
            element("summary", {}, "All pictures"), element("div", {id: "thumbnails"})),
        element("p", {class: "note", id: "thumbnails-note"}));
    buildPictureControls();
    drawPictures();
    fillThumbnails();
    onFilterChange(fillThumbnails);
}

// Lays the left picture over the right one and clips it at the slider.
function sliderView(left, right) {
    const view = element("div", {class: "wipe"}, pictureElement(right),
        pictureElement(left, {class: "over"}),
        element("div", {class: "split", "aria-hidden": "true"}));
    const split = (value) => view.style.setProperty("--split", `${value}%`);
    split(50);
    const slider = element("input", {type: "range", id: "picture-slider", min: "0", max: "100",
        value: "50", step: "0.5", "aria-label": "How much of the left picture is shown",
        oninput: (event) => split(event.target.value)});
    view.append(slider);
    return view;
}

function differenceView(left, right) {
    const view = element("div", {class: "difference"}, pictureElement(left),
        pictureElement(right, {class: "over"}));
    view.style.filter = `brightness(${pictures.gain})`;
    return view;
}

function pairView(left, right) {
    return element("div", {class: "pair"}, [left, right].map(
        (row) => element("figure", {}, pictureElement(row),
            element("figcaption", {}, caseLabel(row)))));
}

function sameImageText(left, right) {
    if (!left.image_hash || !right.image_hash) return "";
    return left.image_hash === right.image_hash
        ? "The measured pictures are equal in every pixel." : "The measured pictures differ.";
}

// ---- Cases --------------------------------------------------------------------------------------

// Half the median's interval over the median.
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
    return [row.reason, ...cautions(row).map((text) => `\u26a0 ${text}`)].filter(Boolean).join("; ");
}

function caseColumns() {
    const known = (name) => metricNames.includes(name);
    return [
        {title: "#", hint: "place in the sweep; shows its samples", numeric: true,
            value: (row) => row.number, text: (row) => `${row.number}`, cell: numberCell},
        ...(axes.length ? axes.map(axisColumn) : [{title: "case", text: (row) => row.name}]),
        {title: "status", text: (row) => row.status,
            cell: (row) => element("span", {class: `badge ${row.status}`}, row.status)},
        {title: "trust", hint: "verdict on the case's times; the last column has the reasons",
            text: (row) => row.verdict?.level ?? "",
            cell: (row) => row.verdict ? element("span", {class: `badge ${row.verdict.level}`,
                title: row.verdict.text}, row.verdict.level) : ""},
        ...(known("fps") ? [{...metricColumn("fps", "fps"), title: "fps",
            hint: "frames / all their time: the mean rate, not 1 / the median"}] : []),
        ...(known("frame.time") ? [metricColumn("frame.time", "frame")] : []),
        ...(hasIntervals ? [{title: "\u00b1", numeric: true,
            hint: "half the interval of frame.time's median / median", value: precision,
            text: (row) => precision(row) === undefined ? "" : percent(precision(row))}] : []),
        ...passMetrics.map((name) => metricColumn(name, passName(name))),
        ...(known("memory.device") ? [metricColumn("memory.device", "memory")] : []),
        ...imageMetrics.map((name) => metricColumn(name, name.slice("image.".length))),
        {title: "reasons, warnings", wide: true, text: noteText},
    ];
}

function buildCases() {
    const columns = caseColumns();
    showOnly(byId("cases"), heading("Cases"),
        note("Medians, except fps: frames over all their time. Click a heading to sort, a number " +
            "in the first column to see the samples."),
        element("div", {class: "scroll tall", tabindex: "0", role: "region",
            "aria-label": "Table of cases"}, element("table", {id: "cases-table"})));
    const update = () => fillTable(byId("cases-table"), columns, filteredRows());
    update();
    onFilterChange(update);
}

// ---- Environment --------------------------------------------------------------------------------
// The machines, and how the measurements were made.

function factText(key, value) {
    return key === "memory_bytes" ? `${number(value / 2 ** 30)} GiB` : valueText(value);
}

// Returns the entries of nested objects as ["device.limits.x", text].
function flattened(object, prefix = "") {
    return Object.entries(object ?? {}).flatMap(([key, value]) => {
        const name = prefix ? `${prefix}.${key}` : key;
        if (Array.isArray(value)) return [[name, value.map(valueText).join(" ")]];
        return value !== null && typeof value === "object"
            ? flattened(value, name) : [[name, factText(key, value)]];
    });
}

function rangeOf(numbers, text) {
    if (!numbers.length) return undefined;
    const least = Math.min(...numbers), most = Math.max(...numbers);
    return least === most ? text(least) : `${text(least)} to ${text(most)}`;
}

// Returns the conditions and the sampling over all cases.
function measuredConditions(report) {
    const of = (key) => report.cases.map((each) => each.conditions?.[key])
        .filter((value) => value !== undefined);
    const sampling = report.cases.flatMap((each) => each.sampling ?? []);
    const sum = (key) => sampling.length
        ? String(sampling.reduce((total, each) => total + (each[key] ?? 0), 0)) : undefined;
    const unsteady = sampling.filter((each) => each.steady === false).length;
    return [
        ["conditions.clock", rangeOf(of("clock_mhz"), (value) => `${number(value)} MHz`)],
        ["conditions.base_clock", rangeOf(of("base_clock_mhz"), (value) => `${number(value)} MHz`)],
        ["conditions.memory_clock", rangeOf(of("memory_clock_mhz"), (v) => `${number(v)} MHz`)],
        ["conditions.temperature",
            rangeOf(of("temperature"), (value) => `${number(value)} \u00b0C`)],
        ["conditions.steal", rangeOf(of("steal"), percent)],
        ["conditions.other_load", rangeOf(of("other_load"), percent)],
        ["conditions.throttle_reasons",
            [...new Set(of("throttle_reasons").flat())].join(", ") || undefined],
        ["sampling.rounds", rangeOf(sampling.map((each) => each.rounds), String)],
        ["sampling.warmup_rounds left out", sum("warmup_rounds")],
        ["sampling.throttled_rounds left out", sum("throttled_rounds")],
        ["sampling.not steady",
            unsteady ? counted(unsteady, "mode of a case", "modes of cases") : undefined],
        ["sampling.precision", rangeOf(sampling.map((each) => each.precision)
            .filter((value) => value !== undefined), percent)],
    ].filter(([, text]) => text !== undefined);
}

function reportFacts(report) {
    const {scene, environment} = report;
    return new Map([
        ...flattened(environment),
        ["scene.path", scene?.path ?? ""], ["scene.hash", scene?.hash ?? ""],
        ...["schema", "case_count", "order_seed", "shard", "interrupted"].flatMap((key) =>
            report[key] === undefined ? [] : flattened({[key]: report[key]})),
        ...measuredConditions(report),
    ]);
}

function factRow(name, facts) {
    const texts = facts.map((each) => each.get(name) ?? "");
    const differs = new Set(texts).size > 1;
    return element("tr", {class: differs ? "differs" : undefined},
        element("th", {scope: "row"}, name,
            differs ? element("span", {title: "differs"}, " \u2260") : ""),
        texts.map((text) => element("td", {}, text)));
}

function factTable(names, facts) {
    return element("div", {class: "scroll"}, element("table", {class: "facts"},
        severalReports ? element("thead", {}, element("tr", {}, element("th", {scope: "col"}, ""),
            page.reports.map((report) => element("th", {scope: "col"}, report.label)))) : "",
        element("tbody", {}, names.map((name) => factRow(name, facts)))));
}

function buildEnvironment() {
    const facts = page.reports.map(reportFacts);
    const names = [...new Set(facts.flatMap((each) => [...each.keys()]))];
    const isLimit = (name) => name.startsWith("device.limits.");
    const limits = names.filter(isLimit);
    const documents = page.reports.filter((report) => report.scene?.document);
    showOnly(byId("environment"), heading("Environment"),
        factTable(names.filter((name) => !isLimit(name)), facts),
        limits.length ? element("details", {}, element("summary", {}, "Limits of the device"),
            factTable(limits, facts)) : "",
        documents.map((report) => element("details", {},
            element("summary", {}, severalReports
                ? `Scene of ${report.label}, every parameter` : "Scene, every parameter"),
            element("pre", {tabindex: "0"}, JSON.stringify(report.scene.document, null, 2)))));
}

// ---- The page -----------------------------------------------------------------------------------

function buildContents() {
    const sections = [["devices", "Devices"], ["scaling", "Scaling"], ["passes", "Passes"], ["distributions", "Samples"],
        ["probes", "Probes"], ["quality", "Quality"], ["backends", "Back ends"], ["shaders", "Shaders"],
        ["comparison", "Comparison"],
        ["pictures", "Pictures"], ["cases", "Cases"], ["environment", "Environment"]];
    showOnly(byId("contents"), ...sections.filter(([id]) => byId(id)).map(
        ([id, text]) => element("a", {href: `#${id}`}, text)));
}

startTheme();
buildSummary();
buildFilter();
buildDevices();
buildScaling();
buildPasses();
buildSamples();
buildProbes();
buildQuality();
buildBackends();
buildShaders();
buildComparison();
buildPictures();
buildCases();
buildEnvironment();
buildContents();
