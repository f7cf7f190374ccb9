#include "benchmarks/report_page/page_parts.h"

#include <cstdlib>
#include <span>
#include <utility>

#include "engine/error.h"
#include "engine/read_file.h"

namespace benchmarks {

namespace {

constexpr const char* kStyles[] = {"theme.css",  "page.css",     "controls.css",
                                   "tables.css", "pictures.css", "print.css"};

// What a module uses when it is read stands before it.
constexpr const char* kScripts[] = {"dom.js",           "format.js",
                                    "data.js",          "theme.js",
                                    "plot.js",          "filter.js",
                                    "summary.js",       "scaling.js",
                                    "scaling_lines.js", "scaling_controls.js",
                                    "passes.js",        "distributions.js",
                                    "samples_plot.js",  "quality.js",
                                    "table.js",         "changes.js",
                                    "comparison.js",    "picture_views.js",
                                    "pictures.js",      "cases.js",
                                    "environment.js",   "main.js"};

std::filesystem::path folder() { return HAIRBENCH_SOURCE_DIR "/benchmarks/report_page"; }

std::string joined(const char* subfolder, std::span<const char* const> names) {
    std::string text;
    for (const char* name : names) text += engine::readFile(folder() / subfolder / name) + '\n';
    return text;
}

// lib/python3.N/site-packages, whichever N.
std::optional<std::filesystem::path> inEnvironment(const std::filesystem::path& environment) {
    std::error_code error;
    for (const auto& each : std::filesystem::directory_iterator(environment / "lib", error)) {
        const std::filesystem::path file =
            each.path() / "site-packages/plotly/package_data/plotly.min.js";
        if (std::filesystem::is_regular_file(file, error)) return file;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::filesystem::path> findPlotly() {
    const char* wanted = std::getenv("HAIRBENCH_PLOTLY");
    if (!wanted || !*wanted) return inEnvironment(HAIRBENCH_SOURCE_DIR "/.deps/report");
    std::error_code error;
    if (!std::filesystem::is_regular_file(wanted, error)) return std::nullopt;
    return wanted;
}

std::string readPlotly() {
    const auto file = findPlotly();
    if (!file)
        throw engine::Error("report", "this needs plotly.min.js: run scripts/setup --report");
    return engine::readFile(*file);
}

PageParts readPageParts(std::string plotly) {
    return {
        .page = engine::readFile(folder() / "page.html"),
        .style = joined("style", kStyles),
        .script = joined("script", kScripts),
        .plotly = std::move(plotly)};
}

}  // namespace benchmarks
