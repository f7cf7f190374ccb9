#include "benchmarks/viewer/drop.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/gltf_model.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/surface.h"

namespace benchmarks::viewer {
namespace {

// ---- Dropped groom ------------------------------------------------------------------------------

constexpr std::uint32_t kMostAsGuides = 1000;
constexpr std::uint32_t kGuides = 300;  // of a dense groom: docs/grooms.md
constexpr std::uint32_t kRootsAsked = 1000;
constexpr double kOnSurface = 0.01;  // m

bool growOn(
    const hair::groom::Mesh& mesh, const hair::groom::StrandSet& strands, double metres_per_unit) {
    const hair::groom::NearestSurface nearest(mesh.positions, mesh.triangles);
    const std::uint32_t step = std::max(strands.strandCount() / kRootsAsked, 1u);
    std::vector<float> distances;
    for (std::uint32_t i = 0; i < strands.strandCount(); i += step) {
        const glm::dvec3 root(strands.points[strands.first(i)]);
        distances.push_back(static_cast<float>(nearest(root * metres_per_unit).distance));
    }
    return hair::groom::spreadOf(distances).quartile3 <= kOnSurface;
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
    const hair::groom::StrandSet strands = hair::groom::importStrands(file);
    const double metres_per_unit = strands.metres_per_unit.value_or(
        hair::groom::inspect(strands, nullptr, {}).metres_per_unit);

    hair::GroomSettings& groom = settings.groom;
    const std::string head = groom.file.empty() ? groom.grow.mesh : groom.mesh;
    const bool has_head =
        !head.empty() &&
        growOn(hair::groom::importMesh(directory / head), strands, metres_per_unit);
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

namespace {

// ---- Strands or triangles -----------------------------------------------------------------------

Holds inObj(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    bool lines = false;
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string::npos || first + 1 >= line.size()) continue;
        if (line[first + 1] != ' ' && line[first + 1] != '\t') continue;  // "vn", "fo"
        if (line[first] == 'f') return Holds::triangles;
        lines = lines || line[first] == 'l';
    }
    return lines ? Holds::strands : Holds::triangles;
}

Holds inPly(const std::filesystem::path& path) {
    constexpr std::streamsize kLongestHeader = 1 << 20;  // bytes
    std::string head(kLongestHeader, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), kLongestHeader);
    head.resize(static_cast<std::size_t>(file.gcount()));
    const hair::groom::PlyHeader header = hair::groom::readPlyHeader(head);
    for (const char* name : {"strand", "polyline", "line"})
        if (header.find(name)) return Holds::strands;
    const hair::groom::PlyElement* const faces = header.find("face");
    const bool has_faces = faces && faces->count > 0;
    return header.find("edge") && !has_faces ? Holds::strands : Holds::triangles;
}

Holds inGltf(const std::filesystem::path& path) {
    constexpr int kFirstOfTriangles = 4;  // glTF 2.0, mesh.primitive.mode: 0 to 3 points and lines
    const std::string file = engine::readFile(path);
    const scene::Json document = scene::Json::parse(
        hair::groom::isGlb(file) ? hair::groom::glbChunks(file).json : std::string_view(file),
        nullptr, false);
    bool lines = false;
    for (const scene::Json& mesh : document.value("meshes", scene::Json::array()))
        for (const scene::Json& primitive : mesh.value("primitives", scene::Json::array())) {
            if (primitive.value("mode", kFirstOfTriangles) >= kFirstOfTriangles)
                return Holds::triangles;
            lines = true;
        }
    return lines ? Holds::strands : Holds::triangles;
}

}  // namespace

Holds strandsOrTriangles(const std::filesystem::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    try {
        if (extension == ".obj") return inObj(file);
        if (extension == ".ply") return inPly(file);
        return inGltf(file);
    } catch (const engine::Error&) {
        return Holds::triangles;
    } catch (const scene::Json::exception&) {  // JSON, but no glTF
        return Holds::triangles;
    }
}

}  // namespace benchmarks::viewer
