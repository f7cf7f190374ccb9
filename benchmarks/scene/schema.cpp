#include "benchmarks/scene/schema.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "hair/fields.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/lights.h"
#include "hair/settings.h"

namespace benchmarks::scene {
namespace {

// ---- Rules between fields -----------------------------------------------------------------------

using Broken = std::optional<std::string>;  // the reason, if the rule is broken

// Directions count as parallel below this sine of their angle: a look-at matrix then loses half of
// a float's digits.
constexpr float kParallel = 1e-4f;

Broken hasGuides(const hair::Settings& s) {
    if (!s.groom.file.empty() || !s.groom.grow.mesh.empty()) return {};
    return "is empty, and so is /groom/file: guides need one of them";
}

Broken strandsHaveTwoEnds(const hair::Settings& s) {
    if (s.groom.vertices != 1) return {};
    return "1 is neither 0 nor at least 2";
}

Broken groomHasStrandsOfItsOwn(const hair::Settings& s) {
    if (s.strands.source != hair::StrandSource::groom || !s.groom.file.empty()) return {};
    if (s.groom.grow.strands > 0) return {};
    return "is groom, but neither /groom/file nor /groom/grow/strands is set";
}

Broken partingHasLength(const hair::Settings& s) {
    const hair::PartingSettings& parting = s.groom.grow.parting;
    if (parting.strength == 0.0f || parting.from != parting.to) return {};
    return "equals /groom/grow/parting/from";
}

Broken windHasDirection(const hair::Settings& s) {
    const hair::WindSettings& wind = s.simulation.wind;
    if (glm::length(wind.direction) > 0.0f) return {};
    if (wind.mode == hair::WindMode::thesis && wind.strength > 0.0f)
        return "is zero, but /simulation/wind/strength is above 0";
    if (wind.mode == hair::WindMode::drag && wind.speed > 0.0f)
        return "is zero, but /simulation/wind/speed is above 0";
    return {};
}

Broken solverHasBalancedRest(const hair::Settings& s) {
    if (s.simulation.rest != hair::RestShape::balanced) return {};
    switch (s.simulation.solver) {
    case hair::Solver::none:
    case hair::Solver::shape:
    case hair::Solver::rod:
        return {};
    default:
        return "is balanced, which only the solvers shape and rod support";
    }
}

Broken solverHasEllipticSections(const hair::Settings& s) {
    switch (s.simulation.solver) {
    case hair::Solver::stable_cosserat:
    case hair::Solver::position_based_rod:
    case hair::Solver::augmented_mass_spring:
        if (s.simulation.material.ellipticity == 1.0f) return {};
        return "is not 1, but of the rod solvers only rod supports elliptic cross-sections";
    default:
        return {};
    }
}

Broken solverCarriesContact(const hair::Settings& s) {
    if (!s.simulation.collision.warm_start) return {};
    if (s.simulation.solver != hair::Solver::rod)
        return "is on, but only the solver rod carries contact forces from one substep to the next";
    if (s.simulation.rod.integrator != hair::RodIntegrator::implicit_euler)
        return "is on, but only the integrator implicit_euler carries contact forces from one "
               "substep to the next";
    return {};
}

Broken solverKeepsSegmentsOut(const hair::Settings& s) {
    if (s.simulation.collision.parts == hair::CollisionParts::vertices) return {};
    switch (s.simulation.solver) {
    case hair::Solver::stable_cosserat:
    case hair::Solver::position_based_rod:
    case hair::Solver::augmented_mass_spring:
        return "is segments, which only the solvers shape, ftl and rod support";
    default:
        if (s.simulation.collision.warm_start)
            return "is segments, but warm_start carries only the contact forces of vertices";
        return {};
    }
}

Broken keyframesAscend(const hair::Settings& s) {
    const auto& keys = s.simulation.motion.keyframes;
    const auto late =
        std::ranges::adjacent_find(keys, std::ranges::greater_equal{}, &hair::Keyframe::time);
    if (late == keys.end()) return {};
    const auto index = late - keys.begin();
    return "entry " + std::to_string(index + 1) + " is not after entry " + std::to_string(index);
}

Broken pullKeysAscend(const hair::Settings& s) {
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

// Whether all angles differ by whole turns, to a thousandth of a degree, the rounding of large
// angles.
bool sameDirection(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::abs(std::remainder(double{a[i]} - double{b[i]}, 360.0)) > 1e-3) return false;
    return true;
}

Broken repeatedMotionCloses(const hair::Settings& s) {
    const auto& keys = s.simulation.motion.keyframes;
    if (!s.simulation.motion.repeat || keys.empty()) return {};
    if (keys.front().translation == keys.back().translation &&
        sameDirection(keys.front().rotation, keys.back().rotation))
        return {};
    return "is on, but the last keyframe does not have the pose of the first";
}

Broken lodDistancesAscend(const hair::Settings& s) {
    if (s.lod.near_distance < s.lod.far_distance) return {};
    return "is not below /lod/far_distance";
}

Broken coverageIsSeen(const hair::Settings& s) {
    if (s.render.coverage != hair::Coverage::analytic) return {};
    if (s.render.transparency != hair::Transparency::none) return {};
    return "is analytic, but /render/transparency is none";
}

Broken alphaHasSamplesToCover(const hair::Settings& s) {
    if (s.render.transparency != hair::Transparency::alpha_to_coverage) return {};
    if (s.render.msaa > 1) return {};
    return "is alpha_to_coverage, but /render/msaa is 1";
}

Broken planesAscend(const hair::Settings& s) {
    if (s.camera.near_plane < s.camera.far_plane) return {};
    return "is not below /camera/far_plane";
}

Broken cameraLooksSomewhere(const hair::Settings& s) {
    if (s.camera.position != s.camera.target) return {};
    return "equals /camera/position";
}

Broken upStandsOut(const hair::Settings& s) {
    const float length = glm::length(s.camera.up);
    if (length == 0.0f) return "is zero";
    const glm::vec3 view = glm::normalize(s.camera.target - s.camera.position);
    if (glm::length(glm::cross(s.camera.up / length, view)) > kParallel) return {};
    return "is parallel to the view";
}

Broken busyWorkHasAPass(const hair::Settings& s) {
    if (s.run.busy_work == 0 || !s.run.busy_pass.empty()) return {};
    return "is above 0, but /run/busy_pass is empty";
}

Broken timestampsAreOfOneQueue(const hair::Settings& s) {
    if (!s.run.async_compute || !s.run.overlapped_stamps) return {};
    return "is on, but so is /run/async_compute: passes on two queues have no common order";
}

// Each pass of a frame has timestamps, and there is only room for this many steps per frame.
constexpr float kMostStepsPerFrame = 200.0f;

Broken frameHasRoomForItsSteps(const hair::Settings& s) {
    if (s.run.frame_time <= kMostStepsPerFrame * s.simulation.time_step) return {};
    return "is more than 200 times /simulation/time_step";
}

Broken lightsHaveDirections(const hair::Settings& s) {
    for (std::size_t i = 0; i < s.shading.lights.size(); ++i) {
        const hair::LightSettings& light = s.shading.lights[i];
        if (glm::length(light.direction) > 0.0f) continue;
        const std::string entry = "entry " + std::to_string(i);
        if (light.type == hair::LightType::directional)
            return entry + " is directional, but its direction is zero";
        if (light.type == hair::LightType::rectangle)
            return entry + " is a rectangle, but its direction is zero";
    }
    return {};
}

Broken lightsHaveRoomForTheirMaps(const hair::Settings& s) {
    std::uint32_t further = 0;
    for (const hair::LightSettings& light : s.shading.lights)
        further += hair::rendering::shadowMaps(light) - 1;
    if (further <= hair::gpu::kMostFurtherMaps) return {};
    return "has " + std::to_string(further) +
           " shadow maps by shadow_samples besides one per light; at most " +
           std::to_string(hair::gpu::kMostFurtherMaps) + " are permitted";
}

struct Rule {
    const char* pointer;
    Broken (*broken)(const hair::Settings&);
};

constexpr Rule kRules[] = {
    {"/groom/grow/mesh", hasGuides},
    {"/groom/vertices", strandsHaveTwoEnds},
    {"/groom/grow/parting/to", partingHasLength},
    {"/strands/source", groomHasStrandsOfItsOwn},
    {"/simulation/rest", solverHasBalancedRest},
    {"/simulation/material/ellipticity", solverHasEllipticSections},
    {"/simulation/collision/warm_start", solverCarriesContact},
    {"/simulation/collision/parts", solverKeepsSegmentsOut},
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
    {"/shading/lights", lightsHaveRoomForTheirMaps},
    {"/run/busy_work", busyWorkHasAPass},
    {"/run/overlapped_stamps", timestampsAreOfOneQueue},
    {"/run/frame_time", frameHasRoomForItsSteps}};

}  // namespace

void checkSettings(const hair::Settings& settings) {
    for (const Rule& rule : kRules)
        if (const Broken reason = rule.broken(settings)) throw engine::Error(rule.pointer, *reason);
}

namespace {

// ---- JSON Schema --------------------------------------------------------------------------------

// Whether null may stand for a member. Not inside a list, because a merge patch replaces lists as a
// whole.
enum class Removal { possible, impossible };

Json objectSchema(hair::SettingsView defaults, Removal removal);

std::string helpWithUnit(const char* help, std::string_view unit) {
    return unit == "1" ? help : std::string(help) + " [" + std::string(unit) + ']';
}

Json numberSchema(const char* type, const hair::Range& range) {
    return {
        {"type", type},
        {"minimum", cleanNumber(range.minimum)},
        {"maximum", cleanNumber(range.maximum)}};
}

template <class Value>
Json fieldSchema(const char* help, const hair::Number<Value>& row, hair::SettingsView) {
    Json schema = {{"description", helpWithUnit(help, row.unit)}};
    schema.update(numberSchema(std::is_integral_v<Value> ? "integer" : "number", row));
    return schema;
}

Json fieldSchema(const char* help, const hair::Number<glm::vec3>& row, hair::SettingsView) {
    return {
        {"description", helpWithUnit(help, row.unit)},
        {"type", "array"},
        {"items", numberSchema("number", row)},
        {"minItems", 3},
        {"maxItems", 3}};
}

Json fieldSchema(const char* help, const hair::OneOf& row, hair::SettingsView) {
    return {{"description", helpWithUnit(help, row.unit)}, {"enum", row.values}};
}

Json fieldSchema(const char* help, const hair::Text&, hair::SettingsView) {
    return {{"description", help}, {"type", "string"}};
}

Json fieldSchema(const char* help, const hair::Toggle&, hair::SettingsView) {
    return {{"description", help}, {"type", "boolean"}};
}

Json fieldSchema(const char* help, const hair::Choice& row, hair::SettingsView) {
    Json names = Json::array();
    for (const auto& named : row.names) names.push_back(named.name);
    return {{"description", help}, {"enum", names}};
}

Json fieldSchema(const char* help, const hair::ChoiceOrFile& row, hair::SettingsView defaults) {
    const Json names = fieldSchema(help, static_cast<const hair::Choice&>(row), defaults)["enum"];
    const Json file = {
        {"type", "string"}, {"pattern", std::string("\\") + hair::ChoiceOrFile::kExtension + '$'}};
    return {{"description", help}, {"anyOf", {{{"enum", names}}, file}}};
}

// Another field names a file, which declares the members.
Json fieldSchema(const char* help, const hair::Parameters&, hair::SettingsView) {
    const Json number = {{"type", "number"}};
    const Json vector = {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
    return {
        {"description", help},
        {"type", "object"},
        {"additionalProperties", {{"anyOf", {number, vector, {{"type", "null"}}}}}}};
}

Json fieldSchema(const char* help, const hair::Group& row, hair::SettingsView defaults) {
    Json schema = {{"description", help}};
    schema.update(objectSchema(row.in(defaults), Removal::possible));
    return schema;
}

Json fieldSchema(const char* help, const hair::List& row, hair::SettingsView) {
    return {
        {"description", help},
        {"type", "array"},
        {"items", objectSchema(row.newElement(), Removal::impossible)},
        {"maxItems", row.maximum_count}};
}

void allowNull(Json& schema) {
    if (schema.contains("enum"))
        schema["enum"].push_back(nullptr);
    else if (schema.contains("anyOf"))
        schema["anyOf"].push_back({{"type", "null"}});
    else
        schema["type"] = Json::array({schema["type"], "null"});
}

Json objectSchema(hair::SettingsView defaults, Removal removal) {
    const Json values = writeFields(defaults);
    Json members = Json::object();
    for (const hair::Field& field : defaults.fields()) {
        Json schema = std::visit(
            [&](const auto& row) { return fieldSchema(field.help, row, defaults); }, field.kind);
        if (removal == Removal::possible) allowNull(schema);
        const Json& value = values.at(field.name);
        if (!value.is_object()) schema["default"] = value;
        members[field.name] = std::move(schema);
    }
    return {
        {"type", "object"}, {"additionalProperties", false}, {"properties", std::move(members)}};
}

// Adds an axis for every field, so that editors know its values. The scene reader checks other
// pointers (to a group or an element).
void addAxes(
    const Json& members, const std::string& pointer, const std::string& schema_pointer,
    Json& axes) {
    for (const auto& [name, schema] : members.items()) {
        const std::string here = pointer + '/' + name;
        const std::string there = schema_pointer + "/properties/" + name;
        if (schema.contains("properties"))
            addAxes(schema["properties"], here, there, axes);
        else
            axes[here] = {
                {"type", {"array", "null"}},
                {"minItems", 1},
                {"uniqueItems", true},
                {"items", {{"$ref", "#" + there}}}};
    }
}

Json sweepSchema(const Json& members) {
    Json axes = Json::object();
    addAxes(members, "", "", axes);
    const auto rows = [](const char* description, const Json& field) {
        return Json{
            {"description", description},
            {"type", {"array", "null"}},
            {"items",
             {{"type", "object"},
              {"minProperties", 1},
              {"propertyNames", {{"pattern", "^/"}}},
              {"additionalProperties", field}}}};
    };
    const Json values = {{"type", "array"}, {"minItems", 1}};
    axes["zip"] = rows(
        "fields that change together: each object is one axis, and its fields all have the same "
        "number of values",
        values);
    axes["cases"] = rows(
        "one axis as a list of combinations: each object holds a value for all its fields", true);
    axes["exclude"] = rows(
        "combinations that are left out: those in which every field of an object has one of its "
        "values",
        values);
    return {
        {"description", "fields that vary: JSON pointer of a field -> its values; one case for "
                        "each combination, in the written order, the last axis fastest"},
        {"type", {"object", "null"}},
        {"propertyNames", {{"pattern", "^(/.*|zip|cases|exclude)$"}}},
        {"properties", std::move(axes)},
        {"additionalProperties", {{"type", {"array", "null"}}, {"minItems", 1}}}};
}

}  // namespace

std::string sceneSchema() {
    Json schema = {
        {"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "hairbench scene"}};
    schema.update(objectSchema(hair::Settings{}, Removal::possible));
    Json sweep = sweepSchema(schema["properties"]);
    Json& members = schema["properties"];
    members["$schema"] = {{"description", "this schema, for editors"}, {"type", "string"}};
    members["base"] = {
        {"description",
         "scene file, relative to this one, to which this document is applied as a JSON merge "
         "patch (RFC 7386): null removes a member of the base"},
        {"type", "string"}};
    members["sweep"] = std::move(sweep);
    members["suite"] = {
        {"description", "scene files, relative to this one, that are run one after another; only "
                        "$schema and description may stand beside it"},
        {"type", "array"},
        {"minItems", 1},
        {"items", {{"type", "string"}}}};
    return schema.dump(2) + '\n';
}

}  // namespace benchmarks::scene
