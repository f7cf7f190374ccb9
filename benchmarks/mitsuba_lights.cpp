#include "benchmarks/mitsuba_lights.h"

#include <numbers>

#include "benchmarks/mitsuba_optics.h"
#include "benchmarks/mitsuba_xml.h"
#include "hair/rendering/working_color.h"

namespace benchmarks {
namespace {

void writePoint(std::ostream& out, const glm::vec3& position, const glm::dvec3& intensity) {
    out << "<emitter type=\"point\">\n    <point name=\"position\" value=\""
        << decimalTexts(position, ", ") << "\"/>\n    " << rgb("intensity", intensity)
        << "</emitter>\n";
}

void writeSphere(std::ostream& out, const hair::LightSettings& light, const glm::dvec3& radiance) {
    out << "<shape type=\"sphere\">\n    <point name=\"center\" value=\""
        << decimalTexts(light.position, ", ") << "\"/>\n    "
        << element("float", "radius", light.radius) << "    <emitter type=\"area\">\n        "
        << rgb("radiance", radiance) << "    </emitter>\n</shape>\n";
}

// Irradiance is pi times the colour.
void writeDirectional(std::ostream& out, const glm::vec3& direction, const glm::dvec3& irradiance) {
    out << "<emitter type=\"directional\">\n    "
        << element("vector", "direction", decimalTexts(direction, ", ")) << "    "
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
    } else {
        writePoint(out, light.position, lightIntensity(light, color, target));
    }
}

// Mitsuba's pictures of surroundings lie as ours do: +y up, their middle at +z, their right at -x.
void writeEnvironment(
    std::ostream& out, const hair::RenderSettings& render, const std::string& file) {
    out << "<emitter type=\"envmap\">\n    " << element("string", "filename", file) << "    "
        << element("float", "scale", render.environment_strength)
        << "    <transform name=\"to_world\">\n        <rotate y=\"1\" angle=\""
        << decimalText(render.environment_turn) << "\"/>\n    </transform>\n</emitter>\n";
}

}  // namespace

void writeMitsubaLights(
    std::ostream& out, const hair::Settings& settings, const std::string& environment_file) {
    if (!environment_file.empty()) {
        writeEnvironment(out, settings.render, environment_file);
    } else if (settings.render.background != glm::vec3(0.0f)) {
        out << "<emitter type=\"constant\">\n    "
            << rgb("radiance", hair::toLinear(settings.render.background)) << "</emitter>\n";
    }
    for (const hair::LightSettings& light : settings.shading.lights)
        writeLight(out, settings, light);
}

}  // namespace benchmarks
