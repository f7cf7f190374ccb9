#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/report/exporters.h"
#include "tests/benchmarks/sample_report.h"

namespace benchmarks::report {

// Returns the made-up report as read back from its file.
inline scene::Json writtenReport() { return scene::Json::parse(writtenText(sampleReport())); }

inline std::string exported(std::string_view format) {
    return exportReport(writtenReport(), format);
}

inline scene::Json exportedJson(std::string_view format) {
    return scene::Json::parse(exported(format));
}

}  // namespace benchmarks::report
