#pragma once

#include <filesystem>
#include <span>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// All that the page shows, as one object:
//   title
//   reports[]      each as it was read, with `label` ("A", "B", ...) and `file`; a case with a
//                  picture has `picture_id`, one whose picture is not there `picture_missing`
//   pass_times     name of a pass's time -> the pass
//   image_metrics  name of a picture's error -> true
//   pictures       `picture_id` -> data URI; equal files once
//   comparisons[]  of the first report with each of the others, as `hairbench compare --json` says
// Throws engine::Error for a report that cannot be read.
Json pageData(std::span<const std::filesystem::path> reports);

}  // namespace benchmarks
