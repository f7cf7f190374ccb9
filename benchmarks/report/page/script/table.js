// ---- Tables that sort by what is clicked -------------------------------------------------------

// Columns: title; text(row); numeric, value(row): what it sorts by; cell(row): its element.
function sortValue(column, row) {
    return column.numeric ? (column.value ?? column.text)(row) : column.text(row);
}

// What is not known comes last, whichever way it is sorted.
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
