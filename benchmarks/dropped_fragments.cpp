#include "benchmarks/dropped_fragments.h"

namespace benchmarks {

std::string droppedFragments(const Case& test_case) {
    const std::optional<hair::ListedFragments> listed = test_case.blend().listed();
    if (!listed || listed->dropped() == 0) return {};
    return std::to_string(listed->dropped()) + " of " + std::to_string(listed->wanted) +
           " fragments did not fit /render/list_length: the picture lacks them";
}

}  // namespace benchmarks
