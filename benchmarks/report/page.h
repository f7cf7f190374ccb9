#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/scene/json.h"

// Builds the page of `hairbench report`: one HTML file with the reports and the code that draws
// them. Its parts lie in page/; docs/results.md describes them.
namespace benchmarks::report {

// ---- Parts --------------------------------------------------------------------------------------

// The parts of a page except its data.
struct PageParts {
    std::string page;  // HTML with places: @title@, @style@, @data@, @plotly@, @script@
    std::string style;  // CSS
    std::string script;  // JavaScript, all of it one function's body
    std::string plotly;  // plotly.js, packed by gzip or not, in base64
};

// The file of plotly.js: the one that HAIRBENCH_PLOTLY names, else plotly.min.js.gz as it is
// installed with the program or as scripts/setup fetched it. The basic bundle is enough. Returns
// nothing where there is none.
std::optional<std::filesystem::path> findPlotly();

// The bytes of findPlotly(). Throws engine::Error, which says what to run, where there is none.
std::string readPlotly();

// The page, style and script from the project's folder, with `plotly`: the bytes of plotly.js,
// packed by gzip or not.
PageParts readPageParts(std::string_view plotly);

// ---- Data ---------------------------------------------------------------------------------------

// RFC 4648, section 4: with padding, without line breaks.
std::string base64(std::string_view bytes);

// Returns a picture file as a data URI: "data:image/png;base64,...". Returns nothing if the file is
// missing or is neither PNG nor JPEG.
std::optional<std::string> pictureUri(const std::filesystem::path& file);

// Returns all data of the page as one object:
//   title
//   reports[]      each report as read, with `label` ("A", "B", ...) and `file`; a case with a
//                  picture has `picture_id`, or `picture_missing` if the file is missing or lies
//                  outside the folders *.pictures beside the report. A case that ran has
//                  `verdict` (judgeCase): `level`, `text` for a cell, and `reasons`
//   pass_times     metric name of a pass's time -> the pass
//   image_metrics  metric name of a picture's error -> true
//   pictures       `picture_id` -> data URI; equal files once
//   comparisons[]  each report with the first of its scene, like `hairbench compare --json`, and
//                  their indices in reports[]: `with` for the first and `report`
//   devices[]      one per report, from devicesJson()
//   left_out[]     files of another kind: `file`, `reason`
// Throws engine::Error if a report cannot be read or no file is a report.
scene::Json pageData(std::span<const std::filesystem::path> reports);

// ---- Page ---------------------------------------------------------------------------------------

// Returns JSON that can stand in a script element: "<" is written "\u003c", which means the same in
// JSON, so that it cannot end the element or begin a comment. Replaces bytes that are not UTF-8.
std::string scriptJson(const scene::Json& data);

// Returns the whole page with the data from pageData(). Throws engine::Error if the HTML lacks one
// of the places.
std::string assemblePage(const PageParts& parts, const scene::Json& data);

}  // namespace benchmarks::report
