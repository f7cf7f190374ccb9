#include "hair/groom/formats/export_tfx.h"

#include <algorithm>
#include <bit>
#include <limits>

#include <glm/vec4.hpp>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/left_out.h"
#include "hair/groom/formats/tfx_header.h"
#include "hair/groom/formats/uniform.h"

namespace hair {
namespace {

// What AMD's loader takes, and powers of two only.
constexpr std::uint32_t kLeastVertices = 4;
constexpr std::uint32_t kMostVertices = 64;
constexpr std::uint32_t kFixedVertices = 2;

std::vector<glm::vec4> positionsOf(const StrandSet& strands, std::uint32_t vertices) {
    std::vector<glm::vec4> positions;
    positions.reserve(strands.points.size());
    for (const glm::vec3& point : strands.points) {
        const bool fixed = positions.size() % vertices < kFixedVertices;
        positions.emplace_back(point, fixed ? 0.0f : 1.0f);
    }
    return positions;
}

std::vector<float>
widthsOf(const StrandSet& strands, std::uint32_t vertices, std::vector<std::string>& warnings) {
    if (!strands.widths.known()) return {};
    std::vector<float> widths;
    widths.reserve(strands.strandCount());
    std::size_t varying = 0;
    for (std::size_t i = 0; i < strands.points.size(); i += vertices) {
        widths.push_back(strands.widths.at(i));
        for (std::size_t k = i; k < i + vertices; ++k) {
            if (strands.widths.at(k) == widths.back()) continue;
            ++varying;
            break;
        }
    }
    if (varying > 0) {
        warnings.push_back(
            "the width varies along " + std::to_string(varying) +
            " strands, which get that of their root");
    }
    return widths;
}

// Absent where nothing is known and everything opaque.
std::vector<glm::vec4> colorsOf(const StrandSet& strands, std::vector<std::string>& warnings) {
    const bool opaque = strands.transparencies.values.empty() &&
                        strands.transparencies.everywhere.value_or(0.0f) == 0.0f;
    if (!strands.colors.known() && opaque) return {};
    if (!strands.colors.known())
        warnings.emplace_back("the colours are not known: white is written beside the alphas");
    std::vector<glm::vec4> colors;
    colors.reserve(strands.points.size());
    std::size_t rounded = 0;
    for (std::size_t i = 0; i < strands.points.size(); ++i) {
        const float transparency = opaque ? 0.0f : strands.transparencies.at(i);
        const float alpha = 1.0f - transparency;
        if (1.0f - alpha != transparency) ++rounded;
        colors.emplace_back(strands.colors.known() ? strands.colors.at(i) : glm::vec3(1.0f), alpha);
    }
    if (rounded > 0) {
        warnings.push_back(
            std::to_string(rounded) +
            " transparencies are rounded: the format holds alpha, 1 less the transparency");
    }
    return colors;
}

// The place of an array of `bytes` at the end of the file; 0 where it is empty.
std::uint32_t place(std::uint64_t& end, std::uint64_t bytes) {
    if (bytes == 0) return 0;
    const std::uint64_t start = (end + 7) / 8 * 8;
    end = start + bytes;
    if (start > std::numeric_limits<std::uint32_t>::max())
        throw engine::Error("more bytes than .tfx can count: the offset of an array has 32 bits");
    return static_cast<std::uint32_t>(start);
}

template <class Element>
void writeAt(
    std::ostream& out, std::uint64_t& position, std::uint32_t start,
    const std::vector<Element>& elements) {
    if (elements.empty()) return;
    writeArray(out, std::vector<char>(start - position));
    writeArray(out, elements);
    position = start + elements.size() * sizeof(Element);
}

}  // namespace

std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    auto warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::root_uvs});
    const auto resampled = makeUniform(
        strands,
        {.least = 2,
         .most = std::numeric_limits<std::uint32_t>::max(),
         .wanted = std::clamp(
             std::bit_ceil(std::min(greatestSize(strands), kMostVertices)), kLeastVertices,
             kMostVertices)},
        warnings);
    const StrandSet& uniform = resampled ? *resampled : strands;
    const std::uint32_t vertices = uniform.ends.front();
    if (!std::has_single_bit(vertices) || vertices < kLeastVertices || vertices > kMostVertices) {
        warnings.push_back(
            std::to_string(vertices) +
            " vertices per strand: TressFX itself takes 4, 8, 16, 32 or 64");
    }
    const auto positions = positionsOf(uniform, vertices);
    const auto widths = widthsOf(uniform, vertices, warnings);
    const auto colors = colorsOf(uniform, warnings);

    std::uint64_t end = sizeof(TfxHeader);
    const TfxHeader header{
        .strands = uniform.strandCount(),
        .vertices_per_strand = vertices,
        .positions = place(end, positions.size() * sizeof(glm::vec4)),
        .strand_uvs = place(end, uniform.root_uvs.size() * sizeof(glm::vec2)),
        .strand_thickness = place(end, widths.size() * sizeof(float)),
        .vertex_colors = place(end, colors.size() * sizeof(glm::vec4))};
    writeValue(out, header);
    std::uint64_t position = sizeof(TfxHeader);
    writeAt(out, position, header.positions, positions);
    writeAt(out, position, header.strand_uvs, uniform.root_uvs);
    writeAt(out, position, header.strand_thickness, widths);
    writeAt(out, position, header.vertex_colors, colors);
    return warnings;
}

}  // namespace hair
