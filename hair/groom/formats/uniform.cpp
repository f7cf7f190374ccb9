#include "hair/groom/formats/uniform.h"

#include "hair/groom/resample.h"

namespace hair {

std::vector<std::uint32_t> uniformEnds(std::uint32_t strands, std::uint32_t size) {
    std::vector<std::uint32_t> ends(strands);
    for (std::uint32_t i = 0; i < strands; ++i) ends[i] = (i + 1) * size;
    return ends;
}

std::optional<StrandSet> makeUniform(
    const StrandSet& strands, const NumberOfPoints& number, std::vector<std::string>& warnings) {
    const auto size = commonSize(strands);
    if (size && *size >= number.least && *size <= number.most) return {};
    const std::string before =
        size ? std::to_string(*size) + " points" : std::string("differing numbers of points");
    warnings.push_back(
        "the strands have " + before + " and are resampled to " + std::to_string(number.wanted) +
        " each");
    return resample(strands, number.wanted);
}

}  // namespace hair
