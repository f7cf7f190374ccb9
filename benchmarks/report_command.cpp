#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/report_page/assemble_page.h"
#include "benchmarks/report_page/page_data.h"
#include "benchmarks/report_page/page_parts.h"
#include "engine/write_file.h"

namespace benchmarks {

int writeReportPage(const ReportPageOptions& options) {
    const PageParts parts = readPageParts(readPlotly());
    const Json data = pageData(options.reports);
    engine::writeFileAtomically(options.out, assemblePage(parts, data));
    std::size_t missing = 0;
    for (const Json& report : data.at("reports"))
        for (const Json& each : report.at("cases")) missing += each.contains("picture_missing");
    if (missing > 0)
        std::cerr << "hairbench: pictures of cases that are not there: " << missing << '\n';
    std::cout << "page: " << options.out.string() << '\n';
    return kOk;
}

}  // namespace benchmarks
