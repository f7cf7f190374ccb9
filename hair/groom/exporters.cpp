#include "hair/groom/exporters.h"

#include "engine/error.h"
#include "engine/write_file.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/formats/export_gltf.h"
#include "hair/groom/formats/export_hair.h"
#include "hair/groom/formats/export_hgl.h"
#include "hair/groom/formats/export_obj.h"
#include "hair/groom/formats/export_ply.h"
#include "hair/groom/formats/export_tfx.h"
#include "hair/groom/formats/export_usda.h"

namespace hair {
namespace {

constexpr StrandExporter kExporters[] = {
    {".hair", exportHair}, {".hgl", exportHgl},   {".tfx", exportTfx}, {".obj", exportObj},
    {".ply", exportPly},   {".gltf", exportGltf}, {".glb", exportGlb}, {".usda", exportUsda},
};

}  // namespace

std::span<const StrandExporter> strandExporters() { return kExporters; }

const StrandExporter& strandExporterOf(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    std::string known;
    for (const StrandExporter& exporter : kExporters) {
        if (exporter.extension == extension) return exporter;
        known.append(known.empty() ? "" : ", ").append(exporter.extension);
    }
    throw engine::Error(
        path.string(), "strands can't be written as \"" + extension + "\"; known are " + known);
}

std::vector<std::string> exportStrands(
    const StrandSet& strands, const std::filesystem::path& path, const engine::WritePoll& poll) {
    const StrandExporter& exporter = strandExporterOf(path);
    std::vector<std::string> warnings;
    const auto write = [&](std::ostream& out) {
        try {
            warnings = exporter.write(strands, out);
        } catch (const engine::Error& error) {
            throw engine::Error(path.string(), error.what());
        }
    };
    engine::writeFileAtomically(path, write, poll);
    return warnings;
}

}  // namespace hair
