#include "benchmarks/mitsuba_scene.h"

#include <algorithm>
#include <type_traits>

#include "benchmarks/decimal_text.h"
#include "benchmarks/mitsuba_optics.h"

namespace benchmarks {
namespace {

template <class Value>
std::string element(const char* type, const char* name, const Value& value) {
    std::string text;
    if constexpr (std::is_arithmetic_v<Value>) {
        text = decimalText(value);
    } else {
        text = value;
    }
    return std::string("<") + type + " name=\"" + name + "\" value=\"" + text + "\"/>\n";
}

std::string rgb(const char* name, const glm::dvec3& linear) {
    return element("rgb", name, decimalTexts(linear, ", "));
}

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

void writeLights(std::ostream& out, const hair::Settings& settings) {
    if (settings.render.background != glm::vec3(0.0f)) {
        out << "<emitter type=\"constant\">\n    "
            << rgb("radiance", toLinear(settings.render.background)) << "</emitter>\n";
    }
    for (const hair::LightSettings& light : settings.shading.lights)
        out << "<emitter type=\"point\">\n    <point name=\"position\" value=\""
            << decimalTexts(light.position, ", ") << "\"/>\n    "
            << rgb("intensity", lightIntensity(light, settings.camera.target)) << "</emitter>\n";
}

void writeHair(std::ostream& out, const hair::Settings& settings, const std::string& file) {
    const glm::dvec3 absorption = absorptionOf(toLinear(settings.shading.color), kHairRoughness);
    // Mitsuba takes colours up to 1 here, and a factor.
    const double scale = std::max({absorption.x, absorption.y, absorption.z, 1.0});
    out << "<shape type=\"bsplinecurve\">\n    " << element("string", "filename", file)
        << "    <bsdf type=\"hair\">\n        " << rgb("sigma_a", absorption / scale) << "        "
        << element("float", "scale", scale) << "        "
        << element("float", "longitudinal_roughness", kHairRoughness) << "        "
        << element("float", "azimuthal_roughness", kHairRoughness) << "    </bsdf>\n</shape>\n";
}

}  // namespace

void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts) {
    out << kBegin;
    writeCamera(out, settings);
    writeLights(out, settings);
    if (!parts.hair_file.empty()) writeHair(out, settings, parts.hair_file);
    for (const MitsubaParts::Mesh& mesh : parts.meshes) {
        out << "<shape type=\"ply\">\n    " << element("string", "filename", mesh.file)
            << "    <bsdf type=\"diffuse\">\n        " << rgb("reflectance", toLinear(mesh.color))
            << "    </bsdf>\n</shape>\n";
    }
    out << "</scene>\n";
}

}  // namespace benchmarks
