#include "benchmarks/mitsuba_export.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "benchmarks/assets.h"
#include "benchmarks/case.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/mitsuba_meshes.h"
#include "benchmarks/mitsuba_scene.h"
#include "benchmarks/mitsuba_shapes.h"
#include "benchmarks/progress.h"
#include "benchmarks/simulated_strands.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "engine/write_file.h"
#include "hair/rendering/mesh_geometry.h"

namespace benchmarks {
namespace {

void play(const engine::Device& device, Case& played, std::uint32_t frame) {
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
}

// The head, where the last frame takes it, and the meshes beside it.
std::vector<MitsubaParts::Mesh> writeMeshes(
    const std::filesystem::path& folder, const Scene& scene, const hair::Settings& settings,
    const hair::RigidMotion& head) {
    std::vector<MitsubaParts::Mesh> parts;
    if (const auto mesh = loadMesh(settings, scene.directory); mesh && settings.render.head)
        parts = writeMitsubaMesh(folder, "head", *mesh, head);
    const auto& wanted = settings.render.meshes;
    hair::RenderAssets assets = loadRenderAssets(settings, nullptr, scene.directory);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const hair::Mesh mesh = hair::placed(std::move(assets.meshes[i]), wanted[i]);
        std::ranges::move(
            writeMitsubaMesh(folder, "mesh_" + std::to_string(i), mesh, {}),
            std::back_inserter(parts));
    }
    return parts;
}

// The picture of the surroundings; the name of the copy, empty where there is none.
std::string copyEnvironment(
    const std::filesystem::path& folder, const Scene& scene, const hair::Settings& settings) {
    if (settings.render.environment.empty()) return {};
    const std::filesystem::path file = scene.directory / settings.render.environment;
    const std::string name = "environment" + file.extension().string();
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::filesystem::copy_file(
        file, folder / name, std::filesystem::copy_options::overwrite_existing, error);
    if (error) throw engine::Error((folder / name).string(), error.message());
    return name;
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
    Case played(device, settings, scene.directory);
    play(device, played, frame);
    if (settings.render.hair) {
        const hair::StrandSet strands = drawnStrands(played.strands());
        if (strands.ends.empty()) throw engine::Error(scene.path.string(), "no strands are drawn");
        parts.hair_file = "hair.txt";
        write(parts.hair_file, [&](std::ostream& out) { writeMitsubaCurves(out, strands); });
        result.strands = strands.strandCount();
        result.points = strands.points.size();
    }
    parts.meshes = writeMeshes(folder, scene, settings, played.head());
    for (const MitsubaParts::Mesh& mesh : parts.meshes) result.triangles += mesh.triangles;
    parts.environment_file = copyEnvironment(folder, scene, settings);
    write("scene.xml", [&](std::ostream& out) { writeMitsubaScene(out, settings, parts); });
    return result;
}

}  // namespace benchmarks
