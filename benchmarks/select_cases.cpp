#include <set>

#include <nlohmann/json.hpp>

#include "benchmarks/assets.h"
#include "benchmarks/select_cases.h"
#include "benchmarks/decimal_text.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

// "POINTER=VALUE".
void setField(Scene& scene, const std::string& argument) {
    const std::size_t equals = argument.find('=');
    try {
        if (equals == std::string::npos || equals == 0)
            throw engine::Error("expected POINTER=VALUE, as in /strands/density=16");
        const Axis field = checkedAxis(
            {.pointer = argument.substr(0, equals),
             .values = {parseValue(argument.substr(equals + 1))}},
            scene.resolved.json());
        setField(scene, field.pointer, field.values.front().json());
    } catch (const engine::Error& error) {
        throw engine::Error("--set " + argument, error.what());
    }
}

// The number as a scene file would have it: 0.02, though settings are floats.
Json decimal(double number) { return Json::parse(decimalText(number)); }

}  // namespace

std::vector<CaseSpec> selectCases(Scene& scene, const SceneOptions& options) {
    if (options.frames) setField(scene, "/run/frames", *options.frames);
    if (options.warmup) setField(scene, "/run/warmup", *options.warmup);
    if (options.precision) setField(scene, "/run/precision", decimal(*options.precision));
    if (options.max_time) setField(scene, "/run/max_time", decimal(*options.max_time));
    for (const std::string& set : options.sets) setField(scene, set);
    std::vector<Axis> overrides;
    for (const std::string& axis : options.axes) overrides.push_back(parseAxis(axis));
    std::vector<CaseSpec> cases = expand(scene, overrides);

    std::set<std::string> checked;
    for (const CaseSpec& each : cases) {
        const hair::GroomSettings& groom = each.settings.groom;
        std::string files;
        for (const std::string& file :
             {groom.file, groom.mesh, groom.grow.mesh, groom.grow.scalp, groom.grow.mask,
              groom.grow.length_map, each.settings.strands.offsets, each.settings.strands.texture,
              each.settings.render.environment, each.settings.run.reference})
            files += file + '\n';
        for (const auto& mesh : each.settings.render.meshes) files += '\n' + mesh.file;
        for (const auto& field : each.settings.simulation.distance_fields)
            files += '\n' + field.mesh;
        if (checked.insert(files).second) checkAssets(each.settings, scene.path);
    }
    return cases;
}

CaseSpec singleCase(Scene& scene, const SceneOptions& options) {
    scene.axes.clear();
    return selectCases(scene, options).front();
}

}  // namespace benchmarks
