// ---- Elements. Text goes in as text, never as HTML: names of cases are not ours ----------------

function element(name, attributes, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes ?? {})) {
        if (value === undefined || value === false) continue;
        if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
        else if (key === "dataset") Object.assign(made.dataset, value);
        else made.setAttribute(key, value === true ? "" : value);
    }
    made.append(...children.flat(Infinity).filter((child) => (child ?? undefined) !== undefined));
    return made;
}

function byId(id) { return document.getElementById(id); }

// A labelled list to choose from; `options` are [value, text].
function choice(label, id, options, value, onChange) {
    const list = element("select", {id, onchange: () => onChange(list.value)},
        options.map(([each, text]) => element("option", {value: each}, text)));
    list.value = value;
    return element("label", {class: "choice", for: id}, element("span", {}, label), list);
}

// A button that is on or off.
function toggle(text, on, onChange, attributes) {
    const button = element("button", {type: "button", class: "chip", "aria-pressed": String(on),
        onclick: () => {
            const now = button.getAttribute("aria-pressed") !== "true";
            button.setAttribute("aria-pressed", String(now));
            onChange(now);
        }, ...attributes}, text);
    return button;
}

function heading(text) { return element("h2", {}, text); }

function note(text) { return element("p", {class: "note"}, text); }

// A figure's place, and what it is for those who don't see it.
function figure(id, description) {
    return element("div", {id, class: "figure", role: "img", "aria-label": description});
}

function showOnly(section, ...children) { section.replaceChildren(...children.flat(Infinity)); }
