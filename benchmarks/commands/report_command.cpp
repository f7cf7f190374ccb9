#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/page.h"
#include "benchmarks/report/verdict.h"
#include "engine/files.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {

int writeReportPage(const ReportPageOptions& options) {
    const report::PageParts parts = report::readPageParts(report::readPlotly());
    const scene::Json data = report::pageData(options.reports);
    engine::writeFileAtomically(options.out, report::assemblePage(parts, data));
    for (const scene::Json& each : data.at("left_out"))
        std::cerr << "hairbench: left out " << engine::shownText(each.at("file").get<std::string>())
                  << ": is not a report of 'hairbench run': "
                  << engine::shownText(each.at("reason").get<std::string>()) << '\n';
    std::size_t missing = 0;
    for (const scene::Json& report : data.at("reports"))
        for (const scene::Json& each : report.at("cases"))
            missing += each.contains("picture_missing");
    if (missing > 0)
        std::cerr << "hairbench: " << missing
                  << (missing == 1 ? " picture of a case is missing\n"
                                   : " pictures of cases are missing\n");
    std::cout << "page: " << engine::shownText(options.out.string()) << '\n';
    const scene::Json& reports = data.at("reports");
    for (const scene::Json& each : reports)
        if (const std::string summary = report::verdictsOf(each).summary(); !summary.empty()) {
            const std::string file = each.at("file").get<std::string>() + ": ";
            std::cerr << "hairbench: "
                      << engine::shownText((reports.size() > 1 ? file : "") + summary) << '\n';
        }
    return report::kOk;
}

}  // namespace benchmarks::commands
