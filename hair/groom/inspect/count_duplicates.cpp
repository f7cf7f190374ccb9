#include "hair/groom/inspect/count_duplicates.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace hair {
namespace {

// Rounds of multiply and shift with the constants of MurmurHash3's finalizer (Appleby 2011).
std::uint64_t hashOf(std::span<const glm::vec3> points) {
    std::uint64_t hash = points.size();
    const auto add = [&](float value) {
        hash ^= std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 equals 0
        hash *= 0xff51afd7ed558ccd;
        hash ^= hash >> 33;
    };
    for (const glm::vec3& point : points) {
        add(point.x);
        add(point.y);
        add(point.z);
    }
    return hash;
}

struct Entry {
    std::uint64_t hash;
    std::uint32_t row;
    auto operator<=>(const Entry&) const = default;
};

}  // namespace

std::uint32_t countDuplicates(
    std::uint32_t count, const std::function<std::span<const glm::vec3>(std::uint32_t)>& row) {
    std::vector<Entry> entries;
    entries.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) entries.push_back({hashOf(row(i)), i});
    std::ranges::sort(entries);

    std::uint32_t duplicates = 0;
    std::vector<std::uint32_t> unlike;  // rows with one hash: all but always one
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (i == 0 || entries[i].hash != entries[i - 1].hash) unlike.clear();
        const auto points = row(entries[i].row);
        const auto equals = [&](std::uint32_t other) {
            return std::ranges::equal(points, row(other));
        };
        if (std::ranges::any_of(unlike, equals)) {
            ++duplicates;
        } else {
            unlike.push_back(entries[i].row);
        }
    }
    return duplicates;
}

}  // namespace hair
