#include "tests/report_page/sample_reports.h"

#include <cmath>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/pictures.h"

namespace report_page {

namespace {

constexpr int kSamples = 60;

// Evenly spread over +-1 % in an order without trend: golden-section steps (Weyl 1916).
std::vector<double> around(double median) {
    std::vector<double> samples;
    for (int i = 0; i < kSamples; ++i) {
        double whole;
        samples.push_back(median * (0.99 + 0.02 * std::modf(i * 0.6180339887 + 0.5, &whole)));
    }
    return samples;
}

std::string caseName(const Known& known) {
    return "known/density:" + std::to_string(known.density) + "/msaa:" + std::to_string(known.msaa);
}

benchmarks::report::CaseResult emptyCase(const Known& known) {
    benchmarks::report::CaseResult result;
    result.name = caseName(known);
    result.axes = {
        {"/strands/density", benchmarks::scene::Document(known.density)},
        {"/render/msaa", benchmarks::scene::Document(known.msaa)}};
    return result;
}

benchmarks::report::CaseResult measuredCase(const Known& known, double slower) {
    benchmarks::report::CaseResult result = emptyCase(known);
    const double ms = known.frame_ms * slower;
    result.metrics = {
        {benchmarks::report::ofFrame(benchmarks::report::Measured::rate),
         {1000.0 / ms},
         benchmarks::report::Mode::overlapped},
        {benchmarks::report::ofFrame(benchmarks::report::Measured::time), around(ms),
         benchmarks::report::Mode::overlapped},
        {benchmarks::report::ofPass("simulate", benchmarks::report::Measured::time),
         around(0.2 * ms), benchmarks::report::Mode::isolated},
        {benchmarks::report::ofPass("strands", benchmarks::report::Measured::time),
         around(0.7 * ms), benchmarks::report::Mode::isolated},
        {benchmarks::report::ofPass("resolve", benchmarks::report::Measured::time),
         around(0.1 * ms), benchmarks::report::Mode::isolated},
        {benchmarks::report::ofImage(benchmarks::report::Measured::flip), {1.0 / known.density}},
        {benchmarks::report::ofMemory(benchmarks::report::Measured::allocated),
         {1048576.0 * known.density}}};
    if (known.density == 16 && known.msaa == 1) result.trust.warnings = {kWarning};
    result.image_hash = result.state_hash = "0123456789abcdef";
    return result;
}

benchmarks::report::Report emptyReport(const std::string& scene) {
    benchmarks::report::Report report;
    report.environment.device = {"Sample device", "discrete", "sample", "1.0", "1.3.0", 1.0};
    report.environment.command = {"hairbench", "run", "scenes/" + scene + ".json"};
    report.scene = {
        "scenes/" + scene + ".json", "0123456789abcdef",
        benchmarks::scene::Document(benchmarks::scene::Json{{"description", "Known."}})};
    return report;
}

}  // namespace

benchmarks::report::Report knownReport(double slower) {
    benchmarks::report::Report report = emptyReport("known");
    for (const Known& known : kKnown) report.cases.push_back(measuredCase(known, slower));
    benchmarks::report::CaseResult skipped = emptyCase({32, 4, 0.0});
    skipped.status = benchmarks::report::Status::skipped;
    skipped.reason = kSkipReason;
    report.cases.push_back(skipped);
    return report;
}

benchmarks::report::Report
oneCaseReport(const std::string& name, std::vector<benchmarks::scene::AxisValue> axes) {
    benchmarks::report::Report report = emptyReport("one");
    benchmarks::report::CaseResult result;
    result.name = name;
    result.axes = std::move(axes);
    result.metrics = {
        {benchmarks::report::ofFrame(benchmarks::report::Measured::time), around(1.0),
         benchmarks::report::Mode::overlapped},
        {benchmarks::report::ofPass("strands", benchmarks::report::Measured::time), around(0.5),
         benchmarks::report::Mode::isolated},
        {benchmarks::report::ofPass("strands", benchmarks::report::Measured::cpu_time),
         around(0.75), benchmarks::report::Mode::wall_clock}};
    report.cases.push_back(result);
    return report;
}

std::filesystem::path writeWithPictures(
    benchmarks::report::Report report, const std::filesystem::path& file, unsigned char red) {
    const std::string folder = file.stem().string() + ".pictures";
    std::vector<unsigned char> pixels;
    for (int i = 0; i < 4 * 2; ++i) pixels.insert(pixels.end(), {red, 0, 128, 255});
    for (std::size_t i = 0; i < report.cases.size(); ++i) {
        if (report.cases[i].status != benchmarks::report::Status::ok) continue;
        report.cases[i].picture = folder + '/' + std::to_string(i) + ".png";
        engine::writePng(file.parent_path() / report.cases[i].picture, 4, 2, pixels);
    }
    std::ofstream(file) << benchmarks::report::reportText(report);
    return file;
}

}  // namespace report_page
