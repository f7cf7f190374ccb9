#include "benchmarks/viewer/timings/side_measurement.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/case.h"
#include "benchmarks/picture_errors.h"
#include "benchmarks/viewer/timings/changed_shaders.h"
#include "benchmarks/viewer/timings/own_memory.h"

namespace benchmarks {

SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name, const MeasureHooks& hooks) {
    SideMeasurement measured{.settings = settings, .result = {.name = name}, .picture = {}};
    CaseResult& result = measured.result;
    result.index = result.order = 0;
    OwnMemory memory(device.memory());
    const MeasureHooks own_hooks{
        .stop = hooks.stop, .progress = [&](const SamplingState& state) {
            if (hooks.progress) memory.others([&] { hooks.progress(state); });
            device.runOnce([](engine::Commands&) {});  // waits for all that was submitted
        }};
    Case test_case(device, settings, directory);
    measured.picture = measure(device, test_case, settings.run, own_hooks, result);
    std::erase_if(result.metrics, [](const Metric& metric) {
        const Measured what = metric.id.what;
        return what == Measured::allocated || what == Measured::heap || what == Measured::purpose;
    });
    std::ranges::move(memory.metrics(), std::back_inserter(result.metrics));
    if (!settings.run.reference.empty()) {
        ReferenceComparison references;
        references.add(
            directory / settings.run.reference, settings.render.width, settings.render.height,
            measured.picture, result);
    }
    warnOfChangedShaders(device, result.trust);
    result.trust.warnings.push_back(
        "measured in the viewer: pipelines and files were warm, and the window's pictures were "
        "drawn between rounds");
    return measured;
}

}  // namespace benchmarks
