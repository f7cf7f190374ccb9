#include "benchmarks/viewer/timings/frozen_side.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "benchmarks/measure/drawn_counts.h"
#include "benchmarks/quantity_text.h"

namespace benchmarks {

FrozenSide frozenSide(const Side& side, ShownSide shown) {
    const Player& player = side.player();
    addTransparency(player.played(), shown.metrics);
    if (!player.previews()) {
        shown.metrics.image_hash = player.played().pictureHash();
        shown.metrics.state_hash = player.played().stateHash();
    }
    return {.shown = std::move(shown), .settings = player.settings(), .frame = player.frame()};
}

CaseResult frozenResult(const FrozenSide& frozen, const CaseResult& statistics) {
    CaseResult result = frozen.shown.metrics;
    result.statistics = statistics.statistics;
    std::vector<std::string>& warnings = result.trust.warnings;
    std::ranges::copy(statistics.trust.warnings, std::back_inserter(warnings));
    std::string frames = countText(frozen.shown.isolated, "isolated frame") + " and " +
                         countText(frozen.shown.overlapped, "overlapped frame");
    if (const auto& range = frozen.shown.range)
        frames +=
            " between " + std::to_string(range->first) + " and " + std::to_string(range->second);
    warnings.push_back(
        "taken in the viewer: " + frames +
        ", one at a time and with the window's pictures between them, in no rounds; their "
        "timestamps were not held against the CPU's clock");
    if (!result.image_hash.empty())
        warnings.push_back("the hashes are of frame " + std::to_string(frozen.frame));
    return result;
}

}  // namespace benchmarks
