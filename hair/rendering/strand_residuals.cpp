#include "hair/rendering/strand_residuals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/gpu_structs.h"
#include "hair/groom/style/displace.h"

namespace hair::rendering {
namespace {

constexpr std::uint32_t kMostSteps = 32767;  // in a coordinate of a sample
const auto kMostPlace = static_cast<std::uint32_t>(gpu::kResidualPlaces);

// ---- Curves of strands at rest ------------------------------------------------------------------

using CurveWeights = std::array<double, 4>;

// Thesis equation (4), and Catmull and Rom 1974; t in [0, 1].
CurveWeights curveWeights(Curve curve, double t) {
    const double s = 1.0 - t;
    if (curve == Curve::catmull_rom)
        return {
            -0.5 * t * s * s, 0.5 * ((3.0 * t - 5.0) * t * t + 2.0),
            0.5 * ((3.0 * s - 5.0) * s * s + 2.0), -0.5 * s * t * t};
    return {
        s * s * s / 6.0, ((3.0 * t - 6.0) * t * t + 4.0) / 6.0,
        ((3.0 * s - 6.0) * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

// The curve that strands of a groom have at rest, without residuals:
// shaders/strands/interpolation.glsl.
class RestCurve {
public:
    RestCurve(const groom::Groom& groom, const StrandSettings& settings)
        : groom_(groom), curve_(settings.curve), single_(singleShare(settings)),
          controls_(groom.vertices_per_strand + std::size_t{2}) {}

    void take(const groom::StrandBinding& binding) {
        const std::size_t vertices = groom_.vertices_per_strand;
        if (binding.followsHead()) {
            std::ranges::fill(controls_, glm::dvec3(binding.offset));
            return;
        }
        const int heaviest = heaviestOf(binding.weights);
        const auto weightOf = [&](int i) {
            return (1.0 - single_) * binding.weights[i] + (i == heaviest ? single_ : 0.0);
        };
        glm::dvec3 mean_root(0.0);
        for (int i = 0; i < 3; ++i)
            mean_root += double{binding.weights[i]} * glm::dvec3(guide(binding, i)[0]);
        const glm::dvec3 lift = glm::dvec3(binding.offset) +
                                single_ * (mean_root - glm::dvec3(guide(binding, heaviest)[0]));
        for (std::size_t k = 0; k < vertices; ++k) {
            controls_[k + 1] = lift;
            for (int i = 0; i < 3; ++i)
                controls_[k + 1] += weightOf(i) * glm::dvec3(guide(binding, i)[k]);
        }
        const bool reflects = curve_ != Curve::bspline_unpinned;
        controls_[0] = reflects ? 2.0 * controls_[1] - controls_[2] : controls_[1];
        controls_[vertices + 1] =
            reflects ? 2.0 * controls_[vertices] - controls_[vertices - 1] : controls_[vertices];
    }

    // `along` in [0, 1].
    glm::dvec3 at(double along) const {
        const std::size_t segments = groom_.vertices_per_strand - 1;
        const double place = along * static_cast<double>(segments);
        const std::size_t segment = std::min(static_cast<std::size_t>(place), segments - 1);
        const CurveWeights weights = curveWeights(curve_, place - static_cast<double>(segment));
        glm::dvec3 point(0.0);
        for (std::size_t k = 0; k < 4; ++k) point += weights[k] * controls_[segment + k];
        return point;
    }

private:
    static double singleShare(const StrandSettings& settings) {
        switch (settings.interpolation) {
        case Interpolation::multi:
            return 0.0;
        case Interpolation::single:
            return 1.0;
        case Interpolation::mixed:
            return 1.0 - double{settings.blend};
        }
        return 0.0;
    }

    static int heaviestOf(const glm::vec3& weights) {
        if (weights.x >= weights.y && weights.x >= weights.z) return 0;
        return weights.y >= weights.z ? 1 : 2;
    }

    std::span<const glm::vec3> guide(const groom::StrandBinding& binding, int i) const {
        return groom_.strand(binding.guides[static_cast<std::size_t>(i)]);
    }

    const groom::Groom& groom_;
    Curve curve_;
    double single_;  // share of the heaviest guide alone
    std::vector<glm::dvec3> controls_;  // [1 + vertex + 1], m
};

// ---- Samples ------------------------------------------------------------------------------------

// A point of the file, with its place along the strand.
struct PlacedPoint {
    std::uint32_t place;
    glm::dvec3 position;  // m
};

std::uint32_t placeAt(double along) {
    return static_cast<std::uint32_t>(std::lround(along * kMostPlace));
}

// A strand's points at ascending places, from 0 to kMostPlace. Leaves out points with places that
// are taken, never the first or the last, and records their distances from the points that are
// kept.
class PlacedPoints {
public:
    void take(std::span<const glm::vec3> points, std::size_t vertices) {
        placed_.clear();
        left_out_ = {};
        farthest_left_out_ = 0.0;
        const glm::dvec3 tip(points.back());
        const std::size_t last = points.size() - 1;
        placed_.push_back({0, glm::dvec3(points.front())});
        if (last > 1) {
            const groom::AlongStrand along(points);
            const bool by_number = points.size() == vertices || along.length() == 0.0;
            for (std::size_t i = 1; i < last; ++i) {
                const double fraction = by_number
                                            ? static_cast<double>(i) / static_cast<double>(last)
                                            : along.fraction(i);
                const std::uint32_t place = placeAt(fraction);
                const glm::dvec3 position(points[i]);
                if (place > placed_.back().place && place < kMostPlace)
                    placed_.push_back({place, position});
                else
                    leaveOut(position, place < kMostPlace ? placed_.back().position : tip);
            }
        }
        placed_.push_back({kMostPlace, tip});
    }

    const std::vector<PlacedPoint>& points() const { return placed_; }
    double leftOut() const { return left_out_; }  // sum of the distances
    double farthestLeftOut() const { return farthest_left_out_; }

private:
    void leaveOut(const glm::dvec3& point, const glm::dvec3& kept) {
        const double distance = glm::distance(point, kept);
        left_out_ += distance;
        farthest_left_out_ = std::max(farthest_left_out_, distance);
    }

    std::vector<PlacedPoint> placed_;
    double left_out_ = 0.0;
    double farthest_left_out_ = 0.0;
};

// Whether every place can be found without a search: by the sample at its place among evenly spaced
// ones, shifted by kResidualGuess = 1/4 of an interval, or by a neighbour of that sample.
bool isEven(std::span<const PlacedPoint> points) {
    const auto intervals = static_cast<double>(points.size() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double ahead = points[i].place * intervals / kMostPlace - static_cast<double>(i);
        if (ahead < -0.2 || ahead > 0.7) return false;
    }
    return true;
}

glm::uvec2 packed(const glm::ivec3& steps, std::uint32_t place) {
    const glm::uvec3 low = glm::uvec3(steps) & 0xffffu;
    return {low.x | low.y << 16u, low.z | place << 16u};
}

// Bounds the length of the curve's vectors. The curve stays within the hull of its control points
// in Bernstein form: the samples, and the points a third of an interval along the slope at both of
// its ends.
double reachOf(std::span<const glm::dvec3> samples, std::span<const PlacedPoint> points) {
    const auto slope = [&](std::size_t i) {
        return (samples[i + 1] - samples[i]) /
               static_cast<double>(points[i + 1].place - points[i].place);
    };
    const auto size = [&](std::size_t i) {
        return static_cast<double>(points[i + 1].place - points[i].place);
    };
    const std::size_t intervals = samples.size() - 1;
    // The slope of the parabola through a sample and its neighbours. The ends use the parabola of
    // the next sample.
    const auto steepness = [&](std::size_t i) {
        if (intervals == 1) return slope(0);
        if (i == 0) return slope(0) + size(0) / (size(0) + size(1)) * (slope(0) - slope(1));
        if (i == intervals)
            return slope(i - 1) +
                   size(i - 1) / (size(i - 1) + size(i - 2)) * (slope(i - 1) - slope(i - 2));
        return (size(i) * slope(i - 1) + size(i - 1) * slope(i)) / (size(i - 1) + size(i));
    };
    double reach = 0.0;
    for (std::size_t i = 0; i <= intervals; ++i) {
        const glm::dvec3 along = steepness(i) / 3.0;
        reach = std::max(reach, glm::length(samples[i]));
        if (i < intervals) reach = std::max(reach, glm::length(samples[i] + size(i) * along));
        if (i > 0) reach = std::max(reach, glm::length(samples[i] - size(i - 1) * along));
    }
    return reach;
}

}  // namespace

// ---- Residuals ----------------------------------------------------------------------------------

StrandResiduals makeStrandResiduals(
    const groom::Groom& groom, const StrandSettings& settings,
    std::span<const std::uint32_t> order) {
    assert(groom.bound_ends.size() == groom.bindings.size());
    StrandResiduals residuals;
    residuals.strands.reserve(order.size());
    residuals.samples.reserve(groom.bound_points.size() + 1);
    residuals.samples.emplace_back(0, 0);
    RestCurve curve(groom, settings);
    PlacedPoints placed;
    std::vector<glm::dvec3> vectors;
    double points = 0.0;
    const auto count = [](Lengths& lengths, double length) {
        lengths.mean += length;  // the sum so far
        lengths.greatest = std::max(lengths.greatest, length);
    };
    for (const std::uint32_t strand : order) {
        curve.take(groom.bindings[strand]);
        placed.take(groom.boundStrand(strand), groom.vertices_per_strand);
        vectors.clear();
        double greatest = 0.0;
        for (const PlacedPoint& point : placed.points()) {
            vectors.push_back(
                point.position - curve.at(static_cast<double>(point.place) / kMostPlace));
            count(residuals.kept, glm::length(vectors.back()));
            for (int axis = 0; axis < 3; ++axis)
                greatest = std::max(greatest, std::abs(vectors.back()[axis]));
        }
        StrandResidual residual{
            .first = static_cast<std::uint32_t>(residuals.samples.size()),
            .count = static_cast<std::uint32_t>(vectors.size()),
            .step = static_cast<float>(greatest / kMostSteps)};
        // Residuals below the smallest step count as none.
        const double step = residual.step > 0.0f ? double{residual.step} : 1.0;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            const glm::dvec3 steps =
                glm::clamp(glm::round(vectors[i] / step), -double{kMostSteps}, double{kMostSteps});
            residuals.samples.push_back(packed(glm::ivec3(steps), placed.points()[i].place));
            const glm::dvec3 drawn = double{residual.step} * steps;
            count(residuals.left, glm::distance(vectors[i], drawn));
            vectors[i] = drawn;
        }
        residual.reach = static_cast<float>(reachOf(vectors, placed.points()) * (1.0 + 1e-6));
        residuals.strands.push_back(residual);
        if (!isEven(placed.points())) {
            const auto halvings = static_cast<std::uint32_t>(std::bit_width(vectors.size()));
            residuals.samples.front().x = std::max(residuals.samples.front().x, halvings);
        }
        residuals.left.mean += placed.leftOut();
        residuals.left.greatest = std::max(residuals.left.greatest, placed.farthestLeftOut());
        points += static_cast<double>(vectors.size());
    }
    if (points > 0.0) {
        residuals.kept.mean /= points;
        residuals.left.mean /= points;
    }
    return residuals;
}

std::vector<glm::vec3> restTangents(const groom::Groom& groom) {
    std::vector<glm::vec3> tangents;
    tangents.reserve(groom.points.size());
    const std::size_t last = groom.vertices_per_strand - 1;
    for (std::uint32_t guide = 0; guide < groom.strand_count; ++guide) {
        const auto points = groom.strand(guide);
        for (std::size_t k = 0; k <= last; ++k) {
            const glm::dvec3 chord =
                glm::dvec3(points[std::min(k + 1, last)]) - glm::dvec3(points[k == 0 ? 0 : k - 1]);
            const double length = glm::length(chord);
            tangents.emplace_back(length > 0.0 ? chord / length : glm::dvec3(0.0));
        }
    }
    return tangents;
}

}  // namespace hair::rendering
