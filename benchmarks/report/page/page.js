// ---- What was measured, where, and what to know before believing it ----------------------------

function described(terms) {
    return element("dl", {}, terms.filter(([, value]) => value !== undefined && value !== "")
        .map(([term, value]) => [element("dt", {}, term), element("dd", {}, value)]));
}

function statusCounts(cases) {
    return ["ok", "skipped", "failed"].map((status) => [
        status, cases.filter((each) => each.status === status).length]);
}

function statusBadges(cases) {
    return element("span", {class: "badges"}, statusCounts(cases)
        .filter(([status, count]) => count > 0 || status === "ok")
        .map(([status, count]) =>
            element("span", {class: `badge ${status}`}, `${count} ${status}`)));
}

function deviceText(device) {
    return [device?.name, device?.type && `(${device.type})`].filter(Boolean).join(" ");
}

// Drivers say their name again in their version, some of them.
function driverText(device) {
    return [device?.driver, device?.driver_version,
        device?.api_version && `Vulkan ${device.api_version}`].filter(Boolean).join(", ");
}

function buildText(build) {
    if (!build) return undefined;
    const dirty = build.dirty && !build.commit?.endsWith("-dirty") ? " with changes" : "";
    return [`${build.commit ?? ""}${dirty}`, build.compiler, build.type].filter(Boolean).join(", ");
}

function extreme(report, sign) {
    const measured = rows.filter((row) => row.report === report && median(row, "frame.time") > 0);
    measured.sort((a, b) => sign * (median(a, "frame.time") - median(b, "frame.time")));
    if (!measured.length) return undefined;
    const [row] = measured;
    const fps = median(row, "fps");
    return `${quantity(median(row, "frame.time"), "ms")}` +
        `${fps ? ` (${number(fps)} fps)` : ""}: ${caseLabel(row, sweptAxes)}`;
}

function reportCard(report) {
    const sampled = report.cases.flatMap((each) => each.sampling ?? []);
    const seconds = sampled.reduce((sum, each) => sum + (each.seconds ?? 0), 0);
    const warned = report.cases.filter((each) => each.trust?.warnings?.length).length;
    return element("article", {class: "card"},
        element("h3", {}, severalReports ? `${report.label}: ${report.file}` : report.file),
        described([
            ["Device", deviceText(report.environment?.device)],
            ["Driver", driverText(report.environment?.device)],
            ["Build", buildText(report.environment?.build)],
            ["Measured", report.environment?.started?.replace("T", " ").replace("Z", " UTC")],
            ["Cases", statusBadges(report.cases)],
            ["Fastest", extreme(report, 1)],
            ["Slowest", extreme(report, -1)],
            ["Sampling", seconds > 0 ? `${number(seconds)} s` : undefined],
            ["Warnings", warned ? `${counted(warned, "case")} with warnings` : "none"],
        ]),
        report.interrupted
            ? note("The run was stopped: these are the cases that were done.") : "",
        report.environment?.validation
            ? note("The validation layer was on: these times are of no use.") : "");
}

// Equal sentences of several cases once.
function grouped(pairs) {
    const groups = new Map();
    for (const [text, row] of pairs) groups.set(text, [...(groups.get(text) ?? []), row]);
    return [...groups].sort((a, b) => b[1].length - a[1].length);
}

function findings(title, pairs) {
    if (!pairs.length) return "";
    return element("details", {class: "findings"},
        element("summary", {}, title),
        element("ul", {}, grouped(pairs).map(([text, found]) => element("li", {}, text,
            element("span", {class: "faint"}, " \u2013 " + (found.length > 3
                ? `${found.length} cases` : found.map((row) => caseLabel(row)).join("; ")))))));
}

function buildSummary() {
    const [first] = page.reports;
    byId("title").textContent = page.title;
    const description = first.scene?.document?.description;
    byId("description").textContent = description ?? "";
    showOnly(byId("reports"), ...page.reports.map(reportCard));
    const warnings = rows.flatMap((row) => row.warnings.map((text) => [text, row]));
    const left = rows.filter((row) => row.status !== "ok")
        .map((row) => [`${row.status}: ${row.reason ?? "no reason was given"}`, row]);
    showOnly(byId("findings"),
        findings(`\u26a0 ${counted(warnings.length, "warning")}`, warnings),
        findings(`${counted(left.length, "case")} without figures`, left));
}
