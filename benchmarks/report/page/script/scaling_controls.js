// ---- What the scaling plot shows is chosen here ------------------------------------------------

const kScales = [["linear", "linear"], ["log", "logarithmic"]];

function axisChoices(list) { return list.map((axis) => [axis.pointer, axis.label]); }

function changeScaling(key, rehold) {
    return (value) => {
        scaling[key] = value;
        const x = axisOf.get(scaling.x);
        if (key === "x") scaling.xType = x.numeric && suitsLog(x.values) ? "log" : "linear";
        const free = freeAxes();
        for (const each of ["color", "facet"])
            if (!free.includes(axisOf.get(scaling[each]))) scaling[each] = "";
        if (scaling.facet === scaling.color) scaling.facet = "";
        if (rehold) holdOthers();
        buildScalingControls();
        drawScaling();
        byId(`scaling-${key}`)?.focus();
    };
}

function heldChoice(axis) {
    const id = `scaling-held-${axis.pointer}`;
    return choice(axis.label, id, [["", "all"], ...axis.values.map(
        (value) => [valueText(value), valueText(value)])],
    scaling.held.get(axis.pointer) ?? "", (text) => {
        if (text) scaling.held.set(axis.pointer, text);
        else scaling.held.delete(axis.pointer);
        drawScaling();
    });
}

function buildScalingControls() {
    const free = freeAxes(), x = axisOf.get(scaling.x);
    const spreads = [["interval", "interval of the median"], ["quartiles", "quartiles"],
        ["none", "none"]].filter(([kind]) => kind !== "interval" || hasIntervals);
    const held = free.filter((axis) => ![scaling.color, scaling.facet].includes(axis.pointer));
    const facetable = free.filter((axis) => axis.pointer !== scaling.color &&
        axis.values.length <= 12);
    showOnly(byId("scaling-controls"),
        choice("metric", "scaling-metric", metricNames.map((name) => [name, name]),
            scaling.metric, changeScaling("metric", false)),
        choice("across", "scaling-x", axisChoices(sweptAxes), scaling.x, changeScaling("x", true)),
        choice("colour", "scaling-color", [["", "none"], ...axisChoices(free)], scaling.color,
            changeScaling("color", true)),
        choice("small multiples", "scaling-facet", [["", "none"], ...axisChoices(facetable)],
            scaling.facet, changeScaling("facet", true)),
        x.numeric ? choice("x scale", "scaling-xType", kScales, scaling.xType,
            changeScaling("xType", false)) : "",
        choice("y scale", "scaling-yType", kScales, scaling.yType, changeScaling("yType", false)),
        choice("bars", "scaling-spread", spreads, scaling.spread, changeScaling("spread", false)),
        ...held.map(heldChoice));
}

function buildScaling() {
    const section = byId("scaling");
    if (!metricNames.length || !sweptAxes.length) {
        showOnly(section, heading("Scaling"), note("No axis has more than one value here."));
        return;
    }
    startScaling();
    showOnly(section, heading("Scaling"),
        element("div", {class: "controls", id: "scaling-controls"}),
        figure("scaling-plot",
            "A metric over an axis of the sweep; the table below has the figures."),
        element("p", {class: "note", id: "scaling-note"}));
    buildScalingControls();
    drawScaling();
    onFilterChange(drawScaling);
    onThemeChange(drawScaling);
    byId("scaling-plot").on("plotly_click",
        (event) => showSamplesOf(event.points[0].customdata, scaling.metric));
}
