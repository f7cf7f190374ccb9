#include "hair/groom/build_groom.h"

#include <array>

#include "engine/error.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/grow.h"
#include "hair/groom/import_hgl.h"

namespace hair {
namespace {

constexpr std::array groom_importers{
    GroomImporter{".hgl", importHgl},
};

Groom importGroom(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    std::string known;
    for (const GroomImporter& importer : groom_importers) {
        if (importer.extension == extension) return importer.import(path);
        known.append(known.empty() ? "" : ", ").append(importer.extension);
    }
    throw engine::Error(
        path.string(), "unknown guide format '" + extension + "'; known are " + known);
}

}  // namespace

std::span<const GroomImporter> groomImporters() { return groom_importers; }

Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed) {
    if (!settings.file.empty()) return importGroom(directory / settings.file);
    const std::string path = (directory / settings.grow.mesh).string();
    if (!mesh) throw engine::Error(path, "guides are to be grown, but there is no mesh");
    try {
        return grow(*mesh, settings.grow, settings.guides, seed);
    } catch (const engine::Error& error) {
        throw engine::Error(path, error.what());
    }
}

}  // namespace hair
