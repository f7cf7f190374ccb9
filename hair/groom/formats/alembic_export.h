#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Strands as an Alembic archive (Ogawa): linear curves, "/hair/strands". importAlembic() reads
// them back equal to the last bit, except for transparencies, which have no place in it. Roots,
// groups, guides and colours are parameters with the names of Epic's "Using Alembic for Grooms"
// (version 1.5). The unit, the upward axis, root triangles and the comment are properties that
// only hairbench knows. Alembic has neither unit nor upward axis: points are written as they are.
namespace hair::groom {

// Equal strands make equal bytes: no date is written. Returns a warning for all data that is left
// out. Throws engine::Error if there are no strands, or one has 2^31 points.
std::vector<std::string> exportAlembic(const StrandSet& strands, std::ostream& out);
std::vector<std::string>
exportAlembicWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out);

using AlembicBounds = std::array<glm::dvec3, 2>;  // least, greatest corner

// The frames of a file, without their points.
struct AlembicMotion {
    double frame_time = 0.0;  // s
    std::vector<AlembicBounds> bounds;  // [frame]
    std::string keys;  // 16 bytes of a hash for each frame
};

// Writes moving strands a frame at a time, without keeping them: one sample per frame, the first at
// 0 s. No data is sought in the stream, so that a pipe will do.
class AlembicAnimation {
public:
    // Every frame has the data of `strands`, except for the points. Throws as exportAlembic() does,
    // and for a frame time of 0.
    AlembicAnimation(std::ostream& out, const StrandSet& strands, const FrameTiming& timing);

    // Writes the points of the next frame, as many as the strands have.
    void frame(std::span<const glm::vec3> points);
    // Ends the file, after the last frame.
    void finish();

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    std::uint64_t end() const;  // byte behind the points of all frames

    std::ostream* out_;
    StrandSet strands_;
    FrameTiming timing_;
    AlembicMotion motion_;
    std::uint64_t root_ = 0;
    std::vector<std::string> warnings_;
};

}  // namespace hair::groom
