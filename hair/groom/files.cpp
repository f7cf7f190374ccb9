#include "hair/groom/files.h"

#include <array>
#include <memory>

#include "engine/error.h"
#include "hair/groom/formats/cyhair.h"
#include "hair/groom/formats/gltf.h"
#include "hair/groom/formats/hgl.h"
#include "hair/groom/formats/npy.h"
#include "hair/groom/formats/obj.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/strand_lists.h"
#include "hair/groom/formats/tfx.h"
#include "hair/groom/formats/usd_export.h"
#include "hair/groom/formats/usd_import.h"

namespace hair::groom {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr StrandExporter kExporters[] = {
    {".hair", exportHair},     {".hgl", exportHgl},   {".tfx", exportTfx}, {".obj", exportObj},
    {".ply", exportPly},       {".gltf", exportGltf}, {".glb", exportGlb}, {".usda", exportUsda},
    {".data", exportHairData}, {".npy", exportNpy},   {".npz", exportNpz},
};

constexpr std::array kHair{".hair"sv};
constexpr std::array kTfx{".tfx"sv};
constexpr std::array kHgl{".hgl"sv};
constexpr std::array kPly{".ply"sv};
constexpr std::array kObj{".obj"sv};
constexpr std::array kGlb{".glb"sv};
constexpr std::array kGltf{".gltf"sv};
constexpr std::array kUsd{".usd"sv, ".usda"sv, ".usdc"sv, ".usdz"sv};

constexpr std::array kData{".data"sv};
constexpr std::array kNpy{".npy"sv};
constexpr std::array kNpz{".npz"sv};
constexpr std::array kBin{".bin"sv};

constexpr auto kTfxVersion = "\0\0\x80\x40"sv;  // 4.0f

constexpr StrandImporter kImporters[] = {
    {"Cem Yuksel's HAIR", kHair, "HAIR", importHair},
    {"TressFX", kTfx, kTfxVersion, importTfx},
    {"thesis guides", kHgl, "", importHgl},
    {"PLY", kPly, "ply", importPly},
    {"OBJ", kObj, "", importObj},
    {"glTF", kGltf, "", importGltfStrands},
    {"binary glTF", kGlb, "glTF", importGltfStrands},
    // Has three magics, but its library goes by the extension.
    {"USD", kUsd, "", importUsd, false},
    {"USC-HairSalon's strands", kData, "", importHairData},
    {"NumPy's array", kNpy, "\x93NUMPY", importNpy},
    // .usdz is a zip archive, too.
    {"NumPy's archive", kNpz, "", importNpz},
    {"CT2Hair's strands", kBin, "", importCt2Hair},
};

const StrandImporter& importerOf(const fs::path& path, engine::OpenFile& file) {
    std::array<char, 8> bytes{};  // longer than every magic
    file.read(std::span(bytes).first(std::min<std::uintmax_t>(file.size(), bytes.size())));
    const std::string_view head(bytes.data(), bytes.size());
    const std::string extension = lowerCaseExtension(path);
    for (const StrandImporter& importer : kImporters)
        if (!importer.magic.empty() && head.starts_with(importer.magic)) return importer;
    for (const StrandImporter& importer : kImporters)
        if (std::ranges::find(importer.extensions, extension) != importer.extensions.end())
            return importer;
    throw engine::Error(
        path.string(),
        "unknown format of strands \"" + extension + "\"; known are " + readExtensions());
}

}  // namespace

// ---- Exporters ----------------------------------------------------------------------------------

std::span<const StrandExporter> strandExporters() { return kExporters; }

std::string writtenExtensions() {
    std::string all;
    for (const StrandExporter& exporter : kExporters)
        all.append(all.empty() ? "" : ", ").append(exporter.extension);
    return all;
}

const StrandExporter& strandExporterOf(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    for (const StrandExporter& exporter : kExporters)
        if (exporter.extension == extension) return exporter;
    throw engine::Error(
        path.string(),
        "strands can't be written as \"" + extension + "\"; known are " + writtenExtensions());
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

// ---- Importers ----------------------------------------------------------------------------------

std::span<const StrandImporter> strandImporters() { return kImporters; }

std::string readExtensions() {
    std::string all;
    for (const StrandImporter& importer : kImporters)
        for (const std::string_view extension : importer.extensions)
            all.append(all.empty() ? "" : ", ").append(extension);
    return all;
}

const StrandImporter& strandImporterOf(const fs::path& path) {
    engine::OpenFile file(path);
    return importerOf(path, file);
}

StrandSet importStrands(const fs::path& path, std::uint32_t points_per_strand) {
    engine::OpenFile file(path);
    const StrandImporter& importer = importerOf(path, file);
    // The bytes are not filled with zeros first: grooms have hundreds of megabytes.
    const std::size_t size = importer.from_memory ? file.size() : 0;
    const auto storage = std::make_unique_for_overwrite<char[]>(size);
    const std::span bytes(storage.get(), size);
    file.read(bytes);
    try {
        return importer.read(
            {.bytes = std::as_bytes(bytes), .path = path, .points_per_strand = points_per_strand});
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace hair::groom
