// ---- Two pictures, held against each other -----------------------------------------------------

// The left one lies on the right one, cut off at the slider.
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
