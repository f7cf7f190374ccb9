#include "benchmarks/mitsuba_shapes.h"

#include <algorithm>
#include <vector>

#include "benchmarks/curve_control_points.h"
#include "benchmarks/decimal_text.h"

namespace benchmarks {

void writeMitsubaCurves(std::ostream& out, const hair::StrandSet& strands) {
    std::vector<glm::dvec4> points;
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        if (strands.size(strand) < 2) continue;
        points.clear();
        for (std::uint32_t i = strands.first(strand); i < strands.ends[strand]; ++i)
            points.emplace_back(glm::dvec3(strands.points[i]), 0.5 * strands.widths.at(i));
        for (glm::dvec4 control : interpolatingControlPoints(points)) {
            control.w = std::max(control.w, 0.0);
            out << decimalTexts(control, " ") << '\n';
        }
        out << '\n';
    }
}

void writeMaterialPly(
    std::ostream& out, const hair::Mesh& mesh, std::uint32_t material,
    const hair::RigidMotion& pose) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);  // in the file
    std::vector<std::uint32_t> vertices;                                 // of the file
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangle_materials[i] != material) continue;
        auto& triangle = triangles.emplace_back(mesh.triangles[i]);
        for (std::uint32_t& corner : triangle) {
            std::uint32_t& number = numbers[corner];
            if (number == kUnused) {
                number = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(corner);
            }
            corner = number;
        }
    }
    out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size();
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "\nproperty float " << name;
    const bool has_coordinates = !mesh.texture_coordinates.empty();
    if (has_coordinates) out << "\nproperty float u\nproperty float v";
    out << "\nelement face " << triangles.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::uint32_t vertex : vertices) {
        const glm::dvec3 normal = pose.rotation * glm::dvec3(mesh.normals[vertex]);
        out << decimalTexts(pose(mesh.positions[vertex]), " ") << ' ' << decimalTexts(normal, " ");
        if (has_coordinates) out << ' ' << decimalTexts(mesh.texture_coordinates[vertex], " ");
        out << '\n';
    }
    for (const auto& [a, b, c] : triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
}

}  // namespace benchmarks
