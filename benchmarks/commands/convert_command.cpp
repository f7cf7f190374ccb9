#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/exporters.h"
#include "benchmarks/report/report.h"
#include "engine/files.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {

int convertReport(const ConvertReportOptions& options) {
    const std::string text =
        report::exportReport(report::readReport(options.report), options.format);
    if (options.out.empty()) {
        std::cout << text;
        return report::kOk;
    }
    engine::writeFileAtomically(options.out, text);
    std::cout << engine::shownText(options.out.string()) << ": " << options.format << " of "
              << engine::shownText(options.report.string()) << '\n';
    return report::kOk;
}

}  // namespace benchmarks::commands
