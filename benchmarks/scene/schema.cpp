#include "benchmarks/scene/schema.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "hair/fields.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/render_assets.h"

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

Broken groomsStrandsHaveTheirCurve(const hair::Settings& s) {
    if (s.strands.curve != hair::Curve::extension) return {};
    if (s.strands.source != hair::StrandSource::groom) return {};
    return "is a file, which draws strands between guides only: /strands/source is groom";
}

Broken cacheHasItsSolver(const hair::Settings& s) {
    if (s.groom.cache.mode == hair::CacheMode::none) return {};
    if (s.groom.file.empty()) return "is not none, but /groom/file is empty";
    if (!s.groom.groups.empty())
        return "is not none, and /groom/groups is set: 'hairbench groom filter' writes a file of "
               "these groups alone";
    if (!s.simulation.animation.clip.empty())
        return "is not none, and /simulation/animation/clip is set: use only one of them";
    const bool is_none = s.simulation.solver == hair::Solver::none;
    if (s.groom.cache.mode == hair::CacheMode::play && !is_none)
        return "is play, which needs /simulation/solver none; follow works with the others";
    if (s.groom.cache.mode == hair::CacheMode::follow && is_none)
        return "is follow, but /simulation/solver is none, which moves no guide: use play";
    return {};
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

Broken solverTakesSets(const hair::Settings& s) {
    if (s.simulation.material.set_share == 0.0f || s.simulation.solver == hair::Solver::rod)
        return {};
    return "is above 0, but only the solver rod takes a set";
}

Broken solverTwists(const hair::Settings& s) {
    if (s.simulation.material.twist == 0.0f) return {};
    switch (s.simulation.solver) {
    case hair::Solver::rod:
        if (s.simulation.rest == hair::RestShape::groom) return {};
        return "is not 0, but balanced hair rests in the groom's shape";
    case hair::Solver::stable_cosserat:
    case hair::Solver::position_based_rod:
        return {};
    default:
        return "is not 0, which only the solvers rod, stable_cosserat and position_based_rod "
               "support";
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
        return "is segments, which only the solvers shape, ftl, rod and files support";
    default:
        if (s.simulation.collision.warm_start)
            return "is segments, but warm_start carries only the contact forces of vertices";
        return {};
    }
}

Broken hairHasOneFriction(const hair::Settings& s) {
    if (!hair::yields(s.simulation.hair_hair) || s.simulation.hair_hair.friction == 0.0f) return {};
    return "is above 0, but friction_coefficient or cohesion takes its place";
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

// Ratios of frame to step within this of a whole number count as whole. In ten minutes of frames, a
// step that is due too early or too late then happens once at most.
constexpr double kWholeRatio = 2e-5;

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

// Heads are drawn one after the other, and one set of shadow maps serves all that move alike.
Broken headsAreDrawnOneByOne(const hair::Settings& s) {
    if (s.copies.count == 1) return {};
    const hair::Transparency kind = s.render.transparency;
    if (kind != hair::Transparency::none && kind != hair::Transparency::alpha_to_coverage)
        return "is above 1, but /render/transparency blends the fragments of one head only";
    if (s.render.show == hair::Show::overdraw || s.render.show == hair::Show::density)
        return "is above 1, but /render/show counts the fragments of one head only";
    if (!s.shading.shadows.meshes && s.shading.shadows.hair == hair::HairShadows::none) return {};
    for (std::size_t i = 0; i < s.shading.lights.size(); ++i) {
        const hair::LightSettings& light = s.shading.lights[i];
        if (light.shadows && light.type != hair::LightType::directional)
            return "is above 1, but /shading/lights/" + std::to_string(i) +
                   " is near and casts shadows, which differ from head to head";
    }
    return {};
}

Broken headsMoveByThemselves(const hair::Settings& s) {
    if (motions(s.copies) == 1) return {};
    if (!s.simulation.animation.clip.empty())
        return "is own, but /simulation/animation/clip deforms all heads alike";
    if (s.groom.cache.mode != hair::CacheMode::none)
        return "is own, but /groom/cache moves all heads alike";
    return {};
}

Broken indirectLightHasItsMaps(const hair::Settings& s) {
    if (!s.shading.indirect) return {};
    if (!hair::rendering::hasLinearLight(s.render))
        return "is on, but /render/tone_map is none: light does not add up in display colours";
    if (!s.shading.shadows.meshes)
        return "is on, but /shading/shadows/meshes is off: its sources are parts of those maps";
    if (s.shading.shadows.hair == hair::HairShadows::rays)
        return "is on, but /shading/shadows/hair is rays: hair has no map to take sources from";
    return {};
}

Broken scatteredLightAddsUp(const hair::Settings& s) {
    if (s.shading.skin_scattering == 0.0f || hair::rendering::hasLinearLight(s.render)) return {};
    return "is above 0, but /render/tone_map is none: light does not add up in display colours";
}

struct Rule {
    const char* pointer;
    Broken (*broken)(const hair::Settings&);
};

constexpr Rule kRules[] = {
    {"/groom/grow/mesh", hasGuides},
    {"/groom/vertices", strandsHaveTwoEnds},
    {"/groom/cache/mode", cacheHasItsSolver},
    {"/groom/grow/parting/to", partingHasLength},
    {"/strands/source", groomHasStrandsOfItsOwn},
    {"/strands/curve", groomsStrandsHaveTheirCurve},
    {"/simulation/rest", solverHasBalancedRest},
    {"/simulation/material/ellipticity", solverHasEllipticSections},
    {"/simulation/material/set_share", solverTakesSets},
    {"/simulation/material/twist", solverTwists},
    {"/simulation/collision/warm_start", solverCarriesContact},
    {"/simulation/collision/parts", solverKeepsSegmentsOut},
    {"/simulation/hair_hair/friction", hairHasOneFriction},
    {"/simulation/wind/direction", windHasDirection},
    {"/simulation/motion/keyframes", keyframesAscend},
    {"/simulation/pulls", pullKeysAscend},
    {"/simulation/motion/repeat", repeatedMotionCloses},
    {"/lod/near_distance", lodDistancesAscend},
    {"/copies/count", headsAreDrawnOneByOne},
    {"/copies/motion", headsMoveByThemselves},
    {"/camera/near_plane", planesAscend},
    {"/camera/target", cameraLooksSomewhere},
    {"/camera/up", upStandsOut},
    {"/render/coverage", coverageIsSeen},
    {"/render/transparency", alphaHasSamplesToCover},
    {"/shading/lights", lightsHaveDirections},
    {"/shading/lights", lightsHaveRoomForTheirMaps},
    {"/shading/indirect", indirectLightHasItsMaps},
    {"/shading/skin_scattering", scatteredLightAddsUp},
    {"/run/busy_work", busyWorkHasAPass},
    {"/run/overlapped_stamps", timestampsAreOfOneQueue},
    {"/run/frame_time", frameHasRoomForItsSteps}};

}  // namespace

std::pair<std::uint32_t, std::uint32_t> stepsPerFrame(const hair::Settings& settings) {
    const double ratio = double{settings.run.frame_time} / double{settings.simulation.time_step};
    const double whole = std::round(ratio);
    if (std::abs(ratio - whole) <= kWholeRatio * std::max(1.0, ratio))
        return {static_cast<std::uint32_t>(whole), static_cast<std::uint32_t>(whole)};
    return {
        static_cast<std::uint32_t>(std::floor(ratio)),
        static_cast<std::uint32_t>(std::ceil(ratio))};
}

std::string stepWarning(const hair::Settings& settings) {
    const auto [fewest, most] = stepsPerFrame(settings);
    const bool moves = settings.simulation.solver != hair::Solver::none ||
                       !settings.simulation.motion.keyframes.empty() ||
                       !settings.simulation.animation.clip.empty();
    if (fewest == most || settings.run.interpolate || !moves) return {};
    const double step = double{settings.run.frame_time} / most;
    return "/simulation/time_step does not divide /run/frame_time: a frame advances by " +
           std::to_string(fewest) + " or " + std::to_string(most) +
           " steps, so that hair and head move unevenly; set /simulation/time_step to " +
           decimalText(static_cast<float>(step)) + " or /run/interpolate to true";
}

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
         "scene file, relative to this one, or the name of a shipped scene, to which this "
         "document is applied as a JSON merge patch (RFC 7386): null removes a member of the base"},
        {"type", "string"}};
    members["sweep"] = std::move(sweep);
    members["suite"] = {
        {"description",
         "scene files, relative to this one, or names of shipped scenes, that are run "
         "one after another; only $schema and description may stand beside it"},
        {"type", "array"},
        {"minItems", 1},
        {"items", {{"type", "string"}}}};
    return schema.dump(2) + '\n';
}

// ---- Reference of fields ------------------------------------------------------------------------

namespace {

constexpr const char* kHead = R"(# Every field of a scene

`hairbench schema --markdown > docs/fields.md` writes this page, and a test compares the two. A field's pointer is its place in a scene file
(`/strands/density` is `{"strands": {"density": …}}`). It also names an axis (`-a /strands/density=16,64`), a field for `--set`, and a
widget of the viewer. [scenes.md](scenes.md#writing-a-scene) explains bases. In a list, `N` stands for an element's index, from 0.

)";

// Pointer of a field, with N for list indices -> the scene that is its example.
using Examples = std::map<std::string, std::string>;

bool isPlace(const std::string& token) {
    return !token.empty() &&
           std::ranges::all_of(token, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// "/shading/lights/1/power" -> "/shading/lights/N/power".
std::string withoutPlaces(const std::string& pointer) {
    std::string all;
    std::istringstream tokens(pointer);
    std::string token;
    std::getline(tokens, token, '/');  // the empty token before the first slash
    while (std::getline(tokens, token, '/')) all += '/' + (isPlace(token) ? "N" : token);
    return all;
}

// Records the scene as an example of every member that its document sets.
void addExamples(
    const Json& document, const std::string& pointer, const std::string& name, Examples& examples) {
    examples.emplace(pointer, name);
    if (document.is_object())
        for (const auto& [key, value] : document.items())
            addExamples(value, pointer + '/' + key, name, examples);
    if (document.is_array())
        for (const Json& value : document) addExamples(value, pointer + "/N", name, examples);
}

Examples examplesIn(const std::filesystem::path& folder) {
    std::vector<std::pair<std::size_t, std::filesystem::path>> scenes;  // shortest first
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            scenes.emplace_back(entry.file_size(), entry.path());
    std::ranges::sort(scenes);
    Examples examples;
    for (const auto& [size, path] : scenes) {
        Json document = parseJson(engine::readFile(path), path.string());
        const std::string name = path.lexically_relative(folder).generic_string();
        const Json sweep = document.value("sweep", Json::object());
        document.erase("sweep");
        addExamples(document, "", name, examples);
        if (!sweep.is_object()) continue;
        for (const auto& [axis, values] : sweep.items())
            if (axis.starts_with('/')) examples.emplace(withoutPlaces(axis), name);
    }
    return examples;
}

// Escapes text for a table cell.
std::string escaped(const std::string& text) {
    std::string all;
    for (const char c : text) {
        if (c == '|') all += '\\';
        all += c;
    }
    return all;
}

std::string code(const Json& value) { return '`' + escaped(value.dump()) + '`'; }

// "0 to 10", "one of `a`, `b`", "text".
std::string valuesOf(const Json& schema) {
    if (schema.contains("enum")) {
        std::string all;
        for (const Json& each : schema["enum"]) {
            if (each.is_null()) continue;
            all += (all.empty() ? "" : ", ") + code(each);
        }
        return all;
    }
    if (schema.contains("anyOf")) return valuesOf(schema["anyOf"][0]) + ", file";
    const Json type = schema.value("type", Json());
    const std::string name =
        type.is_array() ? type.at(0).get<std::string>() : type.get<std::string>();
    if (name == "array") {
        const Json& items = schema["items"];
        const std::string of = items.contains("properties") ? "objects" : valuesOf(items);
        if (schema.contains("minItems")) return schema["minItems"].dump() + " × " + of;
        return "list of up to " + schema["maxItems"].dump() + ' ' + of;
    }
    if (name == "object") return "by the file";
    if (name == "string") return "text";
    if (name == "boolean") return "`true`, `false`";
    const std::string range = schema["minimum"].dump() + " to " + schema["maximum"].dump();
    return name == "integer" ? range + ", whole" : range;
}

// Splits "… [kg]" into the description and the unit.
std::pair<std::string, std::string> helpAndUnit(const std::string& description) {
    const std::size_t open = description.rfind(" [");
    if (open == std::string::npos || !description.ends_with(']')) return {description, ""};
    return {
        description.substr(0, open), description.substr(open + 2, description.size() - open - 3)};
}

class Page {
public:
    explicit Page(Examples examples) : examples_(std::move(examples)) {}

    // Adds the fields of an object, then the objects in it, each under a heading.
    void add(const Json& members, const std::string& pointer) {
        bool has_table = false;
        for (const auto& [name, schema] : members.items()) {
            if (schema.contains("properties")) continue;
            if (!std::exchange(has_table, true))
                text_ += "| field | values | unit | default | meaning | example |\n"
                         "|---|---|---|---|---|---|\n";
            addRow(pointer + '/' + name, schema);
        }
        if (has_table) text_ += '\n';
        for (const auto& [name, schema] : members.items()) {
            const bool is_list = schema.contains("items") && schema["items"].contains("properties");
            if (!schema.contains("properties") && !is_list) continue;
            const std::string here = pointer + '/' + name + (is_list ? "/N" : "");
            text_ += "## `" + here + "`: " + schema["description"].get<std::string>() + "\n\n";
            add(is_list ? schema["items"]["properties"] : schema["properties"], here);
        }
    }

    std::string text() && { return std::move(text_); }

private:
    void addRow(const std::string& pointer, const Json& schema) {
        const auto [help, unit] = helpAndUnit(schema["description"].get<std::string>());
        const auto example = examples_.find(pointer);
        text_ += "| `" + pointer + "` | " + valuesOf(schema) + " | " + unit + " | " +
                 (schema.contains("default") ? code(schema["default"]) : "") + " | " +
                 escaped(help) + " | ";
        if (example != examples_.end())
            text_ += '[' + example->second + "](../scenes/" + example->second + ')';
        text_ += " |\n";
    }

    Examples examples_;
    std::string text_ = kHead;
};

}  // namespace

std::string fieldReference(const std::filesystem::path& scenes) {
    Json members = Json::parse(sceneSchema()).at("properties");
    for (const char* const own : {"$schema", "base", "sweep", "suite"}) members.erase(own);
    Page page(examplesIn(scenes));
    page.add(members, "");
    std::string text = std::move(page).text();
    text.pop_back();  // one end of a line is enough
    return text;
}

}  // namespace benchmarks::scene
