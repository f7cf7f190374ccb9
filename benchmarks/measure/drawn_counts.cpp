#include "benchmarks/measure/drawn_counts.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "benchmarks/dropped_fragments.h"

namespace benchmarks {

namespace {

std::optional<std::uint64_t>
expectedOf(const std::optional<hair::ExpectedCounts>& expected, std::string_view name) {
    if (!expected) return std::nullopt;
    if (name == "tessellation_control_patches") return expected->tessellation_control_patches;
    if (name == "tessellation_evaluation_invocations")
        return expected->tessellation_evaluation_invocations;
    if (name == "geometry_invocations") return expected->geometry_invocations;
    if (name == "geometry_primitives") return expected->geometry_primitives;
    return std::nullopt;
}

}  // namespace

void addStatistics(const Play& play, CaseResult& result) {
    if (!play.device.hasPipelineStatistics()) return;
    engine::FrameLoop loop(play.device, engine::Timing::statistics);
    Play plain = play;
    plain.busy = nullptr;
    playFrame(loop, plain);
    addStatistics(loop.finish().front(), play.device, play.test_case, result);
}

void addStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, const Case& test_case,
    CaseResult& result) {
    const auto strands =
        std::ranges::find(frame.statistics, "strands", &engine::PassStatistics::name);
    if (strands == frame.statistics.end()) return;

    const std::optional<hair::ExpectedCounts> expected = test_case.expected();
    for (std::size_t i = 0; i < engine::kStatisticNames.size(); ++i) {
        Statistic statistic{
            .name = std::string(engine::kStatisticNames[i]),
            .measured = strands->counts[i],
            .expected = expectedOf(expected, engine::kStatisticNames[i]),
            .note = ""};
        const bool fragments = statistic.name == "fragment_invocations";
        if (fragments && device.fragmentCountsAreApproximate()) {
            statistic.note = "approximate: this driver counts too many";
        }
        if (statistic.expected && *statistic.expected != statistic.measured) {
            result.trust.warnings.push_back(
                statistic.name + ": measured " + std::to_string(statistic.measured) +
                ", expected " + std::to_string(*statistic.expected));
        }
        result.statistics.push_back(std::move(statistic));
    }
}

void addTransparency(const Case& test_case, CaseResult& result) {
    const hair::StrandBlend& blend = test_case.blend();
    if (blend.bytes() == 0) return;
    result.metrics.push_back(
        {ofMemory(Measured::transparency), {static_cast<double>(blend.bytes())}});
    const std::optional<hair::ListedFragments> listed = blend.listed();
    if (!listed) return;
    result.counts.emplace_back("fragment_list_capacity", listed->capacity);
    result.counts.emplace_back("fragments_wanted", listed->wanted);
    result.counts.emplace_back("fragments_dropped", listed->dropped());
    if (std::string text = droppedFragments(test_case); !text.empty())
        result.trust.warnings.push_back(std::move(text));
}

}  // namespace benchmarks
