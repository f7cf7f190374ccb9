#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/scene/json.h"

// Compares reports of the same scene on several devices, drivers or builds.

namespace benchmarks::report {

// Ratios of frame times to those of the same cases in the scene's first report.
struct TimeRatio {
    std::size_t cases = 0;  // cases that both reports measured
    double mean = 0.0;  // geometric mean of the ratios of medians
    double least = 0.0;
    double greatest = 0.0;
};

struct OnDevice {
    std::size_t report = 0;  // index in the list of reports
    std::size_t first = 0;  // index of the first report of the same scene, which may be this one
    std::optional<TimeRatio> ratio;  // absent for the first report, and without common cases
    std::vector<std::string> differences;  // from the first report: "device: X and Y"
};

// Returns one entry per report, in their order. Two reports belong to the same scene if its name is
// equal. Two cases are the same if their values are equal on every axis of either sweep; if a sweep
// lacks an axis, its scene's value counts. Throws engine::Error for a damaged report or one without
// a scene.
std::vector<OnDevice> compareDevices(std::span<const scene::Json> reports);

// [{"report", "first", "ratio": {"cases", "mean", "least", "greatest"}, "differences"}]
scene::Json devicesJson(const std::vector<OnDevice>& devices);

// Builds the page of `hairbench report`: one HTML file with the reports and the code that draws
// them. Its parts lie in page/; docs/results.md describes them.

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
