#include "hair/groom/guides/bind_strands.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/process.h"

namespace hair::groom {
namespace {

// ---- The search for a mean ----------------------------------------------------------------------

// Weight of the points' own square distances beside that of their mean. It lifts them to a
// paraboloid, over a plane with the Delaunay triangulation as lower hull. With 1e-6, a mean may be
// farther off by 1e-3 of the distance to the points, if that gives a smaller triangle.
constexpr double kNearness = 1e-6;

// Thinner triangles have no solution that survives rounding, but their edges do.
constexpr double kFlat = 1e-12;

class Search {
public:
    explicit Search(const GramMatrix& gram) : gram_(gram) {}

    void tryPoint(std::size_t i) { offer({i, i, i}, {1.0, 0.0, 0.0}); }

    void tryEdge(std::size_t i, std::size_t j) {
        const double size = edges(i, j, j);
        if (size <= 0.0) return;
        const double along = -fromFirst(i, j) / size;
        if (along > 0.0 && along < 1.0) offer({i, j, i}, {1.0 - along, along, 0.0});
    }

    // Solves the normal equations of the plane's two directions.
    void tryTriangle(std::size_t i, std::size_t j, std::size_t k) {
        const double jj = edges(i, j, j);
        const double jk = edges(i, j, k);
        const double kk = edges(i, k, k);
        const double determinant = jj * kk - jk * jk;
        if (determinant <= kFlat * jj * kk) return;
        const double to_j = -fromFirst(i, j);
        const double to_k = -fromFirst(i, k);
        const double weight_j = (to_j * kk - to_k * jk) / determinant;
        const double weight_k = (to_k * jj - to_j * jk) / determinant;
        const double weight_i = 1.0 - weight_j - weight_k;
        if (weight_i > 0.0 && weight_j > 0.0 && weight_k > 0.0)
            offer({i, j, k}, {weight_i, weight_j, weight_k});
    }

    const Mean& best() const { return best_; }

private:
    // (j - i) . (k - i)
    double edges(std::size_t i, std::size_t j, std::size_t k) const {
        const auto& of = gram_.of;
        return of[j][k] - of[i][j] - of[i][k] + of[i][i];
    }
    // (j - i) . i
    double fromFirst(std::size_t i, std::size_t j) const { return gram_.of[i][j] - gram_.of[i][i]; }

    void offer(const std::array<std::size_t, 3>& members, const std::array<double, 3>& weights) {
        double square = 0.0;
        double squares = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = 0; b < 3; ++b)
                square += weights[a] * weights[b] * gram_.of[members[a]][members[b]];
            squares += weights[a] * gram_.of[members[a]][members[a]];
        }
        const double cost = square + kNearness * squares;
        if (cost >= cost_) return;
        cost_ = cost;
        best_ = {members, weights};
    }

    const GramMatrix& gram_;
    Mean best_;
    double cost_ = std::numeric_limits<double>::infinity();
};

struct Range {
    std::size_t first, count;

    std::size_t middle() const { return first + count / 2; }
    Range before() const { return {first, count / 2}; }
    Range after() const { return {middle() + 1, count - count / 2 - 1}; }
};

// ---- Binding ------------------------------------------------------------------------------------

// Returns the differences of a strand from another: that of the roots, and those of the other
// vertices once the roots are put together. Their squares add up to the squared distance of the
// roots plus the mean of the others. So, as in the choice of guides, a distance h between roots
// weighs as much as h between shapes.
void differences(
    std::span<const glm::vec3> strand, std::span<const glm::vec3> other,
    std::span<glm::dvec3> apart) {
    const double scale = 1.0 / std::sqrt(static_cast<double>(strand.size() - 1));
    apart[0] = glm::dvec3(strand[0]) - glm::dvec3(other[0]);
    for (std::size_t k = 1; k < strand.size(); ++k)
        apart[k] = scale * (glm::dvec3(strand[k]) - glm::dvec3(other[k]) - apart[0]);
}

double product(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    return std::transform_reduce(
        a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
        [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(p, q); });
}

// Returns the binding's weighted mean of a vertex of the guides; `strandOf` gives a guide's
// points.
template <class StrandOf>
glm::dvec3 weightedMean(const StrandBinding& binding, std::size_t vertex, StrandOf&& strandOf) {
    glm::dvec3 mean(0.0);
    for (int i = 0; i < 3; ++i)
        mean += double{binding.weights[i]} *
                glm::dvec3(strandOf(binding.guides[static_cast<std::size_t>(i)])[vertex]);
    return mean;
}

// Binds strands to the guides of one groom, one at a time, and keeps its memory.
class Binder {
public:
    Binder(const Groom& dense, const std::vector<std::uint32_t>& guides)
        : dense_(dense), guides_(guides), tree_(rootsOf(dense, guides)),
          apart_(kMostCandidates * dense.vertices_per_strand) {}

    StrandBinding operator()(std::uint32_t strand) {
        std::array<std::uint32_t, kMostCandidates> near{};
        const auto points = dense_.strand(strand);
        GramMatrix gram{.count = tree_.find(points[0], near)};
        for (std::size_t i = 0; i < gram.count; ++i) {
            differences(guide(near[i]), points, apart(i));
            for (std::size_t j = 0; j <= i; ++j)
                gram.of[i][j] = gram.of[j][i] = product(apart(i), apart(j));
        }
        const Mean mean = nearestMean(gram);
        StrandBinding binding;
        for (std::size_t i = 0; i < 3; ++i) binding.guides[i] = near[mean.members[i]];
        binding.weights.y = static_cast<float>(mean.weights[1]);
        binding.weights.z = static_cast<float>(mean.weights[2]);
        binding.weights.x = 1.0f - binding.weights.y - binding.weights.z;
        binding.offset =
            glm::vec3(glm::dvec3(points[0]) - weightedMean(binding, 0, [this](std::uint32_t i) {
                          return guide(i);
                      }));
        return binding;
    }

private:
    static std::vector<glm::vec3>
    rootsOf(const Groom& dense, const std::vector<std::uint32_t>& guides) {
        std::vector<glm::vec3> roots;
        roots.reserve(guides.size());
        for (const std::uint32_t guide : guides) roots.push_back(dense.strand(guide)[0]);
        return roots;
    }

    std::span<const glm::vec3> guide(std::uint32_t index) const {
        return dense_.strand(guides_[index]);
    }

    std::span<glm::dvec3> apart(std::size_t candidate) {
        const std::size_t size = dense_.vertices_per_strand;
        return std::span(apart_).subspan(candidate * size, size);
    }

    const Groom& dense_;
    const std::vector<std::uint32_t>& guides_;
    RootKdTree tree_;
    std::vector<glm::dvec3> apart_;  // [candidate][vertex]
};

double lengthOf(std::span<const glm::vec3> strand) {
    double length = 0.0;
    for (std::size_t k = 1; k < strand.size(); ++k)
        length += glm::distance(glm::dvec3(strand[k - 1]), glm::dvec3(strand[k]));
    return length;
}

}  // namespace

// ---- The nearest mean ---------------------------------------------------------------------------

Mean nearestMean(const GramMatrix& gram) {
    Search search(gram);
    for (std::size_t i = 0; i < gram.count; ++i) {
        search.tryPoint(i);
        for (std::size_t j = 0; j < i; ++j) {
            search.tryEdge(i, j);
            for (std::size_t k = 0; k < j; ++k) search.tryTriangle(i, j, k);
        }
    }
    const Mean& best = search.best();
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(
        order, std::greater<>(), [&](std::size_t i) { return best.weights[i]; });
    Mean sorted;
    for (std::size_t i = 0; i < 3; ++i) {
        sorted.weights[i] = best.weights[order[i]];
        sorted.members[i] = best.members[sorted.weights[i] > 0.0 ? order[i] : order[0]];
    }
    return sorted;
}

// ---- The tree of roots --------------------------------------------------------------------------

RootKdTree::RootKdTree(std::span<const glm::vec3> points) {
    nodes_.reserve(points.size());
    for (const glm::vec3& point : points)
        nodes_.push_back({point, static_cast<std::uint32_t>(nodes_.size()), 0});
    std::vector<Range> open{{0, nodes_.size()}};
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        if (range.count == 0) continue;
        const auto members = std::span(nodes_).subspan(range.first, range.count);
        glm::vec3 low = members.front().point;
        glm::vec3 high = low;
        for (const Node& node : members) {
            low = glm::min(low, node.point);
            high = glm::max(high, node.point);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::ranges::nth_element(
            members, members.begin() + static_cast<std::ptrdiff_t>(range.count / 2), {},
            [axis](const Node& node) { return std::pair(node.point[axis], node.source); });
        nodes_[range.middle()].axis = axis;
        open.push_back(range.before());
        open.push_back(range.after());
    }
}

std::size_t RootKdTree::find(const glm::vec3& place, std::span<std::uint32_t> nearest) const {
    struct Found {
        double square;
        std::uint32_t source;
        auto operator<=>(const Found&) const = default;
    };
    static constexpr std::size_t most = 16;
    assert(!nearest.empty() && nearest.size() <= most);
    std::array<Found, most> found;  // ascending
    std::size_t count = 0;
    const auto offer = [&](const Node& node) {
        const glm::dvec3 apart = glm::dvec3(node.point) - glm::dvec3(place);
        const Found one{glm::dot(apart, apart), node.source};
        if (count == nearest.size() && one >= found[count - 1]) return;
        if (count < nearest.size()) ++count;
        std::size_t slot = count - 1;
        for (; slot > 0 && one < found[slot - 1]; --slot) found[slot] = found[slot - 1];
        found[slot] = one;
    };

    struct StackEntry {
        Range range;
        double least;  // no point in the range is nearer, squared
    };
    std::array<StackEntry, 64> stack;  // one for each level: every split halves
    std::size_t open = 0;
    stack[open++] = {{0, nodes_.size()}, 0.0};
    while (open > 0) {
        auto [range, least] = stack[--open];
        while (range.count > 0 && (count < nearest.size() || least <= found[count - 1].square)) {
            const Node& node = nodes_[range.middle()];
            offer(node);
            const double across = double{place[node.axis]} - double{node.point[node.axis]};
            const Range far = across < 0.0 ? range.after() : range.before();
            stack[open++] = {far, std::max(least, across * across)};
            range = across < 0.0 ? range.before() : range.after();
        }
    }
    for (std::size_t i = 0; i < count; ++i) nearest[i] = found[i].source;
    return count;
}

// ---- Bindings -----------------------------------------------------------------------------------

std::vector<StrandBinding>
bindStrands(const Groom& dense, const std::vector<std::uint32_t>& guides) {
    assert(!guides.empty());
    std::optional<Binder> bind;
    if (guides.size() < dense.strand_count) bind.emplace(dense, guides);
    std::vector<StrandBinding> bindings(dense.strand_count);
    std::uint32_t next = 0;
    engine::Step step("binds strands to guides", dense.strand_count);
    for (std::uint32_t strand = 0; strand < dense.strand_count; ++strand) {
        step.advance();
        if (next < guides.size() && guides[next] == strand) {
            bindings[strand].guides = {next, next, next};
            ++next;
        } else {
            bindings[strand] = (*bind)(strand);
        }
    }
    return bindings;
}

ReconstructionError reconstructionError(
    const Groom& dense, const Groom& guides, const std::vector<StrandBinding>& bindings) {
    assert(bindings.size() == dense.strand_count && dense.strand_count > 0);
    assert(guides.vertices_per_strand == dense.vertices_per_strand);
    const double vertices = dense.vertices_per_strand;
    ReconstructionError error;
    double lengths = 0.0;
    std::vector<double> means;
    means.reserve(dense.strand_count);
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        const auto strand = dense.strand(i);
        double sum = 0.0;
        for (std::size_t k = 0; k < strand.size(); ++k) {
            const glm::dvec3 given =
                glm::dvec3(bindings[i].offset) +
                weightedMean(bindings[i], k, [&](std::uint32_t g) { return guides.strand(g); });
            const double distance = glm::distance(given, glm::dvec3(strand[k]));
            sum += distance;
            error.rms += distance * distance;
            error.maximum = std::max(error.maximum, distance);
        }
        lengths += lengthOf(strand);
        means.push_back(sum / vertices);
        error.mean += sum / vertices;
    }
    const double strands = dense.strand_count;
    error.mean /= strands;
    error.rms = std::sqrt(error.rms / (strands * vertices));
    error.relative = lengths > 0.0 ? error.mean * strands / lengths : 0.0;
    // The least number that 95 % of the strands don't exceed.
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * strands)) - 1;
    std::ranges::nth_element(means, means.begin() + rank);
    error.percentile95 = means[static_cast<std::size_t>(rank)];
    return error;
}

}  // namespace hair::groom
