// ---- Which cases are shown: one filter for all figures and tables ------------------------------

const filter = {text: "", hidden: new Map()};  // pointer -> texts of the values left out
const filterListeners = [];

function onFilterChange(listener) { filterListeners.push(listener); }

function rowText(row) {
    return [row.name, row.status, row.reason, ...row.warnings].filter(Boolean).join("\n");
}

// A regular expression where it is one, a text where it is not, in any case of letters.
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

function filterValue(row, key) {
    return key === "status" ? row.status : valueText(row.values[key]);
}

function filteredRows() {
    const matches = textMatcher(filter.text);
    return rows.filter((row) => matches(row) && [...filter.hidden].every(
        ([key, hidden]) => !hidden.has(filterValue(row, key))));
}

// Those that have something to plot.
function filteredOk() { return filteredRows().filter((row) => row.status === "ok"); }

function filterChanged() {
    byId("filter-count").textContent =
        `${filteredRows().length} of ${counted(rows.length, "case")}`;
    for (const listener of filterListeners) listener();
}

function chipsOf(key, label, texts) {
    const hidden = new Set();
    filter.hidden.set(key, hidden);
    const chips = texts.map((text) => toggle(text, true, (on) => {
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
    const groups = axes.map(
        (axis) => chipsOf(axis.pointer, axis.label, axis.values.map(valueText)));
    if (statuses.length > 1) groups.push(chipsOf("status", "status", statuses));
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
    byId("filter-count").textContent = `${rows.length} of ${counted(rows.length, "case")}`;
}
