#include "hair/groom/guides/choose_guides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/random.h"

namespace hair::groom {
namespace {

// The farthest-point traversal: again and again, the strand that is least like all guides so far
// becomes a guide. No set of as many guides halves the greatest distance of a strand from its
// nearest guide. Gonzalez 1985, Clustering to minimize the maximum intercluster distance. It takes
// the outermost strands first, so that the edge of the hair is among the guides.

constexpr std::uint32_t kParts = 4;  // of a strand, to describe its shape

// A strand as a point: the root, and the mean of each part relative to the root, in metres. A part
// counts by its share of the vertices. The distance between two strands with the same root is then
// at most the root mean square distance of their vertices, and about that for smooth strands. So
// it weighs the same whether two strands stand h apart or separate by h from one root.
using Feature = std::array<float, 3 + 3 * kParts>;

Feature featureOf(std::span<const glm::vec3> strand) {
    const std::size_t segments = strand.size() - 1;
    std::array<glm::dvec3, kParts> sums{};
    std::array<double, kParts> counts{};
    for (std::size_t k = 0; k < segments; ++k) {
        const std::size_t part = k * kParts / segments;
        sums[part] += glm::dvec3(strand[k + 1]) - glm::dvec3(strand[0]);
        counts[part] += 1.0;
    }
    Feature feature{strand[0].x, strand[0].y, strand[0].z};
    for (std::size_t part = 0; part < kParts; ++part) {
        if (counts[part] == 0.0) continue;
        const glm::dvec3 mean =
            sums[part] / std::sqrt(counts[part] * static_cast<double>(segments));
        for (int axis = 0; axis < 3; ++axis)
            feature[3 + 3 * part + static_cast<std::size_t>(axis)] = static_cast<float>(mean[axis]);
    }
    return feature;
}

float squareDistance(const Feature& a, const Feature& b) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

// Strands that show how hair lies: those with a length, or all strands if none has.
std::vector<std::uint32_t> strandsWithLength(const Groom& dense) {
    std::vector<std::uint32_t> strands;
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        const auto points = dense.strand(i);
        if (std::ranges::any_of(points, [&](const glm::vec3& p) { return p != points.front(); }))
            strands.push_back(i);
    }
    if (!strands.empty()) return strands;
    strands.resize(dense.strand_count);
    std::iota(strands.begin(), strands.end(), 0u);
    return strands;
}

// Every strand belongs to its nearest guide. A new guide takes strands only from guides that are
// less than twice as far from it as their own farthest strand, so it costs the strands round it
// and a look at all guides.
class Traversal {
public:
    // Starts from the strand farthest from a random one: always at an end of the hair.
    Traversal(const Groom& dense, std::uint32_t random) {
        features_.reserve(dense.strand_count);
        for (std::uint32_t i = 0; i < dense.strand_count; ++i)
            features_.push_back(featureOf(dense.strand(i)));
        const std::vector<std::uint32_t> strands = strandsWithLength(dense);
        const Feature& any = features_[strands[random % strands.size()]];
        const std::uint32_t first = *std::ranges::max_element(
            strands, {}, [&](std::uint32_t i) { return squareDistance(any, features_[i]); });
        std::vector<Member>& all = members_.emplace_back();
        all.reserve(strands.size());
        for (const std::uint32_t i : strands)
            all.push_back({i, squareDistance(features_[first], features_[i])});
        guides_.push_back({rootOf(first), 0.0f, first});
        update(0);
    }

    // Makes the strand that is farthest from all guides a guide; false if none is apart.
    bool addFarthest() {
        const auto widest = static_cast<std::size_t>(
            std::ranges::max_element(guides_, {}, &Guide::reach) - guides_.begin());
        if (!(guides_[widest].reach > 0.0f)) return false;
        const std::uint32_t strand =
            std::ranges::max_element(members_[widest], {}, &Member::square)->strand;
        const glm::vec3 root = rootOf(strand);
        std::vector<Member> drawn;
        for (std::size_t i = 0; i < guides_.size(); ++i) {
            const glm::vec3 apart = guides_[i].root - root;
            // The distance by roots alone is a lower bound.
            if (glm::dot(apart, apart) > guides_[i].reach) continue;
            if (squareDistance(features_[guides_[i].strand], features_[strand]) <= guides_[i].reach)
                draw(i, strand, drawn);
        }
        guides_.push_back({root, 0.0f, strand});
        members_.push_back(std::move(drawn));
        update(guides_.size() - 1);
        return true;
    }

    std::vector<std::uint32_t> guides() const {
        std::vector<std::uint32_t> strands;
        for (const Guide& guide : guides_) strands.push_back(guide.strand);
        return strands;
    }

private:
    struct Member {
        std::uint32_t strand;
        float square;  // of the distance from the guide
    };
    struct Guide {
        glm::vec3 root;
        float reach;  // 4 times the greatest square of its members
        std::uint32_t strand;
    };

    glm::vec3 rootOf(std::uint32_t strand) const {
        const Feature& feature = features_[strand];
        return {feature[0], feature[1], feature[2]};
    }

    void draw(std::size_t guide, std::uint32_t strand, std::vector<Member>& drawn) {
        std::erase_if(members_[guide], [&](const Member& member) {
            const float square = squareDistance(features_[member.strand], features_[strand]);
            if (square >= member.square) return false;
            drawn.push_back({member.strand, square});
            return true;
        });
        update(guide);
    }

    void update(std::size_t guide) {
        float greatest = 0.0f;
        for (const Member& member : members_[guide]) greatest = std::max(greatest, member.square);
        guides_[guide].reach = 4.0f * greatest;
    }

    std::vector<Feature> features_;             // [strand]
    std::vector<Guide> guides_;
    std::vector<std::vector<Member>> members_;  // [guide]
};

// Adds strands that differ too little from the guides to be told apart by their features: first
// those that are still unlike every other, vertex for vertex, then the rest.
void addAlike(const Groom& dense, std::uint32_t count, std::vector<std::uint32_t>& guides) {
    std::vector<bool> taken(dense.strand_count);
    for (const std::uint32_t guide : guides) taken[guide] = true;
    std::vector<std::uint32_t> order(dense.strand_count);
    std::iota(order.begin(), order.end(), 0u);
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
        const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
        const auto p = dense.strand(a);
        const auto q = dense.strand(b);
        return std::lexicographical_compare_three_way(
            p.begin(), p.end(), q.begin(), q.end(),
            [&](const glm::vec3& u, const glm::vec3& v) { return key(u) <=> key(v); });
    };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const auto compared = compare(a, b);
        if (compared != 0) return compared < 0;
        return std::tuple(!taken[a], a) < std::tuple(!taken[b], b);
    });
    std::vector<std::uint32_t> unlike;
    std::vector<std::uint32_t> alike;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (taken[order[i]]) continue;
        const bool is_first = i == 0 || compare(order[i - 1], order[i]) != 0;
        (is_first ? unlike : alike).push_back(order[i]);
    }
    std::ranges::sort(unlike);
    std::ranges::sort(alike);
    unlike.insert(unlike.end(), alike.begin(), alike.end());
    for (std::size_t i = 0; guides.size() < count; ++i) guides.push_back(unlike[i]);
}

}  // namespace

std::vector<std::uint32_t>
chooseGuides(const Groom& dense, std::uint32_t count, std::uint32_t seed) {
    if (count > dense.strand_count)
        throw engine::Error(
            "there are " + std::to_string(dense.strand_count) + " strands to choose " +
            std::to_string(count) + " guides from");
    if (count == 0) return {};
    Traversal traversal(dense, hash(seed, 0, purpose::guide_choice));
    engine::Step step("chooses guides", count);
    for (std::uint32_t chosen = 1; chosen < count && traversal.addFarthest(); ++chosen)
        step.advance();
    std::vector<std::uint32_t> guides = traversal.guides();
    if (guides.size() < count) addAlike(dense, count, guides);
    std::ranges::sort(guides);
    return guides;
}

Groom pickStrands(const Groom& dense, const std::vector<std::uint32_t>& strands) {
    Groom picked{
        .strand_count = static_cast<std::uint32_t>(strands.size()),
        .vertices_per_strand = dense.vertices_per_strand};
    const std::size_t vertices = dense.vertices_per_strand;
    for (const std::uint32_t strand : strands) {
        const auto points = dense.strand(strand);
        picked.points.insert(picked.points.end(), points.begin(), points.end());
        if (!dense.root_normals.empty()) picked.root_normals.push_back(dense.root_normals[strand]);
        if (dense.widths.empty()) continue;
        const auto widths = std::span(dense.widths).subspan(strand * vertices, vertices);
        picked.widths.insert(picked.widths.end(), widths.begin(), widths.end());
    }
    return picked;
}

}  // namespace hair::groom
