#pragma once

#include <filesystem>
#include <optional>
#include <string>

// What a page is made of, besides its data.
namespace benchmarks {

struct PageParts {
    std::string page;    // HTML with places: @title@, @style@, @data@, @plotly@, @script@
    std::string style;   // CSS
    std::string script;  // JavaScript, all modules one after the other
    std::string plotly;  // plotly.min.js
};

// plotly.min.js: the file that HAIRBENCH_PLOTLY names, or the one in the environment that
// scripts/setup --report makes; nothing where there is none.
std::optional<std::filesystem::path> findPlotly();

// Its text. Throws engine::Error, which says what to run, where there is none.
std::string readPlotly();

// The rest is read from the project's folder.
PageParts readPageParts(std::string plotly);

}  // namespace benchmarks
