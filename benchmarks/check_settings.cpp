#include "benchmarks/check_settings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace benchmarks {
namespace {

using hair::Settings;
using Broken = std::optional<std::string>;  // the reason, if the rule is broken

// Sine of the angle under which two directions count as parallel: a look-at matrix loses half of a
// float's digits there.
constexpr float kParallel = 1e-4f;

Broken hasGuides(const Settings& s) {
    if (!s.groom.file.empty() || !s.groom.grow.mesh.empty()) return {};
    return "is empty, and /groom/file too: there is nothing to take guides from";
}

Broken strandsHaveTwoEnds(const Settings& s) {
    if (s.groom.vertices != 1) return {};
    return "1 is neither 0 nor at least 2";
}

Broken groomHasStrandsOfItsOwn(const Settings& s) {
    if (s.strands.source != hair::StrandSource::groom || !s.groom.file.empty()) return {};
    return "is groom, but there is no /groom/file";
}

Broken partingHasLength(const Settings& s) {
    const hair::PartingSettings& parting = s.groom.grow.parting;
    if (parting.strength == 0.0f || parting.from != parting.to) return {};
    return "is where /groom/grow/parting/from is";
}

Broken windHasDirection(const Settings& s) {
    const hair::WindSettings& wind = s.simulation.wind;
    if (glm::length(wind.direction) > 0.0f) return {};
    if (wind.mode == hair::WindMode::thesis && wind.strength > 0.0f)
        return "has no length while /simulation/wind/strength is above 0";
    if (wind.mode == hair::WindMode::drag && wind.speed > 0.0f)
        return "has no length while /simulation/wind/speed is above 0";
    return {};
}

Broken keyframesAscend(const Settings& s) {
    const auto& keys = s.simulation.motion.keyframes;
    const auto late =
        std::ranges::adjacent_find(keys, std::ranges::greater_equal{}, &hair::Keyframe::time);
    if (late == keys.end()) return {};
    const auto index = late - keys.begin();
    return "entry " + std::to_string(index + 1) + " is not after entry " + std::to_string(index);
}

Broken pullKeysAscend(const Settings& s) {
    for (std::size_t i = 0; i < s.simulation.pulls.size(); ++i) {
        const auto& keys = s.simulation.pulls[i].path;
        const auto late =
            std::ranges::adjacent_find(keys, std::ranges::greater_equal{}, &hair::PullKey::time);
        if (late == keys.end()) continue;
        const auto index = late - keys.begin();
        return "entry " + std::to_string(i) + "'s path/" + std::to_string(index + 1) +
               " is not after path/" + std::to_string(index);
    }
    return {};
}

// Whether angles are whole turns apart, to a thousandth of a degree, which is what large ones are
// rounded to.
bool sameDirection(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::abs(std::remainder(double{a[i]} - double{b[i]}, 360.0)) > 1e-3) return false;
    return true;
}

Broken repeatedMotionCloses(const Settings& s) {
    const auto& keys = s.simulation.motion.keyframes;
    if (!s.simulation.motion.repeat || keys.empty()) return {};
    if (keys.front().translation == keys.back().translation &&
        sameDirection(keys.front().rotation, keys.back().rotation))
        return {};
    return "is set, but the last of the keyframes is not the pose of the first";
}

Broken lodDistancesAscend(const Settings& s) {
    if (s.lod.near_distance < s.lod.far_distance) return {};
    return "is not below /lod/far_distance";
}

Broken coverageIsSeen(const Settings& s) {
    if (s.render.coverage != hair::Coverage::analytic) return {};
    if (s.render.transparency != hair::Transparency::none) return {};
    return "is analytic, but /render/transparency is none";
}

Broken alphaHasSamplesToCover(const Settings& s) {
    if (s.render.transparency != hair::Transparency::alpha_to_coverage) return {};
    if (s.render.msaa > 1) return {};
    return "is alpha_to_coverage, but /render/msaa is 1";
}

Broken planesAscend(const Settings& s) {
    if (s.camera.near_plane < s.camera.far_plane) return {};
    return "is not below /camera/far_plane";
}

Broken cameraLooksSomewhere(const Settings& s) {
    if (s.camera.position != s.camera.target) return {};
    return "is where /camera/position is";
}

Broken upStandsOut(const Settings& s) {
    const float length = glm::length(s.camera.up);
    if (length == 0.0f) return "has no length";
    const glm::vec3 view = glm::normalize(s.camera.target - s.camera.position);
    if (glm::length(glm::cross(s.camera.up / length, view)) > kParallel) return {};
    return "is parallel to the view";
}

Broken busyWorkHasAPass(const Settings& s) {
    if (s.run.busy_work == 0 || !s.run.busy_pass.empty()) return {};
    return "is above 0, but /run/busy_pass is empty";
}

// A frame's passes are stamped one by one, and its stamps have room for so many steps.
constexpr float kMostStepsPerFrame = 200.0f;

Broken frameHasRoomForItsSteps(const Settings& s) {
    if (s.run.frame_time <= kMostStepsPerFrame * s.simulation.time_step) return {};
    return "is more than 200 of /simulation/time_step";
}

Broken lightsHaveDirections(const Settings& s) {
    for (std::size_t i = 0; i < s.shading.lights.size(); ++i) {
        const hair::LightSettings& light = s.shading.lights[i];
        if (light.type == hair::LightType::directional && glm::length(light.direction) == 0.0f)
            return "entry " + std::to_string(i) +
                   " is directional, but its direction has no length";
    }
    return {};
}

struct Rule {
    const char* pointer;
    Broken (*broken)(const Settings&);
};

constexpr Rule kRules[] = {
    {"/groom/grow/mesh", hasGuides},
    {"/groom/vertices", strandsHaveTwoEnds},
    {"/groom/grow/parting/to", partingHasLength},
    {"/strands/source", groomHasStrandsOfItsOwn},
    {"/simulation/wind/direction", windHasDirection},
    {"/simulation/motion/keyframes", keyframesAscend},
    {"/simulation/pulls", pullKeysAscend},
    {"/simulation/motion/repeat", repeatedMotionCloses},
    {"/lod/near_distance", lodDistancesAscend},
    {"/camera/near_plane", planesAscend},
    {"/camera/target", cameraLooksSomewhere},
    {"/camera/up", upStandsOut},
    {"/render/coverage", coverageIsSeen},
    {"/render/transparency", alphaHasSamplesToCover},
    {"/shading/lights", lightsHaveDirections},
    {"/run/busy_work", busyWorkHasAPass},
    {"/run/frame_time", frameHasRoomForItsSteps}};

}  // namespace

void checkSettings(const Settings& settings) {
    for (const Rule& rule : kRules)
        if (const Broken reason = rule.broken(settings)) throw engine::Error(rule.pointer, *reason);
}

}  // namespace benchmarks
