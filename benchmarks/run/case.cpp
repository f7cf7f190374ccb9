#include "benchmarks/run/case.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/memory_need.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/extensions.h"
#include "engine/error.h"
#include "engine/process.h"
#include "engine/pictures.h"

namespace benchmarks::run {
namespace {

namespace fs = std::filesystem;

// ---- Picture of a case --------------------------------------------------------------------------

constexpr std::uint32_t kWidest = 480;  // px

// Averages squares of `factor` x `factor` pixels. Drops the remainder at the edges.
std::vector<std::uint8_t> shrunk(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    std::uint32_t factor) {
    std::vector<std::uint8_t> small;
    small.reserve(pixels.size() / factor / factor);
    for (std::uint32_t y = 0; y + factor <= height; y += factor)
        for (std::uint32_t x = 0; x + factor <= width; x += factor)
            for (std::uint32_t channel = 0; channel < 4; ++channel) {
                std::uint32_t sum = 0;
                for (std::uint32_t v = 0; v < factor; ++v)
                    for (std::uint32_t u = 0; u < factor; ++u)
                        sum += pixels[(std::size_t{y + v} * width + x + u) * 4 + channel];
                const std::uint32_t area = factor * factor;
                small.push_back(static_cast<std::uint8_t>((sum + area / 2) / area));
            }
    return small;
}

}  // namespace

std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index) {
    const std::uint32_t factor =
        std::min((width + kWidest - 1) / kWidest, std::max(height, std::uint32_t{1}));
    const std::filesystem::path file = std::filesystem::path(report.stem().string() + ".pictures") /
                                       (std::to_string(index) + ".png");
    engine::writePng(
        report.parent_path() / file, width / factor, height / factor,
        shrunk(pixels, width, height, factor));
    return file.generic_string();
}

namespace {

// ---- Pictures of older runs ---------------------------------------------------------------------

// "12.png", or the partial file of a run that was killed, "12.png.0123456789abcdef.partial". Other
// files belong to the user.
bool isCasePicture(const std::string& name) {
    const std::size_t digits = name.find_first_not_of("0123456789");
    return digits != 0 && digits != std::string::npos &&
           (name.substr(digits) == ".png" ||
            (name.substr(digits).starts_with(".png.") && name.ends_with(".partial")));
}

}  // namespace

void removeOtherPictures(const std::set<std::string>& pictures, const fs::path& report) {
    std::set<std::string> named;
    for (const std::string& each : pictures) named.insert(fs::path(each).filename().string());
    const fs::path folder = report.parent_path() / (report.stem().string() + ".pictures");
    std::error_code ignored;
    std::set<fs::path> stale;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (const std::string name = entry.path().filename().string();
            isCasePicture(name) && !named.contains(name))
            stale.insert(entry.path());
    for (const fs::path& file : stale) fs::remove(file, ignored);
    fs::remove(folder, ignored);  // if it is empty
}

namespace {

// ---- The case -----------------------------------------------------------------------------------

report::CaseResult emptyResult(const PlannedCase& planned) {
    return {.name = planned.spec.name, .index = planned.index, .axes = planned.spec.axes};
}

report::CaseResult without(const PlannedCase& planned, report::Status status, const char* reason) {
    report::CaseResult result = emptyResult(planned);
    result.status = status;
    result.reason = reason;
    return result;
}

// A failure to write the picture only adds a warning, because it does not affect the measurements.
void keepPicture(
    std::span<const std::uint8_t> pixels, const hair::RenderSettings& render,
    const std::filesystem::path& report, report::CaseResult& result) {
    try {
        result.picture =
            writeCasePicture(pixels, render.width, render.height, report, *result.index);
    } catch (const engine::Error& error) {
        result.trust.warnings.push_back(std::string("no picture: ") + error.what());
    }
}

}  // namespace

PlayedCase runCase(
    const engine::Device& device, const PlannedCase& planned, const measure::MeasureHooks& hooks,
    const std::filesystem::path& report, CaseComparisons& comparisons, measure::HairCache& cache,
    std::optional<std::uint64_t> max_memory) {
    const hair::RunSettings& run = planned.spec.settings.run;
    const hair::RenderSettings& render = planned.spec.settings.render;
    PlayedCase played{.result = emptyResult(planned)};
    report::CaseResult& result = played.result;
    std::optional<report::MemoryNeed> need;
    try {
        const engine::TimeLimit limit(double{run.case_timeout}, "/run/case_timeout");
        need = measure::memoryNeed(device, planned.spec.settings, planned.directory, &cache);
        if (const std::string reason =
                measure::whyItDoesNotFit(*need, measure::memoryRooms(device, max_memory));
            !reason.empty())
            throw engine::Unsupported(reason);
        measure::Case test_case(device, planned.spec.settings, planned.directory, &cache);
        result.trust.warnings = test_case.warnings();
        for (const scene::NamedExtension& each : scene::namedExtensions(test_case.settings()))
            result.extensions.push_back({each.pointer, each.file, report::sha256(each.text)});
        const measure::ClockHold clocks(device.info(), run.clocks);
        const auto picture = measure::measure(device, test_case, run, hooks, result);
        if (!run.reference.empty())
            comparisons.references.add(
                planned.directory / run.reference, render.width, render.height, picture, result);
        if (run.compare_backends)
            comparisons.backends.add(device, test_case, planned.spec.settings, picture, result);
        if (!report.empty()) keepPicture(picture, render, report, result);
    } catch (const engine::Unsupported& error) {
        result = without(planned, report::Status::skipped, error.what());
    } catch (const engine::DeviceLost& error) {
        result = without(planned, report::Status::failed, error.what());
        played.lost_device = true;
    } catch (const engine::Error& error) {
        result = without(planned, report::Status::failed, error.what());
    } catch (const engine::TimedOut& over) {
        result = without(planned, report::Status::failed, over.reason.c_str());
    } catch (const std::bad_alloc&) {
        result = without(planned, report::Status::failed, "the host has not enough memory");
    }
    result.memory_need = need;
    for (const std::string& message : device.messages().take())
        result.trust.warnings.push_back("validation: " + message);
    return played;
}

}  // namespace benchmarks::run
