#include "engine/instance.h"
#include "tests/report_page/sample_reports.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/pictures.h"

namespace benchmarks::report {
namespace {

constexpr int kSamples = 60;

// Spreads samples evenly over +-1 %, in an order without trend: golden-section steps (Weyl 1916).
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

CaseResult emptyCase(const Known& known) {
    CaseResult result;
    result.name = caseName(known);
    result.axes = {
        {"/strands/density", scene::Document(known.density)},
        {"/render/msaa", scene::Document(known.msaa)}};
    return result;
}

CaseResult measuredCase(const Known& known, double slower) {
    CaseResult result = emptyCase(known);
    const double ms = known.frame_ms * slower;
    result.metrics = {
        {ofFrame(Measured::rate), {1000.0 / ms}, Mode::overlapped},
        {ofFrame(Measured::time), around(ms), Mode::overlapped},
        {ofPass("simulate", Measured::time), around(0.2 * ms), Mode::isolated},
        {ofPass("strands", Measured::time), around(0.7 * ms), Mode::isolated},
        {ofPass("resolve", Measured::time), around(0.1 * ms), Mode::isolated},
        {ofImage(Measured::flip), {1.0 / known.density}},
        {ofMemory(Measured::allocated), {1048576.0 * known.density}}};
    if (known.density == 16 && known.msaa == 1) result.trust.warnings = {kWarning};
    result.image_hash = result.state_hash = "0123456789abcdef";
    return result;
}

Report emptyReport(const std::string& scene_name) {
    Report report;
    report.environment.device = {
        "Sample device", engine::DeviceType::discrete, "sample", "1.0", "1.3.0", 1.0};
    report.environment.build.type = "Release";
    report.environment.command = {"hairbench", "run", "scenes/" + scene_name + ".json"};
    report.scene = {
        "scenes/" + scene_name + ".json", "0123456789abcdef",
        scene::Document(scene::Json{{"description", "Known."}})};
    return report;
}

}  // namespace

Report knownReport(double slower) {
    Report report = emptyReport("known");
    for (const Known& known : kKnown) report.cases.push_back(measuredCase(known, slower));
    CaseResult skipped = emptyCase({32, 4, 0.0});
    skipped.status = Status::skipped;
    skipped.reason = kSkipReason;
    report.cases.push_back(skipped);
    return report;
}

Report backendReport() {
    Report report = emptyReport("backends");
    for (const int guides : {10, 100, 1000})
        for (const int msaa : {1, 4, 8})
            for (const bool software : {false, true}) {
                const char* const backend = software ? "software" : "tessellation";
                CaseResult result;
                result.name = "backends/guides:" + std::to_string(guides) +
                              "/msaa:" + std::to_string(msaa) + "/backend:" + backend;
                result.axes = {
                    {"/groom/guides", scene::Document(guides)},
                    {"/render/msaa", scene::Document(msaa)},
                    {"/strands/backend", scene::Document(backend)}};
                if (msaa == 8) {
                    result.status = Status::skipped;
                    result.reason = kSkipReason;
                    report.cases.push_back(result);
                    continue;
                }
                const KnownLaw& law = software ? kSoftwareLaw : kTessellationLaw;
                const double strands = 64.0 * guides;
                const double ms =
                    law.factor * std::pow(strands, law.exponent) * (msaa == 4 ? 2.0 : 1.0);
                result.counts = {{"strands", static_cast<std::uint64_t>(strands)}};
                result.metrics = {
                    {ofFrame(Measured::time), around(1.5 * ms), Mode::overlapped},
                    {ofPass("strands", Measured::time), around(ms), Mode::isolated},
                    {ofStrands(Measured::time), around(ms), Mode::isolated},
                    {ofStrands(Measured::time_per_point), around(1e6 * ms / strands / 29.0),
                     Mode::isolated},
                    {ofImage(Measured::flip_tessellation), {software ? 0.01 : 0.0}},
                    {ofImage(Measured::flip_many_samples), {software ? 0.02 : 0.03}}};
                report.cases.push_back(result);
            }
    return report;
}

Report oneCaseReport(const std::string& name, std::vector<scene::AxisValue> axes) {
    Report report = emptyReport("one");
    CaseResult result;
    result.name = name;
    result.axes = std::move(axes);
    result.metrics = {
        {ofFrame(Measured::time), around(1.0), Mode::overlapped},
        {ofPass("strands", Measured::time), around(0.5), Mode::isolated},
        {ofPass("strands", Measured::cpu_time), around(0.75), Mode::wall_clock}};
    report.cases.push_back(result);
    return report;
}

std::filesystem::path
writeWithPictures(Report report, const std::filesystem::path& file, unsigned char red) {
    const std::string folder = file.stem().string() + ".pictures";
    std::vector<unsigned char> pixels;
    for (int i = 0; i < 4 * 2; ++i) pixels.insert(pixels.end(), {red, 0, 128, 255});
    for (std::size_t i = 0; i < report.cases.size(); ++i) {
        if (report.cases[i].status != Status::ok) continue;
        report.cases[i].picture = folder + '/' + std::to_string(i) + ".png";
        engine::writePng(file.parent_path() / report.cases[i].picture, 4, 2, pixels);
    }
    writeReport(reportJson(report), file);
    return file;
}

}  // namespace benchmarks::report
