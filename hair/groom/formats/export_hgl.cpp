#include "hair/groom/formats/export_hgl.h"

#include <algorithm>
#include <limits>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/left_out.h"
#include "hair/groom/formats/uniform.h"

namespace hair {
namespace {

std::int32_t checkedCount(std::size_t count, const std::string& what) {
    if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw engine::Error(std::to_string(count) + ' ' + what + " are more than .hgl can count");
    return static_cast<std::int32_t>(count);
}

}  // namespace

std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    auto warnings = leftOut(strands, {Part::root_triangles, Part::unit});
    if (strands.metres_per_unit.value_or(1.0) != 1.0) {
        warnings.push_back(
            ".hgl is in metres, and the lengths are written as they are, in units of " +
            std::to_string(*strands.metres_per_unit) + " m");
    }
    const auto resampled = makeUniform(
        strands, {.least = 2, .most = 256, .wanted = std::clamp(greatestSize(strands), 2u, 256u)},
        warnings);
    const StrandSet& uniform = resampled ? *resampled : strands;
    writeValue(out, checkedCount(uniform.strandCount(), "strands"));
    writeValue(out, static_cast<std::int32_t>(uniform.ends.front() - 1));
    writeValue(out, checkedCount(uniform.root_triangles.size(), "root triangles"));
    writeArray(out, uniform.points);
    writeArray(out, uniform.root_triangles);
    return warnings;
}

}  // namespace hair
