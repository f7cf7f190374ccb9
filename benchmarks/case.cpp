#include "benchmarks/case.h"

#include <span>

#include "benchmarks/hash.h"
#include "engine/transfer.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/import_mesh.h"

namespace benchmarks {

namespace {

// The mesh that the hair grows on and that is drawn under it. Hair from a file grows on none.
std::optional<hair::Mesh>
loadMesh(const hair::Settings& settings, const std::filesystem::path& directory) {
    if (!settings.groom.file.empty()) return std::nullopt;
    return hair::importMesh(directory / settings.groom.grow.mesh);
}

const hair::Mesh* pointerTo(const std::optional<hair::Mesh>& mesh) {
    return mesh ? &*mesh : nullptr;
}

}  // namespace

Case::Case(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory)
    : device_(device), settings_(settings), mesh_(loadMesh(settings, directory)),
      groom_(hair::buildGroom(settings.groom, pointerTo(mesh_), directory, settings.seed)),
      simulation_(device, groom_, settings.simulation, settings.seed),
      fixed_step_(double{settings.simulation.time_step}),
      root_triangles_(engine::makeBuffer(
          device, std::span<const std::array<std::uint32_t, 3>>(groom_.root_triangles),
          "root triangles")),
      root_normals_(engine::makeBuffer(
          device, std::span<const glm::vec3>(groom_.root_normals), "root normals")),
      renderer_(device, settings, view(), pointerTo(mesh_)) {}

void Case::frame(engine::Passes& passes) {
    using engine::PassKind;
    const std::uint32_t steps = settings_.simulation.solver == hair::Solver::none
                                    ? 0
                                    : fixed_step_.stepsFor(double{settings_.run.frame_time});
    for (std::uint32_t i = 0; i < steps; ++i) {
        passes.pass("wind", PassKind::compute, [&](engine::Commands& commands) {
            simulation_.recordWind(commands);
        });
        passes.pass("simulate", PassKind::compute, [&](engine::Commands& commands) {
            simulation_.recordStep(commands);
        });
    }
    renderer_.record(passes, view());
}

void Case::reset() {
    simulation_.reset();
    fixed_step_.reset();
}

std::vector<std::uint8_t> Case::picture() const {
    return engine::readOutput(device_, renderer_.target());
}

std::string Case::pictureHash() const {
    const std::vector<std::uint8_t> pixels = picture();
    return hashBytes(std::as_bytes(std::span(pixels)));
}

std::string Case::stateHash() const {
    const std::vector<glm::vec3> positions = simulation_.readPositions();
    return hashBytes(std::as_bytes(std::span(positions)));
}

std::vector<std::pair<std::string, std::uint64_t>> Case::counts() const {
    return {
        {"guides", groom_.strand_count},
        {"vertices_per_guide", groom_.vertices_per_strand},
        {"root_triangles", groom_.root_triangles.size()},
        {"strands", plan().strands()},
        {"segments", plan().drawnSegments()}};
}

hair::StrandView Case::view() const {
    const hair::GuideView guides = simulation_.guides();
    return {
        .guides = guides.positions,
        .root_triangles = root_triangles_.address(),
        .root_normals = groom_.root_normals.empty() ? 0 : root_normals_.address(),
        .guide_count = guides.strand_count,
        .vertices_per_guide = guides.vertices_per_strand,
        .triangle_count = static_cast<std::uint32_t>(groom_.root_triangles.size())};
}

void checkAssets(const hair::Settings& settings, const std::filesystem::path& directory) {
    const std::optional<hair::Mesh> mesh = loadMesh(settings, directory);
    hair::buildGroom(settings.groom, pointerTo(mesh), directory, settings.seed);
}

}  // namespace benchmarks
