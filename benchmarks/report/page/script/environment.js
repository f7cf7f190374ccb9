// ---- Where and how it was measured -------------------------------------------------------------

function factText(key, value) {
    return key === "memory_bytes" ? `${number(value / 2 ** 30)} GiB` : valueText(value);
}

// "device.limits.x" -> text, of everything below an object.
function flattened(object, prefix = "") {
    return Object.entries(object ?? {}).flatMap(([key, value]) => {
        const name = prefix ? `${prefix}.${key}` : key;
        if (Array.isArray(value)) return [[name, value.map(valueText).join(" ")]];
        return value !== null && typeof value === "object"
            ? flattened(value, name) : [[name, factText(key, value)]];
    });
}

function rangeOf(numbers, text) {
    if (!numbers.length) return undefined;
    const least = Math.min(...numbers), most = Math.max(...numbers);
    return least === most ? text(least) : `${text(least)} to ${text(most)}`;
}

// Over all cases: what the conditions were and how samples came about.
function measuredConditions(report) {
    const of = (key) => report.cases.map((each) => each.conditions?.[key])
        .filter((value) => value !== undefined);
    const sampling = report.cases.flatMap((each) => each.sampling ?? []);
    const sum = (key) => sampling.length
        ? String(sampling.reduce((total, each) => total + (each[key] ?? 0), 0)) : undefined;
    const unsteady = sampling.filter((each) => each.steady === false).length;
    return [
        ["conditions.clock", rangeOf(of("clock_mhz"), (value) => `${number(value)} MHz`)],
        ["conditions.base_clock", rangeOf(of("base_clock_mhz"), (value) => `${number(value)} MHz`)],
        ["conditions.memory_clock", rangeOf(of("memory_clock_mhz"), (v) => `${number(v)} MHz`)],
        ["conditions.temperature",
            rangeOf(of("temperature"), (value) => `${number(value)} \u00b0C`)],
        ["conditions.steal", rangeOf(of("steal"), percent)],
        ["conditions.other_load", rangeOf(of("other_load"), percent)],
        ["conditions.throttle_reasons",
            [...new Set(of("throttle_reasons").flat())].join(", ") || undefined],
        ["sampling.rounds", rangeOf(sampling.map((each) => each.rounds), String)],
        ["sampling.warmup_rounds left out", sum("warmup_rounds")],
        ["sampling.throttled_rounds left out", sum("throttled_rounds")],
        ["sampling.not steady",
            unsteady ? counted(unsteady, "mode of a case", "modes of cases") : undefined],
        ["sampling.precision", rangeOf(sampling.map((each) => each.precision)
            .filter((value) => value !== undefined), percent)],
    ].filter(([, text]) => text !== undefined);
}

function reportFacts(report) {
    const {scene, environment} = report;
    return new Map([
        ...flattened(environment),
        ["scene.path", scene?.path ?? ""], ["scene.hash", scene?.hash ?? ""],
        ...["schema", "case_count", "order_seed", "shard", "interrupted"].flatMap((key) =>
            report[key] === undefined ? [] : flattened({[key]: report[key]})),
        ...measuredConditions(report),
    ]);
}

function factRow(name, facts) {
    const texts = facts.map((each) => each.get(name) ?? "");
    const differs = new Set(texts).size > 1;
    return element("tr", {class: differs ? "differs" : undefined},
        element("th", {scope: "row"}, name,
            differs ? element("span", {title: "differs"}, " \u2260") : ""),
        texts.map((text) => element("td", {}, text)));
}

function factTable(names, facts) {
    return element("div", {class: "scroll"}, element("table", {class: "facts"},
        severalReports ? element("thead", {}, element("tr", {}, element("th", {scope: "col"}, ""),
            page.reports.map((report) => element("th", {scope: "col"}, report.label)))) : "",
        element("tbody", {}, names.map((name) => factRow(name, facts)))));
}

function buildEnvironment() {
    const facts = page.reports.map(reportFacts);
    const names = [...new Set(facts.flatMap((each) => [...each.keys()]))];
    const isLimit = (name) => name.startsWith("device.limits.");
    const limits = names.filter(isLimit);
    const documents = page.reports.filter((report) => report.scene?.document);
    showOnly(byId("environment"), heading("Environment"),
        factTable(names.filter((name) => !isLimit(name)), facts),
        limits.length ? element("details", {}, element("summary", {}, "Limits of the device"),
            factTable(limits, facts)) : "",
        documents.map((report) => element("details", {},
            element("summary", {}, severalReports
                ? `Scene of ${report.label}, every parameter` : "Scene, every parameter"),
            element("pre", {tabindex: "0"}, JSON.stringify(report.scene.document, null, 2)))));
}
