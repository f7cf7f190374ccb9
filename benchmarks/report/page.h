#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/scene/json.h"

// The page of `hairbench report`: one HTML file with its reports and what draws them. What it is
// made of lies in page/, and docs/report_page.md says how.
namespace benchmarks::report {

// ---- Parts --------------------------------------------------------------------------------------

// What a page is made of, besides its data.
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

// RFC 4648, section 4: with padding, no line breaks.
std::string base64(std::string_view bytes);

// A picture file as a URI that holds it: "data:image/png;base64,...". Nothing where there is no
// such file, or what is there is neither PNG nor JPEG.
std::optional<std::string> pictureUri(const std::filesystem::path& file);

// All that the page shows, as one object:
//   title
//   reports[]      each as it was read, with `label` ("A", "B", ...) and `file`; a case with a
//                  picture has `picture_id`, one whose picture is not there `picture_missing`
//   pass_times     name of a pass's time -> the pass
//   image_metrics  name of a picture's error -> true
//   pictures       `picture_id` -> data URI; equal files once
//   comparisons[]  of each report with the first of its scene, as `hairbench compare --json` says,
//                  and their places in reports[]: `with` the first and `report`
//   devices[]      of each report, as devicesJson() says
//   left_out[]     files that are of another kind: `file`, `reason`
// Throws engine::Error for a report that cannot be read, and where all are left out.
scene::Json pageData(std::span<const std::filesystem::path> reports);

// ---- Page ---------------------------------------------------------------------------------------

// JSON that ends no script element and begins no comment in one: "<" is written "\u003c", which is
// the same to JSON. What is no UTF-8 is replaced.
std::string scriptJson(const scene::Json& data);

// The whole page, with pageData() in its place. Throws engine::Error for a page without one of the
// places.
std::string assemblePage(const PageParts& parts, const scene::Json& data);

}  // namespace benchmarks::report
