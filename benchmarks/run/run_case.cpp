#include "benchmarks/run/run_case.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "benchmarks/case.h"
#include "benchmarks/run/case_picture.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

CaseResult emptyResult(const PlannedCase& planned) {
    return {.name = planned.spec.name, .index = planned.index, .axes = planned.spec.axes};
}

CaseResult without(const PlannedCase& planned, Status status, const char* reason) {
    CaseResult result = emptyResult(planned);
    result.status = status;
    result.reason = reason;
    return result;
}

// What was measured is no worse without it.
void keepPicture(
    std::span<const std::uint8_t> pixels, const hair::RenderSettings& render,
    const std::filesystem::path& report, CaseResult& result) {
    try {
        result.picture =
            writeCasePicture(pixels, render.width, render.height, report, *result.index);
    } catch (const engine::Error& error) {
        result.trust.warnings.push_back(std::string("no picture: ") + error.what());
    }
}

}  // namespace

CaseResult runCase(
    const engine::Device& device, const PlannedCase& planned, const MeasureHooks& hooks,
    const std::filesystem::path& report, ReferenceComparison& references) {
    const hair::RunSettings& run = planned.spec.settings.run;
    const hair::RenderSettings& render = planned.spec.settings.render;
    CaseResult result = emptyResult(planned);
    try {
        Case test_case(device, planned.spec.settings, planned.directory);
        const auto picture = measure(device, test_case, run, hooks, result);
        if (!run.reference.empty())
            references.add(
                planned.directory / run.reference, render.width, render.height, picture, result);
        if (!report.empty()) keepPicture(picture, render, report, result);
    } catch (const engine::Unsupported& error) {
        result = without(planned, Status::skipped, error.what());
    } catch (const engine::Error& error) {
        result = without(planned, Status::failed, error.what());
    }
    for (const std::string& message : device.messages().take())
        result.trust.warnings.push_back("validation: " + message);
    return result;
}

}  // namespace benchmarks
