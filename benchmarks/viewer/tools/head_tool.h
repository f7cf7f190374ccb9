#pragma once

#include <optional>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/tools/gizmo.h"
#include "benchmarks/viewer/tools/handles.h"
#include "benchmarks/viewer/tools/head_keys.h"
#include "benchmarks/viewer/tools/options_line.h"
#include "benchmarks/viewer/tools/pointer.h"
#include "hair/settings.h"

namespace benchmarks {

// Moves the head with a gizmo at its pivot: keyframes of /simulation/motion from now on.
class HeadTool {
public:
    // `runs`: whether frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // A button that clears the motion, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Player* player;  // whose picture
        GizmoPart part;
        Gizmo gizmo;     // as it was when it was held
        HeadPose start;
        HeadPose pose;   // as it is wanted
        glm::vec2 from;  // px
        glm::vec2 last;  // px
        float angle = 0.0f;  // rad so far; more than a turn is possible
        bool has_moved = false;
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Player& player);

    std::optional<Drag> drag_;
};

// The gizmo of a head in a pose: its rings turn about the axes that the angles of a keyframe have,
// so that each changes one of them. `size`, m.
Gizmo headGizmo(const glm::vec3& pivot, const HeadPose& pose, float size);

}  // namespace benchmarks
