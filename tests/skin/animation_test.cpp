#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "engine/error.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/skin/animated_gltf.h"
#include "tests/skin/bending_sheet.h"

// Expected values are computed by hand from glTF 2.0's formulas, in the comments beside them.
namespace hair::groom {
namespace {

std::vector<glm::dvec3> positionsAt(const MeshAnimation& animation, double time) {
    MeshAnimation::Pose pose;
    animation.poseAt(time, pose);
    std::vector<glm::dvec3> positions;
    animation.positions(pose, positions);
    return positions;
}

using testing::ElementsAre;
using testing::HasSubstr;

// Numbers in the file are floats up to 2, and some are multiplied.
constexpr double kRounding = 1e-6;

const std::string kChannel = R"("channels":[{"sampler":0,"target":{"node":0,"path":)";

std::string sampler(int times, int values, const std::string& interpolation) {
    return R"("samplers":[{"input":)" + std::to_string(times) + R"(,"output":)" +
           std::to_string(values) + R"(,"interpolation":")" + interpolation + R"("}])";
}

// A triangle with an animation of its node.
struct Moved {
    AnimatedGltf file;
    Moved() {
        file.primitive = R"("attributes":{"POSITION":)" +
                         std::to_string(file.vectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) + "}";
        file.nodes = R"({"mesh":0})";
    }
    void animate(
        const std::string& path, const std::vector<float>& times, int values,
        const std::string& interpolation) {
        file.animations = R"({"name":"play",)" + kChannel + '"' + path + R"("}}],)" +
                          sampler(file.scalars(times), values, interpolation) + "}";
    }
    std::vector<glm::dvec3> at(double time) const {
        const TemporaryFolder folder;
        const MeshAnimation animation(file.write(folder), "play");
        return positionsAt(animation, time);
    }
    std::string error() const {
        const TemporaryFolder folder;
        const auto path = file.write(folder);
        return errorText([&] { MeshAnimation(path, "play"); });
    }
};

void expectNear(const glm::dvec3& found, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(found, expected), kRounding)
        << found.x << ' ' << found.y << ' ' << found.z;
}

TEST(MeshAnimation, MovesBetweenKeyframesInAStraightLine) {
    Moved moved;
    moved.animate(
        "translation", {0.5f, 1.5f}, moved.file.vectors({{0, 0, 0}, {2, 4, 0}}), "LINEAR");
    expectNear(moved.at(0.0)[1], {1, 0, 0});  // the first keyframe holds before its time
    expectNear(moved.at(0.75)[1], {1.5, 1, 0});  // a quarter of the way
    expectNear(moved.at(9.0)[1], {3, 4, 0});
}

TEST(MeshAnimation, StaysAtAStepUntilTheNext) {
    Moved moved;
    moved.animate("translation", {0.0f, 1.0f}, moved.file.vectors({{0, 0, 0}, {2, 4, 0}}), "STEP");
    expectNear(moved.at(0.999)[1], {1, 0, 0});
    expectNear(moved.at(1.0)[1], {3, 4, 0});
}

// The keyframes are 2 s apart, with values 0 and 1 and slopes 0.5 / s after the first and 0.25 / s
// before the second. In the middle p = 1/2 p0 + 2 (1/8) m0 + 1/2 p1 - 2 (1/8) m1
// = 0.5 + 0.125 - 0.0625.
TEST(MeshAnimation, FollowsACubicSpline) {
    Moved moved;
    const int values = moved.file.vectors(
        {{9, 9, 9}, {0, 0, 0}, {0.5f, 0, 0}, {0.25f, 0, 0}, {1, 0, 0}, {9, 9, 9}});
    moved.animate("translation", {0.0f, 2.0f}, values, "CUBICSPLINE");
    expectNear(moved.at(1.0)[0], {0.5625, 0, 0});
    expectNear(moved.at(2.0)[0], {1, 0, 0});
}

TEST(MeshAnimation, TurnsEvenlyTheShorterWay) {
    Moved moved;
    const auto half = static_cast<float>(std::sqrt(0.5));
    // Turns by 90 degrees about z. The quaternion has the opposite sign.
    const int values = moved.file.rotations({{0, 0, 0, 1}, {0, 0, -half, -half}});
    moved.animate("rotation", {0.0f, 1.0f}, values, "LINEAR");
    const double angle = std::numbers::pi / 6.0;  // a third of the way
    expectNear(moved.at(1.0 / 3.0)[1], {std::cos(angle), std::sin(angle), 0});
    expectNear(moved.at(1.0)[1], {0, 1, 0});
}

TEST(MeshAnimation, ScalesBeforeItTurnsAndMoves) {
    Moved moved;
    const auto half = static_cast<float>(std::sqrt(0.5));
    moved.file.nodes = R"({"mesh":0,"translation":[10,0,0],"rotation":[0,0,)" +
                       std::to_string(half) + "," + std::to_string(half) + "]}";
    moved.animate("scale", {0.0f}, moved.file.vectors({{3, 1, 1}}), "LINEAR");
    const glm::dvec3 found = moved.at(0.0)[1];
    // (1, 0, 0) becomes (3, 0, 0), (0, 3, 0), (10, 3, 0). to_string() has six digits.
    EXPECT_LT(glm::distance(found, glm::dvec3(10, 3, 0)), 1e-5);
}

// One target moves the second vertex by (0, 0, 1). Another, sparse one moves it by (0, 2, 0).
TEST(MeshAnimation, AddsMorphTargets) {
    Moved moved;
    const int first = moved.file.vectors({{0, 0, 0}, {0, 0, 1}, {0, 0, 0}});
    const int second = moved.file.sparseVectors(3, {1}, {{0, 2, 0}});
    moved.file.primitive += R"(,"targets":[{"POSITION":)" + std::to_string(first) +
                            R"(},{"POSITION":)" + std::to_string(second) + "}]";
    moved.animate("weights", {0.0f, 1.0f}, moved.file.scalars({0, 0, 1, 0.5f}), "LINEAR");
    expectNear(moved.at(0.5)[1], {1, 0.5, 0.5});
    expectNear(moved.at(1.0)[1], {1, 1, 1});
    expectNear(moved.at(1.0)[0], {0, 0, 0});
}

TEST(MeshAnimation, KeepsTheFilesWeightsWhereNothingAnimatesThem) {
    Moved moved;
    const int target = moved.file.vectors({{0, 0, 4}, {0, 0, 4}, {0, 0, 4}});
    moved.file.primitive += R"(,"targets":[{"POSITION":)" + std::to_string(target) + "}]";
    moved.file.mesh = R"(,"weights":[0.25])";
    moved.animate("translation", {0.0f}, moved.file.vectors({{1, 0, 0}}), "LINEAR");
    expectNear(moved.at(0.0)[0], {1, 0, 1});
}

TEST(MeshAnimation, BlendsJoints) {
    const TemporaryFolder folder;
    const MeshAnimation animation(BendingSheet::write(folder), "play");
    EXPECT_NEAR(animation.duration(), BendingSheet::kTime, kRounding);
    for (const double time : {0.0, 0.1, 0.25, 0.4, 1.0}) {
        const auto found = positionsAt(animation, time);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const int along = static_cast<int>(i) / (BendingSheet::kAcross + 1);
            const int across = static_cast<int>(i) % (BendingSheet::kAcross + 1);
            // Positions are floats of the sheet's size, 0.16 m.
            EXPECT_LT(glm::distance(found[i], BendingSheet::vertexAt(along, across, time)), 1e-7);
        }
    }
}

TEST(MeshAnimation, NamesWhatThereIs) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    EXPECT_THAT(animationNames(path), ElementsAre("play", "still"));
    EXPECT_THAT(
        errorText([&] { MeshAnimation(path, "walk"); }),
        HasSubstr("has no animation 'walk'; known: 'play', 'still'"));
}

TEST(MeshAnimation, RefusesWhatCannotBeRight) {
    {
        Moved moved;
        moved.animate("translation", {1.0f, 0.5f}, moved.file.vectors({{}, {}}), "LINEAR");
        EXPECT_THAT(
            moved.error(), HasSubstr("the time of keyframe 1 is not after the previous one"));
    }
    {
        Moved moved;
        moved.animate("translation", {0.0f, 0.5f}, moved.file.vectors({{}}), "LINEAR");
        EXPECT_THAT(moved.error(), HasSubstr("has 3 numbers for 2 keyframes, not 6"));
    }
    {
        Moved moved;
        moved.animate("translation", {0.0f}, moved.file.vectors({{NAN, 0, 0}}), "LINEAR");
        EXPECT_THAT(moved.error(), HasSubstr("has a number that is not finite"));
    }
    {
        Moved moved;
        moved.animate("rotation", {0.0f}, moved.file.rotations({{0, 0, 0, 0}}), "LINEAR");
        EXPECT_THAT(moved.error(), HasSubstr("is not a unit quaternion"));
    }
    {
        Moved moved;
        moved.animate("translation", {0.0f}, moved.file.vectors({{}}), "SMOOTH");
        EXPECT_THAT(moved.error(), HasSubstr("unknown interpolation 'SMOOTH'"));
    }
    {
        Moved moved;
        moved.animate("weights", {0.0f}, moved.file.scalars({0}), "LINEAR");
        EXPECT_THAT(moved.error(), HasSubstr("a mesh without morph targets"));
    }
}

std::string skinError(const glm::u8vec4& joints, const glm::vec4& weights) {
    Moved moved;
    moved.file.primitive = R"("attributes":{"POSITION":0,"JOINTS_0":)" +
                           std::to_string(moved.file.joints({joints, joints, joints})) +
                           R"(,"WEIGHTS_0":)" +
                           std::to_string(moved.file.rotations({weights, weights, weights})) + "}";
    moved.file.nodes = R"({"mesh":0,"skin":0,"children":[1]},{})";
    moved.file.skin = R"("joints":[1])";
    moved.animate("translation", {0.0f}, moved.file.vectors({{}}), "LINEAR");
    return moved.error();
}

TEST(MeshAnimation, RefusesWrongSkins) {
    EXPECT_EQ(skinError({0, 0, 0, 0}, {1, 0, 0, 0}), "no error");
    EXPECT_THAT(
        skinError({0, 0, 0, 0}, {0.5f, 0.4f, 0, 0}), HasSubstr("of vertex 0 add up to 0.9"));
    EXPECT_THAT(
        skinError({1, 0, 0, 0}, {1, 0, 0, 0}), HasSubstr("names a joint outside the skin's 1"));
    EXPECT_THAT(skinError({0, 0, 0, 0}, {2, -1, 0, 0}), HasSubstr("has a negative weight"));
}

// Changes each byte of a file in turn, or cuts the file there. The reader refuses the result with
// an error or returns the stated number of vertices.
TEST(MeshAnimation, RefusesOrPlaysDamagedFiles) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    std::ifstream stream(path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    int refused = 0;
    const auto play = [&](const std::string& bytes) {
        const auto damaged = folder.write("damaged.glb", bytes);
        try {
            const MeshAnimation animation(damaged, "play");
            EXPECT_EQ(positionsAt(animation, 0.1).size(), animation.vertexCount());
        } catch (const engine::Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("damaged.glb: "));
            ++refused;
        }
    };
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string flipped = whole;
        flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
        play(flipped);
    }
    EXPECT_GT(refused, 0);
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        refused = 0;
        play(whole.substr(0, size));
        EXPECT_EQ(refused, 1) << size << " bytes";
    }
}

// ---- Triangles ----------------------------------------------------------------------------------

SurfaceBinding bindingOf(const TemporaryFolder& folder, const glm::vec3& point) {
    Moved moved;
    moved.animate("translation", {0.0f}, moved.file.vectors({{}}), "LINEAR");
    const auto path = moved.file.write(folder);
    const DeformingMesh mesh(importMesh(path), MeshAnimation(path, "play"), {});
    return mesh.bind(std::vector{point}).front();
}

// The triangle is (0,0,0), (1,0,0), (0,1,0), and the point is 0.5 above (0.25, 0.5, 0).
TEST(SurfaceMotion, FollowsATriangleThatMovesRigidly) {
    const TemporaryFolder folder;
    const SurfaceBinding binding = bindingOf(folder, {0.25f, 0.5f, 0.5f});
    // Turns by 90 degrees about x, (x, y, z) -> (x, -z, y), then moves by 3 along x.
    const SurfaceMotion motion =
        motionOf(binding, {glm::dvec3{3, 0, 0}, glm::dvec3{4, 0, 0}, glm::dvec3{3, 0, 1}});
    expectNear(motion(glm::dvec3{0.25, 0.5, 0.5}), {3.25, -0.5, 0.5});
    expectNear(motion(glm::dvec3{1, 2, 3}), {4, -3, 2});
}

// A stretch along x does not turn the triangle, whichever corner is the first. For a shear
// (x + s y, y), the polar decomposition has a rotation by -atan(s / 2).
TEST(SurfaceMotion, TurnsAsPolarDecompositionSays) {
    const TemporaryFolder folder;
    const SurfaceBinding binding = bindingOf(folder, {0.25f, 0.25f, 0.0f});
    const SurfaceMotion stretched =
        motionOf(binding, {glm::dvec3{0, 0, 0}, glm::dvec3{5, 0, 0}, glm::dvec3{0, 1, 0}});
    EXPECT_NEAR(std::abs(stretched.rotation.w), 1.0, 1e-12);
    expectNear(stretched(glm::dvec3{0.25, 0.25, 0}), {1.25, 0.25, 0});
    const double s = 0.8;
    const SurfaceMotion sheared =
        motionOf(binding, {glm::dvec3{0, 0, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{s, 1, 0}});
    const glm::dvec3 turned = sheared.rotation * glm::dvec3{1, 0, 0};
    EXPECT_NEAR(std::atan2(turned.y, turned.x), -std::atan(s / 2.0), 1e-12);
    EXPECT_NEAR(turned.z, 0.0, 1e-12);
}

TEST(SurfaceMotion, OfATriangleWithoutAreaDoesNotTurn) {
    const TemporaryFolder folder;
    const SurfaceBinding binding = bindingOf(folder, {0.25f, 0.25f, 0.0f});
    const SurfaceMotion motion =
        motionOf(binding, {glm::dvec3{1, 1, 1}, glm::dvec3{1, 1, 1}, glm::dvec3{1, 1, 1}});
    expectNear(motion(glm::dvec3{0.25, 0.25, 0}), {1, 1, 1});
    EXPECT_EQ(motion.rotation.w, 1.0);
}

TEST(SurfaceMotion, MeanOfEqualMotionsIsThatMotion) {
    const glm::dquat rotation = glm::angleAxis(2.5, glm::normalize(glm::dvec3{1, 2, -2}));
    const SurfaceMotion one{rotation, {0.1, 0.2, 0.3}};
    const SurfaceMotion other{-rotation, {0.1, 0.2, 0.3}};  // the same rotation
    const SurfaceMotion mean =
        meanMotion(std::vector{one, other, one}, std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}, {}});
    expectNear(mean(glm::dvec3{3, 4, 5}), one(glm::dvec3{3, 4, 5}));
}

TEST(DeformingMesh, RepeatsOrStopsAndKeepsItsSpeed) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const Mesh mesh = importMesh(path);
    const auto last = [&](const AnimationSettings& settings, double time) {
        return DeformingMesh(mesh, MeshAnimation(path, "play"), settings).positions(time).back();
    };
    const auto expected = [](double time) {
        return BendingSheet::vertexAt(BendingSheet::kAlong, BendingSheet::kAcross, time);
    };
    expectNear(last({.speed = 2.0f, .repeat = false}, 0.1), expected(0.2));
    expectNear(last({.speed = 1.0f, .repeat = false}, 5.0), expected(BendingSheet::kTime));
    expectNear(last({.speed = 1.0f, .repeat = true}, 0.5), expected(0.1));
}

// The whole sheet turns by 90 degrees. Normals turn with it and keep their length.
TEST(DeformingMesh, TurnsNormalsAsTheSurface) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const DeformingMesh mesh(importMesh(path), MeshAnimation(path, "play"), {});
    std::vector<glm::dvec3> turned;
    for (const glm::vec3& rest : mesh.restPositions()) turned.emplace_back(rest.x, -rest.z, rest.y);
    for (const glm::vec3& normal : mesh.normals(turned)) expectNear(glm::dvec3(normal), {0, 0, 1});
}

}  // namespace
}  // namespace hair::groom
