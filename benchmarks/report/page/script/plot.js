// ---- What all figures have in common -----------------------------------------------------------

const kNarrow = 620;  // px: below it, legends go under the figure

function isNarrow(div) { return div.clientWidth < kNarrow; }

function axisStyle(extra) {
    return {
        gridcolor: color("grid"), linecolor: color("line"), zerolinecolor: color("line"),
        automargin: true, ...extra, title: {text: extra?.title ?? "", standoff: 10},
    };
}

// A logarithmic axis has ticks at 1, 2 and 5 where it is short.
function scaleStyle(type) {
    return type === "log" ? {type: "log", dtick: undefined, exponentformat: "none"} : {type};
}

function legendStyle(div, title) {
    const style = {title: {text: plain(title ?? "")}, bgcolor: "rgba(0,0,0,0)", itemwidth: 44};
    return isNarrow(div)
        ? {...style, orientation: "h", yref: "container", y: 0, yanchor: "bottom", x: 0}
        : style;
}

function drawFigure(div, traces, layout) {
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
        // These only: Plotly's own list has one that sends the figure to its cloud.
        modeBarButtons: [["toImage"], ["zoom2d", "pan2d"],
            ["zoomIn2d", "zoomOut2d", "resetScale2d"]],
        plotlyServerURL: "",
        // A vector picture, for papers.
        toImageButtonOptions: {format: "svg", filename: `hairbench-${div.id}`},
    });
}
