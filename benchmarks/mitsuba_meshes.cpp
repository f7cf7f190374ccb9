#include "benchmarks/mitsuba_meshes.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/interrupt.h"
#include "benchmarks/mitsuba_shapes.h"
#include "engine/image_file.h"
#include "engine/write_file.h"
#include "hair/rendering/working_color.h"

namespace benchmarks {
namespace {

// A material's picture times its colour, both linear, as display RGB again: Mitsuba has no factor.
engine::Pixels colored(engine::Pixels picture, const glm::vec3& color) {
    const glm::dvec3 factor = hair::toLinear(color);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        glm::dvec3 display;
        for (int c = 0; c < 3; ++c) display[c] = picture.rgba[i + static_cast<std::size_t>(c)];
        display = hair::toDisplay(factor * hair::toLinear(display / 255.0));
        for (int c = 0; c < 3; ++c)
            picture.rgba[i + static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(display[c], 0.0, 1.0)));
    }
    return picture;
}

const char* wrapName(hair::Wrap wrap) {
    switch (wrap) {
    case hair::Wrap::repeat:
        return "repeat";
    case hair::Wrap::mirror:
        return "mirror";
    case hair::Wrap::clamp:
        break;
    }
    return "clamp";
}

}  // namespace

std::vector<MitsubaParts::Mesh> writeMitsubaMesh(
    const std::filesystem::path& folder, const std::string& name, const hair::Mesh& mesh,
    const hair::RigidMotion& pose) {
    std::vector<MitsubaParts::Mesh> parts;
    for (std::uint32_t i = 0; i < mesh.materials.size(); ++i) {
        const auto triangles = std::ranges::count(mesh.triangle_materials, i);
        if (triangles == 0) continue;
        const hair::Material& material = mesh.materials[i];
        const std::string stem = name + '_' + std::to_string(parts.size());
        MitsubaParts::Mesh part{
            .file = stem + ".ply",
            .triangles = static_cast<std::size_t>(triangles),
            .color = material.base_color,
            .metallic = material.metallic,
            .roughness = material.roughness,
            .two_sided = material.double_sided};
        engine::writeFileAtomically(
            folder / part.file, [&](std::ostream& out) { writeMaterialPly(out, mesh, i, pose); },
            checkInterrupted);
        if (material.base_color_texture && !mesh.texture_coordinates.empty()) {
            const hair::MaterialTexture& texture = *material.base_color_texture;
            const engine::Pixels picture =
                colored(mesh.pictures.at(texture.picture), material.base_color);
            part.texture = stem + ".png";
            part.wrap = wrapName(texture.horizontal);
            engine::writePng(folder / part.texture, picture.width, picture.height, picture.rgba);
        }
        parts.push_back(part);
    }
    return parts;
}

}  // namespace benchmarks
