#include "hair/groom/growth/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace hair {
namespace {

constexpr double kMargin = 0.001;

bool isNearEdge(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 edge = b - a;
    const glm::dvec2 from_a = point - a;
    const double length2 = glm::dot(edge, edge);
    const double limit2 = kMargin * kMargin * length2;
    const double across = edge.x * from_a.y - edge.y * from_a.x;
    if (across * across > limit2 * length2) return false;  // far from the whole line
    const double t = std::clamp(glm::dot(from_a, edge) / length2, 0.0, 1.0);
    const glm::dvec2 gap = from_a - t * edge;
    return glm::dot(gap, gap) < limit2;
}

}  // namespace

// As many rows as edges; an edge is in all rows that it and its margin reach.
Outline::Outline(std::vector<glm::dvec2> polygon) : polygon_(std::move(polygon)) {
    const std::size_t count = polygon_.size();
    struct Range {
        double low, high;
    };
    std::vector<Range> ranges;
    low_ = std::numeric_limits<double>::infinity();
    double high = -low_;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2& a = polygon_[i];
        const glm::dvec2& b = polygon_[(i + 1) % count];
        const double margin = 2.0 * kMargin * glm::distance(a, b);
        ranges.push_back({std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin});
        low_ = std::min(low_, ranges.back().low);
        high = std::max(high, ranges.back().high);
    }
    per_row_ = high > low_ ? static_cast<double>(count) / (high - low_) : 0.0;
    const auto row = [&](double y) {
        return std::min(static_cast<std::size_t>((y - low_) * per_row_), count - 1);
    };
    std::vector<std::vector<std::uint32_t>> rows(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t at = row(ranges[i].low); at <= row(ranges[i].high); ++at)
            rows[at].push_back(i);
    }
    for (const auto& edges : rows) {
        starts_.push_back(static_cast<std::uint32_t>(edges_.size()));
        edges_.insert(edges_.end(), edges.begin(), edges.end());
    }
    starts_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

bool Outline::contains(const glm::dvec2& point) const {
    const double at = (point.y - low_) * per_row_;
    const std::size_t rows = polygon_.size();
    if (!(at >= 0.0) || at > static_cast<double>(rows)) return false;
    const std::size_t row = std::min(static_cast<std::size_t>(at), rows - 1);
    bool inside = false;
    for (std::uint32_t i = starts_[row]; i < starts_[row + 1]; ++i) {
        const glm::dvec2& a = polygon_[edges_[i]];
        const glm::dvec2& b = polygon_[edges_[i] + 1 < rows ? edges_[i] + 1 : 0];
        if (isNearEdge(point, a, b)) return false;
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

}  // namespace hair
