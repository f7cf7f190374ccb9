#include "tests/report_page/page_in_browser.h"

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/report/page.h"
#include "engine/files.h"
#include "engine/run_tool.h"
#include "tests/report_page/sample_reports.h"
#include "tests/required.h"

namespace benchmarks::report {
namespace {

using scene::Json;

bool isThere(const std::string& program) {
    try {
        engine::runTool({program, "--version"});
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

std::optional<std::string> lookForBrowser() {
    if (const char* wanted = std::getenv("HAIRBENCH_BROWSER"); wanted && *wanted) return wanted;
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (isThere(name)) return name;
    return std::nullopt;
}

// Returns Chromium's program, looked up only once.
const std::optional<std::string>& findBrowser() {
    static const std::optional<std::string> found = lookForBrowser();
    return found;
}

std::string toolText(const std::string& file) {
    return engine::readFile(HAIRBENCH_SOURCE_DIR "/tests/report_page/" + file);
}

// Returns the page, watched from its head on, with the steps at the end.
std::string watched(std::string page, const std::string& steps) {
    const std::string head = "<head>\n";
    page.insert(page.find(head) + head.size(), "<script>" + toolText("watch.js") + "</script>\n");
    // The result contains no character that HTML escapes.
    return page + "<script>(async () => {\n" + toolText("steps.js") + "try {\n" + steps + R"(
} catch (error) {
    complaints.push(`steps: ${error.stack}`);
}
said.errors = complaints.concat(performance.getEntriesByType("resource")
    .map((each) => each.name).filter((name) => !/^(data|blob):/.test(name)));
const result = document.createElement("pre");
result.id = "test-result";
result.textContent = JSON.stringify(said).replace(/[<>&\u00a0]/g, (each) =>
    "\\u" + each.charCodeAt(0).toString(16).padStart(4, "0"));
document.body.append(result);
})();</script>)";
}

// Returns the values from the steps, and the complaints as `errors`.
Json inBrowser(const std::string& page, const std::string& steps, int width) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "page.html";
    std::ofstream(file) << watched(page, steps);
    // Virtual time passes as fast as the page works, however busy the machine is.
    const std::vector<std::byte> bytes = engine::runTool(
        {"timeout", "300", *findBrowser(), "--headless=new", "--no-sandbox", "--disable-gpu",
         "--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND",
         "--user-data-dir=" + (folder.path() / "profile").string(),
         "--window-size=" + std::to_string(width) + ",900", "--virtual-time-budget=15000",
         "--dump-dom", "file://" + file.string()});
    const std::string_view dom(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view mark = "<pre id=\"test-result\">";
    const std::size_t begin = dom.rfind(mark);
    if (begin == std::string_view::npos) {
        ADD_FAILURE() << "the page never came to the end of the steps";
        return Json::object();
    }
    const std::string_view result = dom.substr(begin + mark.size());
    return Json::parse(result.substr(0, result.find("</pre>")));
}

}  // namespace

void PageInBrowser::SetUp() {
    if (!findPlotly()) return skipWithout(Need::report, "no Plotly; scripts/setup fetches it");
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
    const std::vector<std::filesystem::path>& reports, const std::string& steps, int width) {
    const std::string page = assemblePage(readPageParts(readPlotly()), pageData(reports));
    const Json said = inBrowser(page, steps, width);
    EXPECT_EQ(said.value("errors", Json("no result")), Json::array()) << said.dump();
    return said;
}

}  // namespace benchmarks::report
