#include "benchmarks/viewer/files/scene_file.h"

#include <algorithm>

#include "benchmarks/screenshot_scene.h"
#include "benchmarks/viewer/files/dropped_groom.h"
#include "benchmarks/viewer/files/strands_or_triangles.h"
#include "engine/error.h"
#include "engine/image_file.h"
#include "hair/fields.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/formats/utf8.h"
#include "hair/groom/importers.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks {

namespace {

namespace fs = std::filesystem;
using engine::Error;

// One that is damaged counts: opening it says how.
bool hasScene(const fs::path& picture) {
    try {
        return sceneOfScreenshot(picture).has_value();
    } catch (const Error&) {
        return true;
    }
}

bool isMesh(const std::string& extension) {
    return std::ranges::any_of(hair::meshImporters(), [&](const hair::MeshImporter& importer) {
        return std::ranges::count(importer.extensions, extension) > 0;
    });
}

bool isGroom(const fs::path& file) {
    try {
        hair::strandImporterOf(file);  // knows some by their first bytes
        return true;
    } catch (const Error&) {
        return false;
    }
}

// What settings call a file: relative to the folder if it is below it, otherwise absolute.
std::string nameIn(const fs::path& directory, const fs::path& file) {
    const fs::path folder = fs::weakly_canonical(directory.empty() ? fs::path(".") : directory);
    const fs::path absolute =
        fs::weakly_canonical(fs::absolute(file).parent_path()) / file.filename();
    const fs::path relative = absolute.lexically_relative(folder);
    const bool below = !relative.empty() && *relative.begin() != "..";
    std::string name = (below ? relative : absolute).generic_string();
    if (!hair::isUtf8(name)) throw Error(file.string(), "its name is not UTF-8");
    return name;
}

void addMesh(hair::RenderSettings& render, const fs::path& file, const std::string& name) {
    const hair::Field& field = hair::fieldAt(render, &render.meshes);
    const std::size_t most = std::get<hair::List>(field.kind).maximum_count;
    if (render.meshes.size() >= most)
        throw Error(
            file.string(), "there are " + std::to_string(most) + " meshes already, the most");
    hair::importMesh(file);
    render.meshes.push_back({.file = name});
}

}  // namespace

SceneFile openScene(const fs::path& path) {
    const Scene scene = loadScene(path);
    return {scene.path, scene.directory, scene.name, scene.settings};
}

Dropped whatIs(const fs::path& file) {
    const std::string extension = hair::lowerCaseExtension(file);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return Dropped::unknown;
    if (extension == ".json") return Dropped::scene;
    if (extension == ".png") return hasScene(file) ? Dropped::scene : Dropped::unknown;
    if (extension == ".exr" || extension == ".hdr") return Dropped::environment;
    const bool groom = isGroom(file);
    if (groom && isMesh(extension))
        return strandsOrTriangles(file) == Holds::strands ? Dropped::groom : Dropped::mesh;
    return groom ? Dropped::groom : isMesh(extension) ? Dropped::mesh : Dropped::unknown;
}

hair::Settings
withDropped(hair::Settings settings, const fs::path& directory, const fs::path& file) {
    const Dropped kind = whatIs(file);
    if (kind == Dropped::unknown || kind == Dropped::scene) {
        std::error_code error;
        throw Error(
            file.string(), fs::is_regular_file(file, error)
                               ? "is no groom, mesh or environment (.exr, .hdr)"
                               : "no such file");
    }
    const std::string name = nameIn(directory, file);
    if (kind == Dropped::groom) return withGroom(std::move(settings), directory, file, name);
    if (kind == Dropped::mesh) {
        addMesh(settings.render, file, name);
    } else {
        engine::readFloatImage(file);
        settings.render.environment = name;
    }
    return settings;
}

}  // namespace benchmarks
