#include "hair/groom/build_groom.h"

#include <numeric>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "engine/error.h"
#include "hair/groom/growth/grow.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/guides/choose_guides.h"
#include "hair/groom/guides/root_triangles.h"
#include "hair/groom/importers.h"
#include "hair/groom/resample.h"
#include "hair/groom/style/style.h"

namespace hair {
namespace {

constexpr std::uint32_t kThesisGuides = 86;

glm::dmat4 placement(const FilePlacementSettings& settings, double scale) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(settings.translation));
    for (int axis = 2; axis >= 0; --axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        matrix = glm::rotate(matrix, glm::radians(double{settings.rotation[axis]}), direction);
    }
    return glm::scale(matrix, glm::dvec3(scale));
}

void place(StrandSet& strands, const FilePlacementSettings& settings) {
    const double scale = double{settings.scale} * strands.metres_per_unit.value_or(1.0);
    const glm::dmat4 matrix = placement(settings, scale);
    strands.metres_per_unit = 1.0;
    if (matrix == glm::dmat4(1.0)) return;
    for (glm::vec3& point : strands.points)
        point = glm::vec3(matrix * glm::dvec4(glm::dvec3(point), 1.0));
    for (float& width : strands.widths.values) width = static_cast<float>(width * scale);
    if (strands.widths.everywhere)
        *strands.widths.everywhere = static_cast<float>(*strands.widths.everywhere * scale);
}

// All strands as guides, or some of them with the others bound to them.
Groom withGuides(Groom dense, std::uint32_t count, const Mesh* mesh, std::uint32_t seed) {
    std::vector<std::uint32_t> chosen(dense.strand_count);
    std::iota(chosen.begin(), chosen.end(), 0u);
    if (count == 0 || count == dense.strand_count) {
        dense.bindings = bindStrands(dense, chosen);
        if (dense.root_triangles.empty()) dense.root_triangles = triangulateRoots(dense, mesh);
        return dense;
    }
    chosen = chooseGuides(dense, count, seed);
    Groom guides = pickStrands(dense, chosen);
    guides.bindings = bindStrands(dense, chosen);
    guides.root_triangles = triangulateRoots(guides, mesh);
    return guides;
}

Groom fromFile(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& path,
    std::uint32_t seed) {
    StrandSet strands = importStrands(path);
    try {
        place(strands, settings.placement);
        Groom groom = toGroom(std::move(strands), settings.vertices);
        if (mesh) groom.root_normals = rootNormals(groom, *mesh);
        return withGuides(
            style(std::move(groom), settings.style, seed), settings.guides, mesh, seed);
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace

Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed) {
    if (!settings.file.empty()) return fromFile(settings, mesh, directory / settings.file, seed);
    const std::string path = (directory / settings.grow.mesh).string();
    if (!mesh) throw engine::Error(path, "guides are to be grown, but there is no mesh");
    try {
        const std::uint32_t guides = settings.guides == 0 ? kThesisGuides : settings.guides;
        return style(grow(*mesh, settings.grow, directory, guides, seed), settings.style, seed);
    } catch (const engine::Error& error) {
        throw engine::Error(path, error.what());
    }
}

}  // namespace hair
