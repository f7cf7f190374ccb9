// ---- Changes with their intervals. The verdicts are those of hairbench compare -----------------

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

// In two lines where there is little room.
function changeLabel(metric, name, narrow) {
    return narrow ? `${plain(shortened(metric, 24))}<br>${plain(shortened(name, 24))}`
        : plain(shortened(`${name}  ${metric}`, 70));
}

// Changes with their intervals, the largest, worst first.
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
