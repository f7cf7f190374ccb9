#include "tests/path_tracer/mitsuba_folder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/float_pictures.h"
#include "hair/rendering/fiber.h"
#include "hair/shading_settings.h"

namespace {

using namespace hair::reference;

// ---- XML ----------------------------------------------------------------------------------------

// An XML element of writeMitsubaScene(), which writes neither text nor comments.
struct Element {
    std::string tag;
    std::map<std::string, std::string> attributes;
    std::vector<Element> children;

    std::string attribute(const std::string& name) const {
        const auto found = attributes.find(name);
        return found == attributes.end() ? "" : found->second;
    }
    bool is(std::string_view its_tag, std::string_view type) const {
        return tag == its_tag && attribute("type") == type;
    }
    // Returns the child with this name, or null.
    const Element* find(std::string_view name) const {
        for (const Element& child : children)
            if (child.attribute("name") == name) return &child;
        return nullptr;
    }
    const Element& child(std::string_view its_tag) const {
        for (const Element& child : children)
            if (child.tag == its_tag) return child;
        throw std::runtime_error("<" + tag + "> has no <" + std::string(its_tag) + ">");
    }
    std::string value(std::string_view name) const {
        const Element* const found = find(name);
        if (!found) throw std::runtime_error("<" + tag + "> has no " + std::string(name));
        return found->attribute("value");
    }
    double number(std::string_view name) const { return std::stod(value(name)); }
};

class XmlReader {
public:
    explicit XmlReader(std::string text) : text_(std::move(text)) {
        at_ = text_.find("?>") + 2;
        at_ = text_.find('<', at_);
    }

    // Reads the element that begins here, and moves past it.
    Element read() {
        Element element;
        ++at_;
        element.tag = word();
        for (skip(); text_.at(at_) != '>' && text_.at(at_) != '/'; skip()) {
            const std::string name = word();
            at_ = text_.find('"', at_) + 1;
            const std::size_t end = text_.find('"', at_);
            element.attributes[name] = text_.substr(at_, end - at_);
            at_ = end + 1;
        }
        const bool empty = text_.at(at_) == '/';
        at_ = text_.find('>', at_) + 1;
        if (empty) return element;
        for (skip(); text_.compare(at_, 2, "</") != 0; skip()) element.children.push_back(read());
        at_ = text_.find('>', at_) + 1;
        return element;
    }

private:
    void skip() { at_ = text_.find_first_not_of(" \n", at_); }
    std::string word() {
        const std::size_t begin = at_;
        at_ = text_.find_first_of(" \n=/>", at_);
        return text_.substr(begin, at_ - begin);
    }

    std::string text_;
    std::size_t at_ = 0;
};

glm::dvec3 vectorOf(std::string text) {
    std::ranges::replace(text, ',', ' ');
    std::istringstream numbers(text);
    glm::dvec3 vector;
    if (!(numbers >> vector.x >> vector.y >> vector.z))
        throw std::runtime_error("not three numbers: " + text);
    return vector;
}

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": can't be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

// ---- Geometry -----------------------------------------------------------------------------------

// Reads lines "x y z radius" with an empty line after each strand.
std::vector<std::vector<glm::dvec4>> readCurves(const std::filesystem::path& path) {
    std::istringstream lines(contentOf(path));
    std::vector<std::vector<glm::dvec4>> curves(1);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream numbers(line);
        glm::dvec4 point;
        if (numbers >> point.x >> point.y >> point.z >> point.w) {
            curves.back().push_back(point);
        } else if (!curves.back().empty()) {
            curves.emplace_back();
        }
    }
    if (curves.back().empty()) curves.pop_back();
    return curves;
}

// Reads a file of writeMaterialPly(): ASCII, positions, normals and, if any, texture coordinates.
MattMesh readPly(const std::filesystem::path& path) {
    std::istringstream file(contentOf(path));
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t properties = 0;
    for (std::string line; std::getline(file, line) && line != "end_header";) {
        if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
        if (line.starts_with("element face ")) triangles = std::stoul(line.substr(13));
        if (line.starts_with("property float ")) ++properties;
    }
    MattMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) {
        std::vector<double> values(properties);
        for (double& value : values) file >> value;
        mesh.positions.emplace_back(values.at(0), values.at(1), values.at(2));
        mesh.normals.push_back(
            glm::normalize(glm::dvec3(values.at(3), values.at(4), values.at(5))));
    }
    for (std::size_t i = 0; i < triangles; ++i) {
        std::uint32_t corners = 0;
        auto& triangle = mesh.triangles.emplace_back();
        file >> corners >> triangle[0] >> triangle[1] >> triangle[2];
    }
    if (!file) throw std::runtime_error(path.string() + ": ends too early");
    return mesh;
}

// ---- Scenes -------------------------------------------------------------------------------------

TracedCamera readCamera(const Element& sensor) {
    const Element& view = sensor.child("transform").child("lookat");
    const Element& film = sensor.child("film");
    return {
        .position = vectorOf(view.attribute("origin")),
        .target = vectorOf(view.attribute("target")),
        .up = vectorOf(view.attribute("up")),
        .field_of_view = sensor.number("fov"),
        .width = static_cast<std::uint32_t>(film.number("width")),
        .height = static_cast<std::uint32_t>(film.number("height"))};
}

hair::rendering::Fiber readFiber(const Element& bsdf) {
    hair::ShadingSettings shading;
    shading.longitudinal_roughness = static_cast<float>(bsdf.number("longitudinal_roughness"));
    shading.azimuthal_roughness = static_cast<float>(bsdf.number("azimuthal_roughness"));
    shading.cuticle_tilt = static_cast<float>(-bsdf.number("scale_tilt"));
    shading.refractive_index = static_cast<float>(bsdf.number("int_ior"));
    hair::rendering::Fiber fiber = hair::rendering::makeFiber(shading);
    if (bsdf.find("sigma_a")->tag == "rgb")
        fiber.absorption = bsdf.number("scale") * vectorOf(bsdf.value("sigma_a"));
    return fiber;
}

// The picture of writeMitsubaAbsorption(), if there is one.
std::vector<glm::dvec3> readAbsorptions(const Element& bsdf, const std::filesystem::path& folder) {
    std::vector<glm::dvec3> absorptions;
    const Element& sigma = *bsdf.find("sigma_a");
    if (sigma.tag != "texture") return absorptions;
    const std::vector<float> rgb = engine::readFloatImage(folder / sigma.value("filename")).rgb;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        absorptions.emplace_back(rgb[i], rgb[i + 1], rgb[i + 2]);
    return absorptions;
}

MattMesh readMesh(const Element& shape, const std::filesystem::path& folder) {
    MattMesh mesh = readPly(folder / shape.value("filename"));
    const Element* bsdf = &shape.child("bsdf");
    if (bsdf->is("bsdf", "twosided")) {
        mesh.sides = MattMesh::Sides::both;
        bsdf = &bsdf->child("bsdf");
    }
    const Element* const color =
        bsdf->find(bsdf->is("bsdf", "diffuse") ? "reflectance" : "base_color");
    if (!color || color->tag != "rgb")
        throw std::runtime_error(shape.value("filename") + " has no plain colour");
    mesh.reflectance = vectorOf(color->attribute("value"));
    return mesh;
}

void readShape(const Element& shape, const std::filesystem::path& folder, TracedScene& scene) {
    if (shape.is("shape", "bsplinecurve")) {
        scene.curves = readCurves(folder / shape.value("filename"));
        scene.fiber = readFiber(shape.child("bsdf"));
        scene.absorptions = readAbsorptions(shape.child("bsdf"), folder);
    } else if (shape.is("shape", "sphere")) {
        scene.spheres.push_back(
            {vectorOf(shape.value("center")), shape.number("radius"),
             vectorOf(shape.child("emitter").value("radiance"))});
    } else {
        scene.meshes.push_back(readMesh(shape, folder));
    }
}

void readEmitter(const Element& emitter, TracedScene& scene) {
    if (emitter.is("emitter", "point")) {
        scene.points.push_back(
            {vectorOf(emitter.value("position")), vectorOf(emitter.value("intensity"))});
    } else if (emitter.is("emitter", "directional")) {
        scene.directions.push_back(
            {glm::normalize(vectorOf(emitter.value("direction"))),
             vectorOf(emitter.value("irradiance"))});
    } else if (emitter.is("emitter", "constant")) {
        scene.background = vectorOf(emitter.value("radiance"));
    } else {
        throw std::runtime_error("the emitter " + emitter.attribute("type") + " is not traced");
    }
}

}  // namespace

TracedFolder readMitsubaFolder(const std::filesystem::path& folder) {
    TracedFolder traced;
    for (const Element& element : XmlReader(contentOf(folder / "scene.xml")).read().children) {
        if (element.tag == "sensor") traced.camera = readCamera(element);
        if (element.tag == "emitter") readEmitter(element, traced.scene);
        if (element.tag == "shape") readShape(element, folder, traced.scene);
    }
    return traced;
}
