#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/steps.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"

// What keeps strands off the mesh that they grow on.
namespace hair::groom {

// The part of a mesh's surface next to a point.
struct NearGround {
    glm::dvec3 position;
    glm::dvec3 outward;  // unit, toward the point or, from inside, away from it
    double gap;  // negative inside
};

// `nearest` is the point of the mesh that is nearest to the point.
NearGround groundUnder(const glm::dvec3& point, const MeshPoint& nearest, const Mesh& mesh);

// Does something for each index below `count`, in any order and on all processors, as a step of
// that name; what it throws comes out of here.
template <class Work>
void inParallel(const char* name, std::uint32_t count, Work&& work) {
    static constexpr std::uint32_t kTaken = 256;  // indices at a time
    engine::Step step(name, count);
    std::atomic<std::uint64_t> next = 0;
    const auto take = [&] {
        for (std::uint64_t first = next.fetch_add(kTaken); first < count;
             first = next.fetch_add(kTaken)) {
            const std::uint64_t end = std::min<std::uint64_t>(first + kTaken, count);
            for (std::uint64_t i = first; i < end; ++i) work(static_cast<std::uint32_t>(i));
            step.advance(end - first);
        }
    };
    const std::uint32_t takers =
        std::min((count + kTaken - 1) / kTaken, std::thread::hardware_concurrency());
    std::vector<std::future<void>> others;
    for (std::uint32_t i = 1; i < takers; ++i)
        others.push_back(std::async(std::launch::async, take));
    take();
    for (std::future<void>& other : others) other.get();
}

}  // namespace hair::groom
