// ---- Numbers and names as people read them -----------------------------------------------------

// Four significant digits, never an exponent where digits do.
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

// With a sign: changes.
function signedPercent(share) {
    return Number.isFinite(share) ? (share > 0 ? "+" : "") + percent(share) : "";
}

const kMebibyte = 1048576;

// The unit that a metric is shown in, and how many of its own make one.
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

// An axis's value: a string as it is, all else as JSON.
function valueText(value) {
    if (value === undefined) return "\u2013";
    return typeof value === "string" ? value : JSON.stringify(value);
}

// Plotly takes some HTML in its texts; names of cases mean none.
function plain(text) {
    return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function counted(count, one, many) { return `${count} ${count === 1 ? one : many ?? `${one}s`}`; }

function shortened(text, length) {
    return text.length <= length ? text : `${text.slice(0, length - 1)}\u2026`;
}
