#include "benchmarks/mitsuba_export.h"

#include <algorithm>
#include <optional>

#include "benchmarks/assets.h"
#include "benchmarks/case.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/mitsuba_scene.h"
#include "benchmarks/mitsuba_shapes.h"
#include "benchmarks/progress.h"
#include "benchmarks/simulated_strands.h"
#include "engine/frame_loop.h"
#include "engine/write_file.h"
#include "hair/simulation/fixed_step.h"
#include "hair/simulation/head_motion.h"

namespace benchmarks {
namespace {

hair::StrandSet strandsOf(
    const engine::Device& device, const Scene& scene, const hair::Settings& settings,
    std::uint32_t frame) {
    Case played(device, settings, scene.directory);
    engine::FrameLoop loop(device, engine::Timing::statistics);
    Progress progress(frame + std::size_t{1});
    try {
        for (std::uint32_t i = 0; i <= frame; ++i) {
            checkInterrupted();
            progress.begin("frame " + std::to_string(i));
            loop.frame([&](engine::Passes& passes) { played.simulate(passes); });
        }
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
    hair::StrandSet strands = drawnStrands(played.strands());
    if (strands.ends.empty()) throw engine::Error(scene.path.string(), "no strands are drawn");
    return strands;
}

// Where the steps of that many frames take the head.
hair::RigidMotion headPose(const hair::Settings& settings, std::uint32_t frame) {
    const double time_step{settings.simulation.time_step};
    hair::FixedStep fixed_step(time_step);
    std::uint64_t steps = 0;
    for (std::uint32_t i = 0; i <= frame; ++i)
        steps += fixed_step.stepsFor(double{settings.run.frame_time});
    return hair::HeadMotion(settings.simulation.motion).at(static_cast<double>(steps) * time_step);
}

}  // namespace

MitsubaExport exportMitsuba(
    const engine::Device& device, const Scene& scene, const hair::Settings& settings,
    std::uint32_t frame, const std::filesystem::path& folder) {
    const auto write = [&](const std::string& name, const auto& writer) {
        engine::writeFileAtomically(folder / name, writer, checkInterrupted);
    };
    MitsubaParts parts;
    MitsubaExport result;
    if (settings.render.hair) {
        const hair::StrandSet strands = strandsOf(device, scene, settings, frame);
        parts.hair_file = "hair.txt";
        write(parts.hair_file, [&](std::ostream& out) { writeMitsubaCurves(out, strands); });
        result.strands = strands.strandCount();
        result.points = strands.points.size();
    }
    const std::optional<hair::Mesh> mesh =
        settings.render.head ? loadMesh(settings, scene.directory) : std::nullopt;
    const std::size_t materials = mesh ? mesh->materials.size() : 0;
    for (std::uint32_t i = 0; i < materials; ++i) {
        const auto triangles = std::ranges::count(mesh->triangle_materials, i);
        if (triangles == 0) continue;
        const std::string name = "head_" + std::to_string(parts.meshes.size()) + ".ply";
        write(name, [&](std::ostream& out) {
            writeMaterialPly(out, *mesh, i, headPose(settings, frame));
        });
        parts.meshes.push_back({name, mesh->materials[i].base_color});
        result.triangles += static_cast<std::size_t>(triangles);
    }
    write("scene.xml", [&](std::ostream& out) { writeMitsubaScene(out, settings, parts); });
    return result;
}

}  // namespace benchmarks
