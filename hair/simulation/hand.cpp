#include "hair/simulation/hand.h"

#include <algorithm>
#include <string>

#include <glm/common.hpp>

#include "engine/error.h"

namespace hair {

namespace {

glm::dvec3 positionAt(const std::vector<PullKey>& path, double time) {
    const auto after = std::ranges::upper_bound(
        path, time, {}, [](const PullKey& key) { return double{key.time}; });
    if (after == path.begin()) return path.front().position;
    if (after == path.end()) return path.back().position;
    const PullKey& a = *(after - 1);
    const double part = (time - double{a.time}) / (double{after->time} - double{a.time});
    return glm::mix(glm::dvec3(a.position), glm::dvec3(after->position), part);
}

void checkVertex(
    const std::string& pull, const char* member, std::uint32_t number, std::uint32_t count,
    const char* things) {
    if (number >= count)
        throw engine::Error(
            pull + "/" + member, std::to_string(number) + " is none of the groom's " +
                                     std::to_string(count) + " " + things);
}

}  // namespace

std::optional<Hand> handIn(const PullSettings& pull, double from, double to) {
    const double middle = 0.5 * (from + to);
    if (pull.path.empty() || middle < pull.path.front().time || middle > pull.path.back().time)
        return {};
    const glm::dvec3 end = positionAt(pull.path, to);
    return Hand{.position = end, .velocity = (end - positionAt(pull.path, from)) / (to - from)};
}

void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide) {
    for (std::size_t i = 0; i < pulls.size(); ++i) {
        const std::string name = "/simulation/pulls/" + std::to_string(i);
        checkVertex(name, "guide", pulls[i].guide, guides, "guides");
        checkVertex(name, "vertex", pulls[i].vertex, vertices_per_guide, "vertices of a guide");
        const auto& path = pulls[i].path;
        const auto late =
            std::ranges::adjacent_find(path, std::ranges::greater_equal{}, &PullKey::time);
        if (late != path.end())
            throw engine::Error(
                name + "/path/" + std::to_string(late - path.begin() + 1) + "/time",
                "is not after the key before");
    }
}

}  // namespace hair
