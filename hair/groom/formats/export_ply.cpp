#include "hair/groom/formats/export_ply.h"

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/chain_edges.h"
#include "hair/groom/formats/comment_lines.h"
#include "hair/groom/formats/left_out.h"

namespace hair {
namespace {

constexpr std::size_t kBlock = 4096;  // vertices or edges that are written at once

std::string headerOf(const StrandSet& strands, std::size_t edge_count) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    header += commentLines(strands.comment, "comment ");
    header += "element vertex " + std::to_string(strands.points.size()) + '\n';
    const auto addProperties = [&](std::initializer_list<const char*> names) {
        for (const char* name : names) header.append("property float ").append(name).append("\n");
    };
    addProperties({"x", "y", "z"});
    if (strands.widths.known()) addProperties({"width"});
    if (strands.transparencies.known()) addProperties({"transparency"});
    if (strands.colors.known()) addProperties({"red", "green", "blue"});
    return header + "element edge " + std::to_string(edge_count) +
           "\nproperty uint vertex1\nproperty uint vertex2\nend_header\n";
}

void writeVertices(const StrandSet& strands, std::ostream& out) {
    std::vector<float> values;
    for (std::size_t i = 0; i < strands.points.size(); ++i) {
        const glm::vec3& point = strands.points[i];
        values.insert(values.end(), {point.x, point.y, point.z});
        if (strands.widths.known()) values.push_back(strands.widths.at(i));
        if (strands.transparencies.known()) values.push_back(strands.transparencies.at(i));
        if (strands.colors.known()) {
            const glm::vec3& color = strands.colors.at(i);
            values.insert(values.end(), {color.r, color.g, color.b});
        }
        if (i % kBlock != kBlock - 1 && i + 1 != strands.points.size()) continue;
        writeArray(out, values);
        values.clear();
    }
}

}  // namespace

std::vector<std::string> exportPly(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::comment});
    const std::vector<Edge> edges = edgesOf(strands, warnings);
    const std::string header = headerOf(strands, edges.size());
    out.write(header.data(), static_cast<std::streamsize>(header.size()));
    writeVertices(strands, out);
    writeArray(out, edges);
    return warnings;
}

}  // namespace hair
