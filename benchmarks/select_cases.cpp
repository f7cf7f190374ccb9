#include <set>

#include "benchmarks/assets.h"
#include "benchmarks/commands.h"

namespace benchmarks {

std::vector<CaseSpec> selectCases(Scene& scene, const SceneOptions& options) {
    if (options.frames) setField(scene, "/run/frames", std::to_string(*options.frames));
    if (options.warmup) setField(scene, "/run/warmup", std::to_string(*options.warmup));
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

}  // namespace benchmarks
