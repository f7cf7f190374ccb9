#include "hair/simulation/head_motion.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>

#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/error.h"

namespace hair::simulation {

// ---- The head -----------------------------------------------------------------------------------

namespace {

struct Pose {
    glm::dvec3 rotation;  // deg
    glm::dvec3 translation;
};

Pose poseOf(const Keyframe& keyframe) { return {keyframe.rotation, keyframe.translation}; }

Pose operator+(const Pose& a, const Pose& b) {
    return {a.rotation + b.rotation, a.translation + b.translation};
}

Pose operator*(double factor, const Pose& pose) {
    return {factor * pose.rotation, factor * pose.translation};
}

// Mean motion between two keyframes.
struct Secant {
    double span;  // s
    Pose slope;  // change per s
};

Secant secant(const Keyframe& from, const Keyframe& to) {
    const double span = double{to.time} - double{from.time};
    return {span, (1.0 / span) * (poseOf(to) + -1.0 * poseOf(from))};
}

// Returns the weighted harmonic mean of two slopes; 0 if their signs differ.
double meanSlope(double before, double after, double weight_before, double weight_after) {
    if (before * after <= 0.0) return 0.0;
    return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

Pose meanSlope(const Secant& before, const Secant& after) {
    const double weight_before = before.span + 2.0 * after.span;
    const double weight_after = 2.0 * before.span + after.span;
    const auto mean = [&](const glm::dvec3& a, const glm::dvec3& b) {
        glm::dvec3 result;
        for (int i = 0; i < 3; ++i) result[i] = meanSlope(a[i], b[i], weight_before, weight_after);
        return result;
    };
    return {
        mean(before.slope.rotation, after.slope.rotation),
        mean(before.slope.translation, after.slope.translation)};
}

// Returns the slope at keyframe i, from its neighbours. A repeating motion continues after its last
// keyframe as after its first.
Pose slopeAt(const MotionSettings& settings, std::size_t i) {
    const auto& keys = settings.keyframes;
    const std::size_t last = keys.size() - 1;
    const bool at_end = i == 0 || i == last;
    if (at_end && !settings.repeat) return {glm::dvec3(0.0), glm::dvec3(0.0)};
    const std::size_t before = i == 0 ? last : i;
    const std::size_t after = i == last ? 0 : i;
    return meanSlope(secant(keys[before - 1], keys[before]), secant(keys[after], keys[after + 1]));
}

Pose hermite(
    const Pose& a, const Pose& slope_a, const Pose& b, const Pose& slope_b, double span, double s) {
    const double s2 = s * s;
    const double s3 = s2 * s;
    return (2.0 * s3 - 3.0 * s2 + 1.0) * a + span * (s3 - 2.0 * s2 + s) * slope_a +
           (3.0 * s2 - 2.0 * s3) * b + span * (s3 - s2) * slope_b;
}

Pose poseAt(const MotionSettings& settings, double time) {
    const auto& keys = settings.keyframes;
    const double first = keys.front().time;
    const double last = keys.back().time;
    if (settings.repeat && keys.size() > 1 && time > last)
        time = first + std::fmod(time - first, last - first);
    if (time <= first || keys.size() == 1) return poseOf(keys.front());
    if (time >= last) return poseOf(keys.back());
    std::size_t i = 0;
    while (time >= keys[i + 1].time) ++i;
    const double span = double{keys[i + 1].time} - double{keys[i].time};
    return hermite(
        poseOf(keys[i]), slopeAt(settings, i), poseOf(keys[i + 1]), slopeAt(settings, i + 1), span,
        (time - keys[i].time) / span);
}

}  // namespace

HeadMotion::HeadMotion(const MotionSettings& settings) : settings_(settings) {
    for (std::size_t i = 1; i < settings.keyframes.size(); ++i)
        if (settings.keyframes[i].time <= settings.keyframes[i - 1].time)
            throw engine::Error(
                "/simulation/motion/keyframes/" + std::to_string(i) + "/time",
                "is not after the previous keyframe");
}

Keyframe HeadMotion::keyframeAt(double time) const {
    if (settings_.keyframes.empty()) return {.time = static_cast<float>(time)};
    const Pose pose = poseAt(settings_, time);
    return {
        .time = static_cast<float>(time),
        .rotation = pose.rotation,
        .translation = pose.translation};
}

RigidMotion HeadMotion::at(double time) const {
    if (settings_.keyframes.empty()) return {};
    const Pose pose = poseAt(settings_, time);
    const glm::dvec3 angles = glm::radians(pose.rotation);
    const glm::dquat rotation = glm::angleAxis(angles.y, glm::dvec3{0.0, 1.0, 0.0}) *
                                glm::angleAxis(angles.x, glm::dvec3{1.0, 0.0, 0.0}) *
                                glm::angleAxis(angles.z, glm::dvec3{0.0, 0.0, 1.0});
    const glm::dvec3 pivot = settings_.pivot;
    return {rotation, pivot + pose.translation - rotation * pivot};
}

// ---- Skinned roots ------------------------------------------------------------------------------

namespace {

using engine::Access;

static_assert(sizeof(gpu::RigidFrame) == 28 && offsetof(gpu::RigidFrame, translation) == 16);

RigidMotion toMotion(const groom::SurfaceMotion& motion) {
    return {motion.rotation, motion.translation};
}

}  // namespace

RigidMotion operator*(const RigidMotion& after, const RigidMotion& before) {
    return {after.rotation * before.rotation, after(before.translation)};
}

SkinnedRoots::SkinnedRoots(
    const engine::Device& device, const groom::Groom& groom, const groom::DeformingMesh& mesh,
    std::uint32_t substeps)
    : mesh_(&mesh) {
    for (std::uint32_t i = 0; i < groom.strand_count; ++i)
        roots_.push_back(groom.strand(i).front());
    bindings_ = mesh.bind(roots_);
    frames_ = {device, rows(roots_.size(), substeps)["guide root frames"]};
}

std::vector<RigidMotion> SkinnedRoots::at(double time) const {
    std::vector<RigidMotion> motions;
    for (const groom::SurfaceMotion& motion : motionsAt(time)) motions.push_back(toMotion(motion));
    return motions;
}

std::span<const groom::SurfaceMotion> SkinnedRoots::motionsAt(double time) const {
    mesh_->motions(bindings_, time, work_.scratch, work_.motions);
    return work_.motions;
}

RigidMotion SkinnedRoots::meanAt(double time) const {
    return toMotion(groom::meanMotion(motionsAt(time), roots_));
}

std::span<const RigidMotion> SkinnedRoots::record(
    engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
    double to) const {
    work_.means.clear();
    work_.frames.clear();
    for (std::uint32_t i = 0; i <= substeps; ++i) {
        const double time = from + static_cast<double>(i) / substeps * (to - from);
        const RigidMotion carried = head.at(time);
        const auto motions = motionsAt(time);
        for (const groom::SurfaceMotion& motion : motions)
            work_.frames.push_back(toGpu(carried * toMotion(motion)));
        work_.means.push_back(carried * toMotion(groom::meanMotion(motions, roots_)));
    }
    const auto frames = std::as_bytes(std::span(work_.frames));
    assert(frames.size() <= frames_.size());
    commands.write(frames_, frames);
    return work_.means;
}

std::uint64_t SkinnedRoots::address(std::uint32_t substep) const {
    return frames_.address() + substep * roots_.size() * sizeof(gpu::RigidFrame);
}

}  // namespace hair::simulation
