// Collects a page's complaints from its start.
window.complaints = [];
addEventListener("error", (event) => complaints.push(`error: ${event.message}`), true);
addEventListener("unhandledrejection", (event) => complaints.push(`rejected: ${event.reason}`));
addEventListener("securitypolicyviolation", (event) => complaints.push(
    `policy: ${event.violatedDirective} ${event.blockedURI}`));
for (const kind of ["error", "warn"]) {
    const original = console[kind];
    console[kind] = (...words) => {
        complaints.push(`console.${kind}: ${words.join(" ")}`);
        original(...words);
    };
}
