#pragma once

#include <cstdint>

#include "benchmarks/viewer/play/side.h"
#include "benchmarks/viewer/timings/shown_side.h"
#include "hair/settings.h"

namespace benchmarks {

// What was shown of a side when the user froze it.
struct FrozenSide {
    ShownSide shown;
    hair::Settings settings;
    std::uint32_t frame = 0;  // that the hashes are of
};

// With what reading back from the device tells: hashes of the picture and the guides, unless the
// side shows no frame of its settings, and what blended fragments took.
FrozenSide frozenSide(const Side& side, ShownSide shown);

// What a report has of it: the metrics in their modes, `statistics` (countStatistics(), or
// nothing), and warnings that say how it was all measured.
CaseResult frozenResult(const FrozenSide& frozen, const CaseResult& statistics);

}  // namespace benchmarks
