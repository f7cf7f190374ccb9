// ---- B against A. The verdicts are those of hairbench compare: nothing is decided here ---------

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
    const other = page.reports[comparison.place + 1];
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
            `A: ${page.reports[0].file}, ${other.label}: ${other.file}. Overall: `,
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
    const others = page.comparisons.map((_, place) => [place,
        `${page.reports[place + 1].label}: ${page.reports[place + 1].file}`]);
    showOnly(section, heading("Comparison"),
        others.length > 1 ? element("div", {class: "controls"},
            choice("with A", "comparison-other", others, 0, (place) => {
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
