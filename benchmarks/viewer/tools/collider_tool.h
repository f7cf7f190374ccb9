#pragma once

#include <cstddef>
#include <optional>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/tools/collider_handles.h"
#include "benchmarks/viewer/tools/handles.h"
#include "benchmarks/viewer/tools/options_line.h"
#include "benchmarks/viewer/tools/pointer.h"
#include "hair/settings.h"

namespace benchmarks {

// Moves the capsules of /simulation/colliders with the mouse.
class ColliderTool {
public:
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player);
    bool drags() const { return drag_.has_value(); }

    // Buttons that add one and take it away, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings, const Player& player);

private:
    struct Drag {
        const Player* player;  // whose picture
        ColliderHandle held;
        hair::Collider start;
        glm::vec2 from;  // px
    };
    std::optional<ColliderHandle>
    handleUnder(const Pointer& pointer, const hair::Settings& settings, const Player& player) const;
    void press(
        const Pointer& pointer, std::optional<ColliderHandle> hot, const hair::Settings& settings,
        const Player& player);

    std::optional<std::size_t> selected_;
    std::optional<Drag> drag_;
};

}  // namespace benchmarks
