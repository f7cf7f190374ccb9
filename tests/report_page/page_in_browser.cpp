#include "tests/report_page/page_in_browser.h"

#include <nlohmann/json.hpp>

#include "benchmarks/report/page.h"
#include "tests/report_page/browser.h"
#include "tests/report_page/sample_reports.h"
#include "tests/required.h"

namespace report_page {

using benchmarks::scene::Json;

void PageInBrowser::SetUp() {
    if (!benchmarks::report::findPlotly())
        return skipWithout(Need::report, "no Plotly; scripts/setup --report installs it");
    if (!findBrowser())
        return skipWithout(Need::browser, "no Chromium; scripts/setup --browser installs it");
}

Json PageInBrowser::one(const std::string& steps, int width) {
    return open({writeWithPictures(knownReport(), folder_.file("a.json"), 200)}, steps, width);
}

Json PageInBrowser::two(const std::string& steps) {
    return open(
        {writeWithPictures(knownReport(), folder_.file("a.json"), 200),
         writeWithPictures(knownReport(1.5), folder_.file("b.json"), 100)},
        steps);
}

Json PageInBrowser::open(
    const std::vector<std::filesystem::path>& files, const std::string& steps, int width) {
    const Json said = inBrowser(pageOf(files), steps, width);
    EXPECT_EQ(said.value("errors", Json("no result")), Json::array()) << said.dump();
    return said;
}

}  // namespace report_page
