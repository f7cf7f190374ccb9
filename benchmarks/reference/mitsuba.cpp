#include "benchmarks/reference/mitsuba.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/frame_loop.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

namespace benchmarks::reference {

// ---- Control points of curves -------------------------------------------------------------------

// The spline passes (c[i-1] + 4 c[i] + c[i+1]) / 6 at knot i. Natural ends, c[-1] - 2 c[0] + c[1] =
// 0, make c[0] the first point, and likewise at the last. This leaves a tridiagonal system for the
// others. Thomas's algorithm solves it without pivoting, because it is diagonally dominant.
std::vector<glm::dvec4> interpolatingControlPoints(std::span<const glm::dvec4> points) {
    assert(points.size() >= 2);
    const std::size_t count = points.size();
    std::vector<glm::dvec4> control(count + 2);
    const std::span<glm::dvec4> c = std::span(control).subspan(1, count);
    std::vector<double> above(count, 0.0);  // the diagonal is 1 after elimination
    c[0] = points[0];
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double pivot = 4.0 - above[i - 1];
        above[i] = 1.0 / pivot;
        c[i] = (6.0 * points[i] - c[i - 1]) / pivot;
    }
    c[count - 1] = points[count - 1];
    for (std::size_t i = count - 1; i-- > 1;) c[i] -= above[i] * c[i + 1];
    control.front() = 2.0 * c[0] - c[1];
    control.back() = 2.0 * c[count - 1] - c[count - 2];
    return control;
}

namespace {

// ---- Units of lights ----------------------------------------------------------------------------

// Squared distance at which the light shows its colour, m^2.
double referenceSquared(const hair::LightSettings& light, const glm::dvec3& target) {
    const double reference{light.reference_distance};
    if (reference > 0.0) return reference * reference;
    const glm::dvec3 offset = glm::dvec3(light.position) - target;
    return glm::dot(offset, offset);
}

}  // namespace

glm::dvec3 lightColor(const hair::RenderSettings& render, const hair::LightSettings& light) {
    const double strength{light.strength};
    const glm::dvec3 color(light.color);
    // The strength is a factor on working colours.
    return hair::rendering::hasLinearLight(render) ? strength * hair::rendering::toLinear(color)
                                                   : hair::rendering::toLinear(strength * color);
}

// A matt white surface reflects irradiance / pi; irradiance is intensity / distance^2.
glm::dvec3 lightIntensity(
    const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target) {
    return std::numbers::pi * referenceSquared(light, target) * color;
}

// The irradiance of a surface that faces a sphere is pi radiance (radius / distance)^2. In front of
// the middle of a rectangle, it is pi radiance times the form factor.
glm::dvec3
lightRadiance(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target) {
    if (light.type == hair::LightType::rectangle) {
        hair::LightSettings seen = light;
        seen.reference_distance = static_cast<float>(std::sqrt(referenceSquared(light, target)));
        return color / hair::rendering::rectangleFormFactor(seen);
    }
    const double radius{light.radius};
    return referenceSquared(light, target) / (radius * radius) * color;
}

namespace {

// Files are in cm. Mitsuba offsets the origins of rays that leave a surface by 9e-5 (1 + the
// greatest coordinate) in the file's unit. In metres this is 0.1 mm, three times a hair's radius,
// so rays would miss adjacent fibres. In centimetres it is 0.01 mm at 0.1 m from the origin.
constexpr float kUnitsPerMetre = 100;

// ---- XML elements -------------------------------------------------------------------------------

// Elements of a Mitsuba scene, each with its newline.

template <class Value>
std::string element(const char* type, const char* name, const Value& value) {
    std::string text;
    if constexpr (std::is_arithmetic_v<Value>) {
        text = scene::decimalText(value);
    } else {
        text = value;
    }
    return std::string("<") + type + " name=\"" + name + "\" value=\"" + text + "\"/>\n";
}

template <class Vector>
std::string rgb(const char* name, const Vector& linear) {
    return element("rgb", name, scene::decimalTexts(linear, ", "));
}

// ---- Emitters -----------------------------------------------------------------------------------

void writePoint(std::ostream& out, const glm::vec3& position, const glm::dvec3& intensity) {
    out << "<emitter type=\"point\">\n    <point name=\"position\" value=\""
        << scene::decimalTexts(kUnitsPerMetre * position, ", ") << "\"/>\n    "
        << rgb("intensity", double{kUnitsPerMetre * kUnitsPerMetre} * intensity) << "</emitter>\n";
}

void writeSphere(std::ostream& out, const hair::LightSettings& light, const glm::dvec3& radiance) {
    out << "<shape type=\"sphere\">\n    <point name=\"center\" value=\""
        << scene::decimalTexts(kUnitsPerMetre * light.position, ", ") << "\"/>\n    "
        << element("float", "radius", kUnitsPerMetre * light.radius)
        << "    <emitter type=\"area\">\n        " << rgb("radiance", radiance)
        << "    </emitter>\n</shape>\n";
}

// Mitsuba's rectangle extends from -1 to 1 and shines towards +z. Adding 0 removes the sign of
// zeros.
void writeRectangle(
    std::ostream& out, const hair::LightSettings& light, const glm::dvec3& radiance) {
    const hair::rendering::RectangleFace face = hair::rendering::rectangleFace(light);
    const std::array columns{
        -kUnitsPerMetre * face.half_width, kUnitsPerMetre * face.half_height, face.normal,
        kUnitsPerMetre * light.position};
    out << "<shape type=\"rectangle\">\n    <transform name=\"to_world\">\n        <matrix "
           "value=\"";
    for (int row = 0; row < 3; ++row)
        for (const glm::vec3& column : columns)
            out << scene::decimalText(column[row] + 0.0f) << ' ';
    out << "0 0 0 1\"/>\n    </transform>\n    <emitter type=\"area\">\n        "
        << rgb("radiance", radiance) << "    </emitter>\n</shape>\n";
}

// Irradiance is pi times the colour.
void writeDirectional(std::ostream& out, const glm::vec3& direction, const glm::dvec3& irradiance) {
    out << "<emitter type=\"directional\">\n    "
        << element("vector", "direction", scene::decimalTexts(direction, ", ")) << "    "
        << rgb("irradiance", irradiance) << "</emitter>\n";
}

void writeLight(
    std::ostream& out, const hair::Settings& settings, const hair::LightSettings& light) {
    const glm::dvec3 color = lightColor(settings.render, light);
    const glm::dvec3 target(settings.camera.target);
    if (light.type == hair::LightType::directional) {
        writeDirectional(out, light.direction, std::numbers::pi * color);
    } else if (light.type == hair::LightType::sphere && light.radius > 0.0f) {
        writeSphere(out, light, lightRadiance(light, color, target));
    } else if (light.type == hair::LightType::rectangle) {
        writeRectangle(out, light, lightRadiance(light, color, target));
    } else {
        writePoint(out, light.position, lightIntensity(light, color, target));
    }
}

// Mitsuba's environment maps have our orientation: +y up, the middle at +z, the right at -x.
void writeEnvironment(
    std::ostream& out, const hair::RenderSettings& render, const std::string& file) {
    out << "<emitter type=\"envmap\">\n    " << element("string", "filename", file) << "    "
        << element("float", "scale", render.environment_strength)
        << "    <transform name=\"to_world\">\n        <rotate y=\"1\" angle=\""
        << scene::decimalText(render.environment_turn) << "\"/>\n    </transform>\n</emitter>\n";
}

// Writes the emitters of a Mitsuba scene: the settings' lights, and the background or, if there is
// one, the environment with the picture `environment_file`.
void writeMitsubaLights(
    std::ostream& out, const hair::Settings& settings, const std::string& environment_file) {
    if (!environment_file.empty()) {
        writeEnvironment(out, settings.render, environment_file);
    } else if (settings.render.background != glm::vec3(0.0f)) {
        out << "<emitter type=\"constant\">\n    "
            << rgb("radiance", hair::rendering::toLinear(settings.render.background))
            << "</emitter>\n";
    }
    for (const hair::LightSettings& light : settings.shading.lights)
        writeLight(out, settings, light);
}

// ---- The scene file -----------------------------------------------------------------------------

// Light hair is seen through many fibres, so paths are long and Russian roulette starts late.
constexpr const char* kBegin = R"(<?xml version="1.0" encoding="utf-8"?>
<scene version="3.0.0">
<default name="spp" value="64"/>
<integrator type="path">
    <integer name="max_depth" value="64"/>
    <integer name="rr_depth" value="16"/>
</integrator>
)";

void writeCamera(std::ostream& out, const hair::Settings& settings) {
    const hair::CameraSettings& camera = settings.camera;
    out << "<sensor type=\"perspective\">\n"
        << "    <string name=\"fov_axis\" value=\"y\"/>\n"
        << "    " << element("float", "fov", camera.field_of_view)  // deg
        << "    " << element("float", "near_clip", kUnitsPerMetre * camera.near_plane) << "    "
        << element("float", "far_clip", kUnitsPerMetre * camera.far_plane)
        << "    <transform name=\"to_world\">\n"
        << "        <lookat origin=\""
        << scene::decimalTexts(kUnitsPerMetre * camera.position, ", ") << "\" target=\""
        << scene::decimalTexts(kUnitsPerMetre * camera.target, ", ") << "\" up=\""
        << scene::decimalTexts(camera.up, ", ") << "\"/>\n    </transform>\n"
        << "    <sampler type=\"independent\">\n"
        << "        <integer name=\"sample_count\" value=\"$spp\"/>\n    </sampler>\n"
        << "    <film type=\"hdrfilm\">\n"
        << "        <integer name=\"width\" value=\"" << settings.render.width << "\"/>\n"
        << "        <integer name=\"height\" value=\"" << settings.render.height << "\"/>\n"
        << "        <string name=\"pixel_format\" value=\"rgb\"/>\n"
        << "        <string name=\"component_format\" value=\"float32\"/>\n"
        << "        <rfilter type=\"box\"/>\n    </film>\n</sensor>\n";
}

void writeAbsorption(
    std::ostream& out, const hair::ShadingSettings& shading, const std::string& file) {
    if (!file.empty()) {
        out << "<texture type=\"bitmap\" name=\"sigma_a\">\n            "
            << element("string", "filename", file) << "            "
            << element("boolean", "raw", "true") << "            "
            << element("string", "filter_type", "nearest") << "            "
            << element("string", "wrap_mode", "clamp") << "        </texture>\n";
        return;
    }
    const glm::dvec3 absorbed = hair::rendering::absorption(shading);
    // Mitsuba accepts colours up to 1 here, and a scale.
    const double scale = std::max({absorbed.x, absorbed.y, absorbed.z, 1.0});
    out << rgb("sigma_a", absorbed / scale) << "        " << element("float", "scale", scale);
}

void writeHair(std::ostream& out, const hair::ShadingSettings& shading, const MitsubaParts& parts) {
    out << "<shape type=\"bsplinecurve\">\n    " << element("string", "filename", parts.hair_file)
        << "    <bsdf type=\"hair\">\n        ";
    writeAbsorption(out, shading, parts.absorption_file);
    out << "        " << element("float", "longitudinal_roughness", shading.longitudinal_roughness)
        << "        " << element("float", "azimuthal_roughness", shading.azimuthal_roughness)
        << "        "
        // In Mitsuba, scales open towards the root of a curve that begins there; the scales of hair
        // do not.
        << element("float", "scale_tilt", -shading.cuticle_tilt) << "        "
        << element("float", "int_ior", shading.refractive_index) << "        "
        << element("float", "ext_ior", 1.0) << "    </bsdf>\n</shape>\n";
}

// Factor on a base colour that makes Mitsuba's `principled` reflect, straight above, what glTF's
// surface does (shaders/shading/surface_brdf.glsl). glTF scatters only what the surface lets in, 1
// - 0.04 of a dielectric; `principled` (Burley 2012) has no such factor.
double letIn(float metallic) { return 1.0 - 0.04 * (1.0 - double{metallic}); }

// A picture's rows go down with v, in Mitsuba as in glTF.
void writeColor(
    std::ostream& out, const char* name, const MitsubaParts::Mesh& mesh, double factor) {
    if (mesh.texture.empty()) {
        out << rgb(name, factor * hair::rendering::toLinear(mesh.color));
        return;
    }
    out << "<texture type=\"bitmap\" name=\"" << name << "\">\n            "
        << element("string", "filename", mesh.texture) << "            "
        << element("string", "wrap_mode", mesh.wrap) << "        </texture>\n";
}

void writeMatt(std::ostream& out, const MitsubaParts::Mesh& mesh) {
    out << "<bsdf type=\"diffuse\">\n        ";
    writeColor(out, "reflectance", mesh, 1);
    out << "    </bsdf>\n";
}

void writeGlossy(std::ostream& out, const MitsubaParts::Mesh& mesh) {
    out << "<bsdf type=\"principled\">\n        ";
    writeColor(out, "base_color", mesh, letIn(mesh.metallic));
    out << "        " << element("float", "metallic", mesh.metallic) << "        "
        << element("float", "roughness", mesh.roughness) << "    </bsdf>\n";
}

// If light is summed in display RGB, our surfaces are matt.
void writeMesh(
    std::ostream& out, const hair::RenderSettings& render, const MitsubaParts::Mesh& mesh) {
    out << "<shape type=\"ply\">\n    " << element("string", "filename", mesh.file) << "    ";
    if (mesh.two_sided) out << "<bsdf type=\"twosided\">\n    ";
    hair::rendering::hasLinearLight(render) ? writeGlossy(out, mesh) : writeMatt(out, mesh);
    if (mesh.two_sided) out << "    </bsdf>\n";
    out << "</shape>\n";
}

}  // namespace

void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts) {
    out << kBegin;
    writeCamera(out, settings);
    writeMitsubaLights(out, settings, parts.environment_file);
    if (!parts.hair_file.empty()) writeHair(out, hair::rendering::wetted(settings).shading, parts);
    for (const MitsubaParts::Mesh& mesh : parts.meshes) writeMesh(out, settings.render, mesh);
    out << "</scene>\n";
}

// ---- Curves and PLY -----------------------------------------------------------------------------

void writeMitsubaCurves(std::ostream& out, const hair::groom::StrandSet& strands) {
    std::vector<glm::dvec4> points;
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        if (strands.size(strand) < 2) continue;
        points.clear();
        for (std::uint32_t i = strands.first(strand); i < strands.ends[strand]; ++i)
            points.emplace_back(glm::dvec3(strands.points[i]), 0.5 * strands.widths.at(i));
        for (glm::dvec4 control : interpolatingControlPoints(points)) {
            control.w = std::max(control.w, 0.0);
            out << scene::decimalTexts(double{kUnitsPerMetre} * control, " ") << '\n';
        }
        out << '\n';
    }
}

void writeMitsubaAbsorption(
    const std::filesystem::path& path, const hair::groom::StrandSet& strands,
    std::span<const float> powers, const glm::dvec3& absorption) {
    std::vector<float> pixels;
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        for (std::uint32_t i = strands.first(strand) + 1; i < strands.ends[strand]; ++i) {
            const double power = 0.5 * (double{powers[i - 1]} + double{powers[i]});
            for (int channel = 0; channel < 3; ++channel)
                pixels.push_back(static_cast<float>(power * power * absorption[channel]));
        }
    }
    engine::writeExr(path, 1, static_cast<std::uint32_t>(pixels.size() / 3), pixels);
}

void writeMaterialPly(
    std::ostream& out, const hair::groom::Mesh& mesh, std::uint32_t material,
    const hair::simulation::RigidMotion& pose) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);  // index in the file
    std::vector<std::uint32_t> vertices;  // as numbered in the file
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangle_materials[i] != material) continue;
        auto& triangle = triangles.emplace_back(mesh.triangles[i]);
        for (std::uint32_t& corner : triangle) {
            std::uint32_t& number = numbers[corner];
            if (number == kUnused) {
                number = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(corner);
            }
            corner = number;
        }
    }
    out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size();
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "\nproperty float " << name;
    const bool has_coordinates = !mesh.texture_coordinates.empty();
    if (has_coordinates) out << "\nproperty float u\nproperty float v";
    out << "\nelement face " << triangles.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::uint32_t vertex : vertices) {
        const glm::dvec3 normal = pose.rotation * glm::dvec3(mesh.normals[vertex]);
        out << scene::decimalTexts(double{kUnitsPerMetre} * pose(mesh.positions[vertex]), " ")
            << ' ' << scene::decimalTexts(normal, " ");
        if (has_coordinates)
            out << ' ' << scene::decimalTexts(mesh.texture_coordinates[vertex], " ");
        out << '\n';
    }
    for (const auto& [a, b, c] : triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
}

namespace {

// ---- Files of meshes ----------------------------------------------------------------------------

// The material's picture times a linear colour, converted back to display RGB: Mitsuba has no such
// factor.
engine::Pixels colored(engine::Pixels picture, const glm::dvec3& factor) {
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        glm::dvec3 display;
        for (int c = 0; c < 3; ++c) display[c] = picture.rgba[i + static_cast<std::size_t>(c)];
        display = hair::rendering::toDisplay(factor * hair::rendering::toLinear(display / 255.0));
        for (int c = 0; c < 3; ++c)
            picture.rgba[i + static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(display[c], 0.0, 1.0)));
    }
    return picture;
}

const char* wrapName(hair::groom::Wrap wrap) {
    switch (wrap) {
    case hair::groom::Wrap::repeat:
        return "repeat";
    case hair::groom::Wrap::mirror:
        return "mirror";
    case hair::groom::Wrap::clamp:
        break;
    }
    return "clamp";
}

// Writes a mesh, moved by `pose`, into `folder`: "<name>_0.ply" and so on, one file per material
// with triangles, and the pictures of base colours as PNG.
std::vector<MitsubaParts::Mesh> writeMitsubaMesh(
    const std::filesystem::path& folder, const std::string& name,
    const hair::RenderSettings& render, const hair::groom::Mesh& mesh,
    const hair::simulation::RigidMotion& pose) {
    std::vector<MitsubaParts::Mesh> parts;
    for (std::uint32_t i = 0; i < mesh.materials.size(); ++i) {
        const auto triangles = std::ranges::count(mesh.triangle_materials, i);
        if (triangles == 0) continue;
        const hair::groom::Material& material = mesh.materials[i];
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
            engine::checkInterrupted);
        if (material.base_color_texture && !mesh.texture_coordinates.empty()) {
            const hair::groom::MaterialTexture& texture = *material.base_color_texture;
            const double share = hair::rendering::hasLinearLight(render) ? letIn(part.metallic) : 1;
            const glm::dvec3 factor = share * hair::rendering::toLinear(material.base_color);
            const engine::Pixels picture = colored(mesh.pictures.at(texture.picture), factor);
            part.texture = stem + ".png";
            part.wrap = wrapName(texture.horizontal);
            engine::writePng(folder / part.texture, picture.width, picture.height, picture.rgba);
        }
        parts.push_back(part);
    }
    return parts;
}

// ---- Export of a frame --------------------------------------------------------------------------

void play(const engine::Device& device, measure::Case& played, std::uint32_t frame) {
    engine::FrameLoop loop(device, engine::Timing::statistics);
    measure::Progress progress(frame + std::size_t{1});
    try {
        for (std::uint32_t i = 0; i <= frame; ++i) {
            engine::checkInterrupted();
            progress.begin("frame " + std::to_string(i));
            loop.frame([&](engine::Passes& passes) { played.simulate(passes); });
        }
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
}

// Writes the head in the pose of the last frame, and the other meshes.
std::vector<MitsubaParts::Mesh> writeMeshes(
    const std::filesystem::path& folder, const scene::Scene& scene, const hair::Settings& settings,
    const measure::Case& played) {
    std::vector<MitsubaParts::Mesh> parts;
    if (auto mesh = scene::loadMesh(settings, scene.directory); mesh && settings.render.head) {
        played.deform(*mesh);
        parts = writeMitsubaMesh(folder, "head", settings.render, *mesh, played.carried());
    }
    const auto& wanted = settings.render.meshes;
    hair::rendering::RenderAssets assets =
        scene::loadRenderAssets(settings, nullptr, scene.directory);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const hair::groom::Mesh mesh =
            hair::rendering::placed(std::move(assets.meshes[i]), wanted[i]);
        std::ranges::move(
            writeMitsubaMesh(folder, "mesh_" + std::to_string(i), settings.render, mesh, {}),
            std::back_inserter(parts));
    }
    return parts;
}

// Copies the environment's picture. Returns the copy's name, empty if there is no environment.
std::string copyEnvironment(
    const std::filesystem::path& folder, const scene::Scene& scene,
    const hair::Settings& settings) {
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

// ---- Directions of neighbours ----

namespace {

// The middle of a piece of a strand.
struct PieceMiddle {
    glm::ivec3 cell{0};
    std::uint32_t strand = 0;
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f};
};

bool isEarlier(const glm::ivec3& a, const glm::ivec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

std::vector<PieceMiddle> pieceMiddles(const hair::groom::StrandSet& strands, float cell) {
    std::vector<PieceMiddle> middles;
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        for (std::uint32_t i = strands.first(strand) + 1; i < strands.ends[strand]; ++i) {
            const glm::vec3 piece = strands.points[i] - strands.points[i - 1];
            const float length = glm::length(piece);
            if (!(length > 0)) continue;
            const glm::vec3 position = strands.points[i - 1] + 0.5f * piece;
            middles.push_back(
                {.cell = glm::ivec3(glm::floor(position / cell)),
                 .strand = strand,
                 .position = position,
                 .direction = piece / length});
        }
    }
    std::ranges::sort(middles, isEarlier, &PieceMiddle::cell);
    return middles;
}

}  // namespace

double orientationSpread(const hair::groom::StrandSet& strands) {
    constexpr float kReach = 0.002f;
    constexpr std::size_t kPieces = 4000;  // at most, whose neighbours are compared
    const std::vector<PieceMiddle> middles = pieceMiddles(strands, kReach);
    double sum = 0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < middles.size(); i += middles.size() / kPieces + 1) {
        const PieceMiddle& piece = middles[i];
        double squares = 0;
        std::size_t neighbours = 0;
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 cell = piece.cell + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
            for (const PieceMiddle& other :
                 std::ranges::equal_range(middles, cell, isEarlier, &PieceMiddle::cell)) {
                if (other.strand == piece.strand ||
                    glm::distance(other.position, piece.position) > kReach)
                    continue;
                const glm::dvec3 across = glm::cross(other.direction, piece.direction);
                squares += glm::dot(across, across);
                ++neighbours;
            }
        }
        if (neighbours == 0) continue;
        sum += squares / static_cast<double>(neighbours);
        ++counted;
    }
    return counted > 0 ? glm::degrees(std::sqrt(sum / static_cast<double>(counted) / 2)) : 0.0;
}

MitsubaExport exportMitsuba(
    const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
    std::uint32_t frame, const std::filesystem::path& folder, measure::HairCache& cache) {
    const auto write = [&](const std::string& name, const auto& writer) {
        engine::writeFileAtomically(folder / name, writer, engine::checkInterrupted);
    };
    if (settings.shading.model == hair::ShadingModel::extension)
        throw engine::Error(
            scene.path.string(),
            "/shading/model: " + settings.shading.model_file +
                " is the scene's own, and only fibres can be path-traced: set another model");
    if (settings.copies.count > 1)
        throw engine::Error(
            scene.path.string(), "/copies/count: a path-traced reference has one head");
    MitsubaParts parts;
    MitsubaExport result;
    measure::Case played(device, settings, scene.directory, &cache);
    play(device, played, frame);
    if (settings.render.hair) {
        const hair::rendering::StrandPoints drawn = played.strands();
        const hair::groom::StrandSet strands = measure::drawnStrands(drawn);
        if (strands.ends.empty()) throw engine::Error(scene.path.string(), "no strands are drawn");
        parts.hair_file = "hair.txt";
        write(parts.hair_file, [&](std::ostream& out) { writeMitsubaCurves(out, strands); });
        if (drawn.plan.own_colors) {
            parts.absorption_file = "absorption.exr";
            writeMitsubaAbsorption(
                folder / parts.absorption_file, strands, measure::drawnPowers(drawn),
                hair::rendering::absorption(hair::rendering::wetted(settings).shading));
        }
        result.strands = strands.strandCount();
        result.points = strands.points.size();
        result.orientation_spread = orientationSpread(strands);
    }
    parts.meshes = writeMeshes(folder, scene, settings, played);
    for (const MitsubaParts::Mesh& mesh : parts.meshes) result.triangles += mesh.triangles;
    parts.environment_file = copyEnvironment(folder, scene, settings);
    write("scene.xml", [&](std::ostream& out) { writeMitsubaScene(out, settings, parts); });
    return result;
}

namespace {

// ---- Path tracing -------------------------------------------------------------------------------

// The tool writes the line "passes <number of passes>", then "pass <samples before it>" at the
// start of each.
class PassProgress {
public:
    explicit PassProgress(std::uint32_t samples) : samples_(samples) {}
    ~PassProgress() {
        if (progress_) progress_->clear();
    }

    void line(std::string_view text) {
        std::istringstream words{std::string(text)};
        std::string what;
        std::size_t number = 0;
        words >> what >> number;
        if (what == "passes") progress_.emplace(number);
        if (what == "pass" && progress_)
            progress_->begin(
                std::to_string(number) + " of " + std::to_string(samples_) + " samples per pixel");
    }

private:
    std::uint32_t samples_;
    std::optional<measure::Progress> progress_;
};

}  // namespace

void traceMitsuba(
    const std::filesystem::path& folder, std::uint32_t samples, const std::filesystem::path& out) {
    PassProgress progress(samples);
    const std::filesystem::path traced = folder / ("traced" + out.extension().string());
    runReferenceTool(
        "render.py", {(folder / "scene.xml").string(), traced.string(), std::to_string(samples)},
        [&](std::string_view line) { progress.line(line); });
    engine::writeFileAtomically(out, engine::readFile(traced));
}

}  // namespace benchmarks::reference
