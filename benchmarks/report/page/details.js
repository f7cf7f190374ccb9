// ---- What was drawn: one picture a case --------------------------------------------------------

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
        missing ? `${counted(missing, "picture file is", "picture files are")} not there any more.`
            : ""].filter(Boolean).join(" ");
}

// The same case of the first two reports, or two cases of the only one.
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
            ? `None of the ${counted(missing.length, "picture file")} is there any more, the ` +
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
