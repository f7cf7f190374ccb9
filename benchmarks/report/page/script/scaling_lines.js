// ---- Lines and axes of the scaling plot --------------------------------------------------------

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
    lines.push(...row.warnings.map((text) => plain(`\u26a0 ${shortened(text, 70)}`)));
    return lines.join("<br>");
}

// The bars of an uncertainty round the medians, as Plotly wants them.
function errorBars(metrics, kind) {
    const size = shownUnit(metrics[0]?.unit).size;
    const ends = metrics.map((metric) => spread(metric, kind));
    // Plotly draws nothing for what is no number.
    const end = (place, length) => metrics.map((metric, i) =>
        ends[i] ? Math.max(0, length(ends[i][place], metric.median)) / size : NaN);
    return {
        type: "data", symmetric: false, thickness: 1.3, width: 4,
        array: end(1, (upper, middle) => upper - middle),
        arrayminus: end(0, (lower, middle) => middle - lower),
        visible: kind !== "none",
    };
}

// `seen`: what lines before it have used, names for the legend and dashes.
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
                seriesSymbol(index) + (row.warnings.length ? "-open" : "")),
        },
        text: sorted.map((row) => hoverText(row, scaling.metric)), hoverinfo: "text",
        customdata: sorted.map((row) => row.id),
    };
}

// Axes of a grid of facets, side by side where there is room.
function facetAxes(div, facets) {
    const x = axisOf.get(scaling.x), count = Math.max(1, facets.length);
    const columns = Math.min(count, Math.max(1, Math.floor(div.clientWidth / 330)));
    const across = Math.ceil(count / columns);
    const ticks = x.numeric && x.values.length <= 10
        ? {tickmode: "array", tickvals: x.values, ticktext: x.values.map(String)} : {};
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
