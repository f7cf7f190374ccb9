#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/rendering/groom_buffers.h"

namespace hair::rendering {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

inline constexpr float kUlp = 0x1p-24f;  // rounding of a float, relative

// Contacts as a simulation could mark them, [guide][vertex]. Two of three guides touch a body, each
// at a different vertex. The vertices below it are marked too.
inline std::vector<bool> madeUpContacts(const groom::Groom& groom) {
    std::vector<bool> contacts;
    for (std::uint32_t guide = 0; guide < groom.strand_count; ++guide) {
        const std::uint32_t first = guide % 3 == 0 ? groom.vertices_per_strand
                                                   : 1 + guide % (groom.vertices_per_strand - 1);
        for (std::uint32_t v = 0; v < groom.vertices_per_strand; ++v)
            contacts.push_back(v >= first);
    }
    return contacts;
}

// A body amid tangledGroom(), which follows the head, and its margin, m.
inline constexpr gpu::Capsule kMadeUpBody{
    .a = {-0.05f, 0.02f, 0.0f},
    .radius = 0.08f,
    .b = {0.08f, 0.1f, 0.02f},
    .follows = gpu::kFollowsHead};
inline constexpr float kMadeUpMargin = 0.03f;

// A groom on the device as rendering sees it, at rest and with made-up contacts and a body.
class DeviceHair {
public:
    DeviceHair(
        const engine::Device& device, const groom::Groom& groom, const Settings& settings = {},
        const groom::StrandSet* offsets = nullptr)
        : buffers_(device, groom, settings, offsets),
          guides_(engine::makeBuffer(device, withoutW(groom.points), "guides", "tests")),
          contacts_(engine::makeBuffer(device, onlyW(madeUpContacts(groom)), "contacts", "tests")),
          capsule_(engine::makeBuffer(device, std::array{kMadeUpBody}, "capsule", "tests")),
          bodies_(engine::makeBuffer(device, std::vector{bodies()}, "bodies", "tests")) {}

    StrandView view() const {
        StrandView view = buffers_.view();
        view.guides = guides_.address();
        view.contacts = contacts_.address();
        view.bodies = bodies_.address();
        return view;
    }

private:
    // w belongs to the simulation: a NaN there must not matter.
    static std::vector<glm::vec4> withoutW(const std::vector<glm::vec3>& points) {
        std::vector<glm::vec4> result;
        for (const glm::vec3& point : points) {
            result.emplace_back(point, std::numeric_limits<float>::quiet_NaN());
        }
        return result;
    }

    static std::vector<glm::vec4> onlyW(const std::vector<bool>& contacts) {
        std::vector<glm::vec4> result;
        for (const bool contact : contacts) {
            result.emplace_back(
                glm::vec3(std::numeric_limits<float>::quiet_NaN()), contact ? 1.0f : 0.0f);
        }
        return result;
    }

    gpu::Bodies bodies() const {
        return {
            .capsules = capsule_.address(),
            .fields = 0,
            .capsule_count = 1,
            .field_count = 0,
            .margin = kMadeUpMargin,
            .friction = 0.0f};
    }

    GroomBuffers buffers_;
    engine::Buffer guides_;
    engine::Buffer contacts_;
    engine::Buffer capsule_;
    engine::Buffer bodies_;
};

// A groom of one root triangle; its guides have these points.
inline groom::Groom oneTriangle(const std::array<std::vector<glm::vec3>, 3>& guides) {
    groom::Groom groom{
        .strand_count = 3,
        .vertices_per_strand = static_cast<std::uint32_t>(guides[0].size()),
        .root_triangles = {{0, 1, 2}}};
    for (const std::vector<glm::vec3>& guide : guides) {
        groom.points.insert(groom.points.end(), guide.begin(), guide.end());
    }
    return groom;
}

inline groom::Groom oneTriangle(const std::vector<glm::vec3>& guide) {
    return oneTriangle({guide, guide, guide});
}

// Three parallel guides of 0.3 m, upward.
inline groom::Groom uprightGroom() {
    std::array<std::vector<glm::vec3>, 3> guides;
    for (int v = 0; v < 16; ++v) {
        const float height = 0.02f * static_cast<float>(v);
        guides[0].emplace_back(0.0f, height, 0.0f);
        guides[1].emplace_back(0.05f, height, 0.0f);
        guides[2].emplace_back(0.0f, height, 0.05f);
    }
    return oneTriangle(guides);
}

// Three guides with their roots at the unit vectors, so that the position of a strand's root equals
// its barycentric coordinates, for any number of root triangles.
inline groom::Groom unitTriangles(std::uint32_t triangles) {
    const glm::vec3 up(1.0f, 1.0f, 1.0f);
    const std::array<glm::vec3, 3> roots{glm::vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    groom::Groom groom = oneTriangle(
        {std::vector{roots[0], roots[0] + up}, std::vector{roots[1], roots[1] + up},
         std::vector{roots[2], roots[2] + up}});
    groom.root_triangles.assign(triangles, {0, 1, 2});
    return groom;
}

// Curved guides of about 0.5 m with bulging roots, in no special arrangement.
inline groom::Groom tangledGroom(std::uint32_t vertices) {
    constexpr std::uint32_t kGuides = 6;
    groom::Groom groom{
        .strand_count = kGuides,
        .vertices_per_strand = vertices,
        .root_triangles = {{0, 1, 2}, {2, 1, 3}, {5, 3, 4}, {4, 0, 5}}};
    std::mt19937 random(11);
    const auto number = [&] { return static_cast<float>(random() >> 8u) * 0x1p-23f - 1.0f; };
    for (std::uint32_t guide = 0; guide < kGuides; ++guide) {
        glm::vec3 point(0.2f * number(), 0.2f * number(), 0.2f * number());
        const glm::vec3 normal(number(), 2.0f, number());
        groom.root_normals.push_back(normal / std::sqrt(glm::dot(normal, normal)));
        for (std::uint32_t v = 0; v < vertices; ++v) {
            groom.points.push_back(point);
            point += glm::vec3(0.03f * number(), 0.02f, 0.03f * number());
        }
    }
    return groom;
}

}  // namespace hair::rendering
