#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/exporters/exporters.h"
#include "benchmarks/report_file.h"
#include "engine/write_file.h"

namespace benchmarks {

int convertReport(const ConvertReportOptions& options) {
    const std::string text = exportReport(readReport(options.report), options.format);
    if (options.out.empty()) {
        std::cout << text;
        return kOk;
    }
    engine::writeFileAtomically(options.out, text);
    std::cout << options.out.string() << ": " << options.format << " of " << options.report.string()
              << '\n';
    return kOk;
}

}  // namespace benchmarks
