#pragma once

#include <optional>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/tools/handles.h"
#include "benchmarks/viewer/tools/options_line.h"
#include "benchmarks/viewer/tools/pointer.h"
#include "hair/settings.h"

namespace benchmarks {

// The wind's arrow in the picture: dragging its tip turns and stretches it.
class WindTool {
public:
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player);
    bool drags() const { return drag_.has_value(); }

    // The wind as a number, in one line.
    static Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Player* player;  // whose picture
        glm::vec3 tip;         // where it was held
        glm::vec2 from;        // px
    };
    std::optional<Drag> drag_;
};

}  // namespace benchmarks
