#include "hair/groom/inspect.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/groom/inspect/count_duplicates.h"
#include "hair/groom/inspect/guess_unit.h"
#include "hair/groom/inspect/inspect_on_mesh.h"
#include "hair/groom/inspect/spread_of.h"

namespace hair {
namespace {

void inspectSizes(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> sizes;
    sizes.reserve(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        sizes.push_back(static_cast<float>(strands.size(i)));
        if (strands.size(i) == 1) ++findings.single_point_strands;
    }
    findings.points_per_strand = spreadOf(sizes);
}

void inspectLengths(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> lengths;
    std::vector<float> segments;
    lengths.reserve(strands.strandCount());
    segments.reserve(strands.points.size() - strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        const auto points = strands.strand(i);
        double length = 0.0;
        for (std::size_t k = 1; k < points.size(); ++k) {
            const double segment = glm::distance(glm::dvec3(points[k - 1]), glm::dvec3(points[k]));
            if (segment == 0.0) ++findings.zero_length_segments;
            segments.push_back(static_cast<float>(segment));
            length += segment;
        }
        if (points.size() > 1 && length == 0.0) ++findings.zero_length_strands;
        lengths.push_back(static_cast<float>(length));
    }
    findings.lengths = spreadOf(lengths);
    findings.segment_lengths = spreadOf(segments);
}

void inspectBox(const StrandSet& strands, StrandFindings& findings) {
    if (strands.points.empty()) return;
    findings.minimum = findings.maximum = strands.points.front();
    for (const glm::vec3& point : strands.points) {
        findings.minimum = glm::min(findings.minimum, point);
        findings.maximum = glm::max(findings.maximum, point);
    }
}

void inspectWidths(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> widths = strands.widths.values;
    if (widths.empty() && strands.widths.everywhere) widths = {*strands.widths.everywhere};
    findings.widths = spreadOf(widths);
}

// The greatest side of the roots' bounding box.
double rootExtent(const StrandSet& strands) {
    if (strands.ends.empty()) return 0.0;
    glm::vec3 low = strands.points.front();
    glm::vec3 high = low;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        low = glm::min(low, strands.points[strands.first(i)]);
        high = glm::max(high, strands.points[strands.first(i)]);
    }
    const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
    return std::max({size.x, size.y, size.z});
}

}  // namespace

StrandFindings
inspect(const StrandSet& strands, const Mesh* mesh, std::optional<double> metres_per_unit) {
    StrandFindings findings{.strands = strands.strandCount(), .points = strands.points.size()};
    inspectSizes(strands, findings);
    inspectLengths(strands, findings);
    inspectBox(strands, findings);
    inspectWidths(strands, findings);
    findings.duplicate_strands =
        countDuplicates(strands.strandCount(), [&](std::uint32_t i) { return strands.strand(i); });
    findings.duplicate_roots = countDuplicates(
        strands.strandCount(), [&](std::uint32_t i) { return strands.strand(i).first(1); });

    const Unit unit = strands.metres_per_unit
                          ? statedUnit(*strands.metres_per_unit)
                          : guessUnit(rootExtent(strands), findings.lengths.median);
    findings.unit = unit.name;
    findings.unit_stated = strands.metres_per_unit.has_value();
    findings.metres_per_unit = unit.metres;
    findings.unit_reason = unit.reason;
    if (mesh)
        findings.mesh =
            inspectOnMesh(strands, *mesh, metres_per_unit.value_or(findings.metres_per_unit));
    return findings;
}

}  // namespace hair
