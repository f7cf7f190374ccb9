#include "benchmarks/viewer/tools/hand_path.h"

#include <algorithm>

#include <glm/common.hpp>

#include "benchmarks/viewer/tools/field_limits.h"

namespace benchmarks {

namespace {

constexpr std::size_t kKeysOfAMove = 3;  // the present, the next frame, and where it stays

// Leaves what was played, with a key at the present; nothing where the path begins later.
void cut(std::vector<hair::PullKey>& path, float now) {
    if (path.empty()) return;
    const glm::vec3 present = handAt(path, now);
    std::erase_if(path, [&](const hair::PullKey& key) { return key.time > now; });
    if (!path.empty() && path.back().time < now) path.push_back({now, present});
}

}  // namespace

glm::vec3 handAt(std::span<const hair::PullKey> path, float time) {
    const auto after = std::ranges::upper_bound(path, time, {}, &hair::PullKey::time);
    if (after == path.begin()) return path.front().position;
    if (after == path.end()) return path.back().position;
    const hair::PullKey& before = *(after - 1);
    const float share = (time - before.time) / (after->time - before.time);
    return glm::mix(before.position, after->position, share);
}

void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position) {
    position = allowed(&hair::PullKey::position, position);
    cut(path, moment.now);
    if (path.empty()) path.push_back({moment.now, position});
    // A hand that rests needs no key for every frame.
    if (path.size() >= 2 && path.back().position == position &&
        path[path.size() - 2].position == position)
        path.pop_back();
    path.push_back({moment.next, position});
    path.push_back({moment.later, position});
}

void letGo(std::vector<hair::PullKey>& path, const Moment& moment) {
    if (path.empty()) return;
    const glm::vec3 wanted = path.back().position;
    cut(path, moment.now);
    if (path.size() == 1) path.push_back({moment.next, wanted});
}

bool hasRoom(std::span<const hair::PullKey> path) {
    return path.size() + kKeysOfAMove <= mostOf(&hair::PullSettings::path);
}

}  // namespace benchmarks
