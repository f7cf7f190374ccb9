#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/commands.h"

namespace hair {

// Dispatches `groups` workgroups. Where more are needed than fit in a row, shaders count them row
// by row (workgroupIndex() in simulation/guides.glsl), and the last row may have some too many.
inline void dispatchGroups(engine::Commands& commands, std::uint32_t groups) {
    constexpr std::uint32_t kMostInRow = 65535;  // what every device has
    const std::uint32_t columns = std::min(groups, kMostInRow);
    commands.dispatch(columns, (groups + columns - 1) / columns);
}

// With as many workgroups of `size` invocations as `invocations` need.
inline void
dispatchInvocations(engine::Commands& commands, std::uint32_t invocations, std::uint32_t size) {
    dispatchGroups(commands, (invocations + size - 1) / size);
}

}  // namespace hair
