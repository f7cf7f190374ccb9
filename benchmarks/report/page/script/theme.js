// ---- Light and dark ----------------------------------------------------------------------------

const themeListeners = [];

function onThemeChange(listener) { themeListeners.push(listener); }

function color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Okabe and Ito 2008, Color universal design: told apart by the colour-blind. Lighter on dark.
const kSeriesColors = {
    light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#d29200", "#3a9bd4", "#6a4c93", "#555555"],
    dark: ["#56b4e9", "#ff8a3d", "#2fc79a", "#e79bc4", "#f0c419", "#9ad0f5", "#b79ce0", "#bbbbbb"],
};
const kSymbols = ["circle", "square", "diamond", "triangle-up", "cross", "x", "star", "hexagon"];
const kDashes = ["solid", "dash", "dot", "dashdot", "longdash", "longdashdot"];
const kPatterns = ["", "/", "x", "."];

function theme() { return document.documentElement.dataset.theme; }
function seriesColor(index) {
    const colors = kSeriesColors[theme()];
    return colors[index % colors.length];
}
function seriesSymbol(index) { return kSymbols[index % kSymbols.length]; }
function seriesDash(index) { return kDashes[index % kDashes.length]; }
// Beside the colour, where there are more things than colours.
function seriesPattern(index) {
    return kPatterns[Math.floor(index / kSeriesColors.light.length) % kPatterns.length];
}

function setTheme(name) {
    if (theme() === name) return;
    document.documentElement.dataset.theme = name;
    const button = byId("theme");
    button.textContent = name === "dark" ? "\u2600 light" : "\u263e dark";
    button.setAttribute("aria-label", `Switch to ${name === "dark" ? "light" : "dark"} colours`);
    for (const listener of themeListeners) listener();
}

function startTheme() {
    const system = matchMedia("(prefers-color-scheme: dark)");
    const systemTheme = () => (system.matches ? "dark" : "light");
    setTheme(systemTheme());
    system.addEventListener("change", () => setTheme(systemTheme()));
    byId("theme").addEventListener("click", () => setTheme(theme() === "dark" ? "light" : "dark"));
    // Paper is white.
    let screen;
    addEventListener("beforeprint", () => {
        screen = theme();
        setTheme("light");
    });
    addEventListener("afterprint", () => setTheme(screen));
}
