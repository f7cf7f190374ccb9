#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "tests/skin/animated_gltf.h"

// A bending sheet of 8 x 4 squares of 2 cm in the plane y = 0. The weight of its second joint grows
// along x from 0 to 1. This joint, at x = 4 cm, turns evenly about z from 0 to 60 degrees in 0.4 s,
// so the sheet also shears and shrinks. Its motion is known in closed form.
struct BendingSheet {
    static constexpr int kAlong = 8;
    static constexpr int kAcross = 4;
    static constexpr double kSquare = 0.02;  // m
    static constexpr double kHinge = 0.04;  // x of the second joint, m
    static constexpr double kTime = 0.4;  // s
    static constexpr double kTurn = std::numbers::pi / 3.0;

    static glm::vec3 restVertex(int along, int across) {
        return {kSquare * along, 0.0, kSquare * across};
    }
    static double weight(int along) { return static_cast<double>(along) / kAlong; }

    // Position of a vertex by linear blend skinning: Magnenat-Thalmann, Laperriere and Thalmann
    // 1988.
    static glm::dvec3 vertexAt(int along, int across, double time) {
        const double angle = kTurn * std::clamp(time / kTime, 0.0, 1.0);
        const glm::dvec3 rest(restVertex(along, across));
        const double w = static_cast<double>(static_cast<float>(weight(along)));
        const glm::dvec3 turned{
            kHinge + std::cos(angle) * (rest.x - kHinge) - std::sin(angle) * rest.y,
            std::sin(angle) * (rest.x - kHinge) + std::cos(angle) * rest.y, rest.z};
        return (1.0 - w) * rest + w * turned;
    }

    // A point in the first triangle of a square, with its barycentric weights for the corners
    // (along, across), (along, across + 1) and (along + 1, across).
    struct Place {
        int along, across;
        glm::dvec3 weights;

        glm::dvec3 at(double time) const {
            return weights.x * vertexAt(along, across, time) +
                   weights.y * vertexAt(along, across + 1, time) +
                   weights.z * vertexAt(along + 1, across, time);
        }
    };

    // Returns one root in each square.
    static std::vector<Place> places() {
        std::vector<Place> places;
        for (int along = 0; along < kAlong; ++along)
            for (int across = 0; across < kAcross; ++across) {
                const double u = 0.15 + 0.06 * along;
                const double v = 0.1 + 0.05 * across;
                places.push_back({along, across, {1.0 - u - v, v, u}});
            }
        return places;
    }

    // Returns slightly bent strands on these roots.
    static hair::groom::Groom groom(std::uint32_t vertices = 8) {
        const std::vector<Place> roots = places();
        hair::groom::Groom groom{
            .strand_count = static_cast<std::uint32_t>(roots.size()),
            .vertices_per_strand = vertices};
        for (const Place& root : roots)
            for (std::uint32_t v = 0; v < vertices; ++v)
                groom.points.emplace_back(
                    root.at(0.0) + glm::dvec3(0.0004 * v * v, 0.01 * v, 0.0002 * v * v));
        return groom;
    }

    enum class Clips { bend, still };

    // Writes the sheet with two animations: "play" bends it, "still" does not move it.
    static std::filesystem::path write(const TemporaryFolder& folder) {
        AnimatedGltf file;
        std::vector<glm::vec3> positions;
        std::vector<glm::u8vec4> joints;
        std::vector<glm::vec4> weights;
        std::vector<std::uint32_t> indices;
        for (int along = 0; along <= kAlong; ++along)
            for (int across = 0; across <= kAcross; ++across) {
                positions.push_back(restVertex(along, across));
                joints.emplace_back(0, 1, 0, 0);
                const auto w = static_cast<float>(weight(along));
                weights.emplace_back(1.0f - w, w, 0.0f, 0.0f);
            }
        const auto vertex = [](int along, int across) {
            return static_cast<std::uint32_t>(along * (kAcross + 1) + across);
        };
        for (int along = 0; along < kAlong; ++along)
            for (int across = 0; across < kAcross; ++across)
                for (const std::uint32_t corner :
                     {vertex(along, across), vertex(along, across + 1), vertex(along + 1, across),
                      vertex(along + 1, across), vertex(along, across + 1),
                      vertex(along + 1, across + 1)})
                    indices.push_back(corner);
        const auto text = [](int number) { return std::to_string(number); };
        file.primitive = R"("attributes":{"POSITION":)" + text(file.vectors(positions)) +
                         R"(,"JOINTS_0":)" + text(file.joints(joints)) + R"(,"WEIGHTS_0":)" +
                         text(file.rotations(weights)) + R"(},"indices":)" +
                         text(file.indices(indices));
        file.nodes = R"({"mesh":0,"skin":0,"children":[1,2]},{},{"translation":[0.04,0,0]})";
        std::array<float, 16> none{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        std::array<float, 16> hinge = none;
        hinge[12] = -0.04f;
        file.skin = R"("joints":[1,2],"inverseBindMatrices":)" + text(file.matrices({none, hinge}));
        const auto half = static_cast<float>(kTurn / 2.0);
        const int times = file.scalars({0.0f, static_cast<float>(kTime)});
        const int turn = file.rotations({{0, 0, 0, 1}, {0, 0, std::sin(half), std::cos(half)}});
        const int still = file.rotations({{0, 0, 0, 1}, {0, 0, 0, 1}});
        const auto clip = [&](const std::string& name, int values) {
            return R"({"name":")" + name +
                   R"(","channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}}],)"
                   R"("samplers":[{"input":)" +
                   text(times) + R"(,"output":)" + text(values) + "}]}";
        };
        file.animations = clip("play", turn) + "," + clip("still", still);
        return file.write(folder);
    }
};
