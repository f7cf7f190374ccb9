#include "benchmarks/viewer/files/dropped_groom.h"

#include <algorithm>
#include <vector>

#include "hair/groom/importers.h"
#include "hair/groom/inspect.h"
#include "hair/groom/inspect/spread_of.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/nearest_surface.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kMostAsGuides = 1000;
constexpr std::uint32_t kGuides = 300;  // of a dense groom: docs/grooms.md
constexpr std::uint32_t kRootsAsked = 1000;
constexpr double kOnSurface = 0.01;  // m

bool growOn(const hair::Mesh& mesh, const hair::StrandSet& strands, double metres_per_unit) {
    const hair::NearestSurface nearest(mesh.positions, mesh.triangles);
    const std::uint32_t step = std::max(strands.strandCount() / kRootsAsked, 1u);
    std::vector<float> distances;
    for (std::uint32_t i = 0; i < strands.strandCount(); i += step) {
        const glm::dvec3 root(strands.points[strands.first(i)]);
        distances.push_back(static_cast<float>(nearest(root * metres_per_unit).distance));
    }
    return hair::spreadOf(distances).quartile3 <= kOnSurface;
}

// What moves with a head that is no longer there.
void removeBodiesOfHead(hair::SimulationSettings& simulation) {
    std::erase_if(simulation.colliders, [](const hair::Collider& collider) {
        return collider.follows == hair::Follows::head;
    });
    std::erase_if(simulation.distance_fields, [](const hair::DistanceFieldSettings& field) {
        return field.follows == hair::Follows::head || field.mesh.empty();
    });
}

}  // namespace

hair::Settings withGroom(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file, const std::string& name) {
    const hair::StrandSet strands = hair::importStrands(file);
    const double metres_per_unit =
        strands.metres_per_unit.value_or(hair::inspect(strands, nullptr, {}).metres_per_unit);

    hair::GroomSettings& groom = settings.groom;
    const std::string head = groom.file.empty() ? groom.grow.mesh : groom.mesh;
    const bool has_head =
        !head.empty() && growOn(hair::importMesh(directory / head), strands, metres_per_unit);
    groom.file = name;
    groom.mesh = has_head ? head : "";
    groom.placement = {};
    if (!strands.metres_per_unit) groom.placement.scale = static_cast<float>(metres_per_unit);
    groom.vertices = 0;
    groom.style = {};
    if (!has_head) removeBodiesOfHead(settings.simulation);
    settings.simulation.pulls.clear();

    const bool dense = strands.strandCount() > kMostAsGuides;
    groom.guides = dense ? kGuides : 0;
    if (dense) settings.strands.source = hair::StrandSource::groom;
    if (!strands.widths.known()) settings.strands.width = hair::WidthSource::scene;
    return settings;
}

}  // namespace benchmarks
