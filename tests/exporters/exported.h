#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "tests/benchmarks/sample_report.h"

namespace benchmarks {

// The made-up report as it is read back from its file.
inline Json writtenReport() { return Json::parse(reportText(sampleReport())); }

inline std::string exported(std::string_view format) {
    return exportReport(writtenReport(), format);
}

inline Json exportedJson(std::string_view format) { return Json::parse(exported(format)); }

}  // namespace benchmarks
