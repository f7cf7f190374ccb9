#include "benchmarks/mitsuba_scene.h"

#include <algorithm>

#include "benchmarks/mitsuba_lights.h"
#include "benchmarks/mitsuba_xml.h"
#include "hair/rendering/hair_color.h"
#include "hair/rendering/working_color.h"

namespace benchmarks {
namespace {

// Fair hair is seen through many fibres: paths are long, and end by chance only late.
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
        << "    " << element("float", "near_clip", camera.near_plane) << "    "
        << element("float", "far_clip", camera.far_plane) << "    <transform name=\"to_world\">\n"
        << "        <lookat origin=\"" << decimalTexts(camera.position, ", ") << "\" target=\""
        << decimalTexts(camera.target, ", ") << "\" up=\"" << decimalTexts(camera.up, ", ")
        << "\"/>\n    </transform>\n"
        << "    <sampler type=\"independent\">\n"
        << "        <integer name=\"sample_count\" value=\"$spp\"/>\n    </sampler>\n"
        << "    <film type=\"hdrfilm\">\n"
        << "        <integer name=\"width\" value=\"" << settings.render.width << "\"/>\n"
        << "        <integer name=\"height\" value=\"" << settings.render.height << "\"/>\n"
        << "        <string name=\"pixel_format\" value=\"rgb\"/>\n"
        << "        <string name=\"component_format\" value=\"float32\"/>\n"
        << "        <rfilter type=\"box\"/>\n    </film>\n</sensor>\n";
}

void writeHair(std::ostream& out, const hair::ShadingSettings& shading, const std::string& file) {
    const glm::dvec3 absorbed = hair::absorption(shading);
    // Mitsuba takes colours up to 1 here, and a factor.
    const double scale = std::max({absorbed.x, absorbed.y, absorbed.z, 1.0});
    out << "<shape type=\"bsplinecurve\">\n    " << element("string", "filename", file)
        << "    <bsdf type=\"hair\">\n        " << rgb("sigma_a", absorbed / scale) << "        "
        << element("float", "scale", scale) << "        "
        << element("float", "longitudinal_roughness", shading.longitudinal_roughness) << "        "
        << element("float", "azimuthal_roughness", shading.azimuthal_roughness)
        << "        "
        // Mitsuba's scales open towards the root of a curve that begins there; hair's do not.
        << element("float", "scale_tilt", -shading.cuticle_tilt) << "        "
        << element("float", "int_ior", shading.refractive_index) << "        "
        << element("float", "ext_ior", 1.0) << "    </bsdf>\n</shape>\n";
}

// A picture's rows go down as its v does, in Mitsuba as in glTF.
void writeColor(std::ostream& out, const char* name, const MitsubaParts::Mesh& mesh) {
    if (mesh.texture.empty()) {
        out << rgb(name, hair::toLinear(mesh.color));
        return;
    }
    out << "<texture type=\"bitmap\" name=\"" << name << "\">\n            "
        << element("string", "filename", mesh.texture) << "            "
        << element("string", "wrap_mode", mesh.wrap) << "        </texture>\n";
}

void writeMatt(std::ostream& out, const MitsubaParts::Mesh& mesh) {
    out << "<bsdf type=\"diffuse\">\n        ";
    writeColor(out, "reflectance", mesh);
    out << "    </bsdf>\n";
}

void writeGlossy(std::ostream& out, const MitsubaParts::Mesh& mesh) {
    out << "<bsdf type=\"principled\">\n        ";
    writeColor(out, "base_color", mesh);
    out << "        " << element("float", "metallic", mesh.metallic) << "        "
        << element("float", "roughness", mesh.roughness) << "    </bsdf>\n";
}

// Where light is added up in display RGB, ours are matt.
void writeMesh(
    std::ostream& out, const hair::RenderSettings& render, const MitsubaParts::Mesh& mesh) {
    out << "<shape type=\"ply\">\n    " << element("string", "filename", mesh.file) << "    ";
    if (mesh.two_sided) out << "<bsdf type=\"twosided\">\n    ";
    hair::hasLinearLight(render) ? writeGlossy(out, mesh) : writeMatt(out, mesh);
    if (mesh.two_sided) out << "    </bsdf>\n";
    out << "</shape>\n";
}

}  // namespace

void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts) {
    out << kBegin;
    writeCamera(out, settings);
    writeMitsubaLights(out, settings, parts.environment_file);
    if (!parts.hair_file.empty()) writeHair(out, settings.shading, parts.hair_file);
    for (const MitsubaParts::Mesh& mesh : parts.meshes) writeMesh(out, settings.render, mesh);
    out << "</scene>\n";
}

}  // namespace benchmarks
