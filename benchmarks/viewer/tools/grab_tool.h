#pragma once

#include <cstddef>
#include <optional>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/tools/handles.h"
#include "benchmarks/viewer/tools/picking.h"
#include "benchmarks/viewer/tools/options_line.h"
#include "benchmarks/viewer/tools/pointer.h"
#include "hair/settings.h"

namespace benchmarks {

// Pulls at hair with the mouse: an entry of /simulation/pulls, whose path is written while frames
// are played.
class GrabTool {
public:
    // `runs`: whether frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // How much hair is held, and a button that clears all pulls, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Player* player;  // whose picture
        GuideVertex held;
        glm::vec3 start;  // where the vertex was
        glm::vec2 from;   // px
        std::optional<std::size_t> pull;  // that it writes; none before the mouse moves
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Player& player);
    void draw(
        const Pointer& pointer, Handles& handles, const hair::Settings& settings,
        const Player& player) const;

    float radius_ = hair::PullSettings{}.radius;  // m, of the next pull
    std::optional<Drag> drag_;
};

}  // namespace benchmarks
