#pragma once

#include <cstdint>
#include <optional>

namespace hair {

// The stages of the tessellation back end that can be left away, in the order in which strands go
// through them. The control stage goes with the evaluation.
enum class StrandStage { vertex, evaluation, geometry, raster, fragment };

// Which of them a picture's strands go through. All, but where it is measured what a stage costs:
// then there is less to see of the strands, or nothing.
struct StrandStages {
    // Absent: no strand is drawn. Before raster, primitives are discarded; raster alone has no
    // fragment shader and writes depth.
    std::optional<StrandStage> last = StrandStage::fragment;
    // Vertex, evaluation or geometry: all that it makes goes into something that can be seen, or
    // drivers would leave the work away that nothing comes of.
    std::optional<StrandStage> watched{};
    std::uint64_t watch = 0;  // StageWatch::address(), where a stage is watched

    bool operator==(const StrandStages&) const = default;
};

// Whether primitives end before they are rasterised.
inline bool discards(const StrandStages& stages) { return stages.last < StrandStage::raster; }

}  // namespace hair
