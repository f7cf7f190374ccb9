#include "hair/groom/files.h"

#include <array>
#include <memory>
#include <set>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/formats/formats.h"
#include "hair/groom/formats/npy.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/usd_export.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/groom/other_formats.h"

namespace hair::groom {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr StrandExporter kExporters[] = {
    {".hair", exportHair},
    {".hgl", exportHgl},
    {".tfx", exportTfx},
    {".obj", exportObj},
    {".ply", exportPly},
    {".gltf", exportGltf},
    {".glb", exportGlb},
    {".usda", exportUsda, exportUsdaWith},
    {".usdc", exportUsdc, exportUsdcWith},
    {".data", exportHairData},
    {".npy", exportNpy},
    {".npz", exportNpz},
    {".abc", exportAlembic, exportAlembicWith},
    {".mitshair", exportMitsubaBinary},
    {".txt", exportMitsubaText},
    {".pbrt", exportPbrt},
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
constexpr std::array kXml{".xml"sv};
constexpr std::array kBin{".bin"sv};
constexpr std::array kAbc{".abc"sv};
constexpr std::array kMitsuba{".mitshair"sv, ".txt"sv};
constexpr std::array kPbrt{".pbrt"sv};

constexpr auto kTfxVersion = "\0\0\x80\x40"sv;   // 4.0f
constexpr auto kTfx3Version = "\0\0\x40\x40"sv;  // 3.0f

constexpr StrandImporter kImporters[] = {
    {"Cem Yuksel's HAIR", kHair, "HAIR", importHair},
    {"TressFX", kTfx, kTfxVersion, importTfx},
    {"TressFX version 3", kTfx, kTfx3Version, importTfx},
    {"TressFX version 2", kTfx, "version ", importTfx},
    {"thesis guides", kHgl, "", importHgl},
    {"PLY", kPly, "ply", importPly},
    {"OBJ", kObj, "", importObj},
    {"glTF", kGltf, "", importGltfStrands},
    {"binary glTF", kGlb, "glTF", importGltfStrands},
    // USD has three magics, but its library recognises files by their extension.
    {"USD", kUsd, "", importUsd, false, nullptr, importUsdCache},
    {"USC-HairSalon's strands", kData, "", importHairData},
    {"NumPy's array", kNpy, "\x93NUMPY", importNpy},
    // It has no magic here, because .usdz is a zip archive too.
    {"NumPy's archive", kNpz, "", importNpz},
    {"Embree's scene", kXml, "", importEmbreeXml},
    {"CT2Hair's strands", kBin, "", importCt2Hair},
    {"Alembic", kAbc, "Ogawa", importAlembic, true, nullptr, importAlembicCache},
    {"Mitsuba's hair", kMitsuba, "BINARY_HAIR", importMitsubaHair},
    {"Mitsuba's hair in text", kMitsuba, "", importMitsubaHair},
    {"pbrt's scene", kPbrt, "", importPbrt},
    {"MonoHair's strands", kHair, "", importCountedHair, true, looksLikeCountedHair},
    {"Mitsuba's hair in text", kHair, "", importMitsubaHair, true, looksLikeMitsubaText},
};

// Throws for a file that begins like those of another format. A file with an extension of ours may
// begin with a count of any value, so only a certain row refuses it.
void refuseOther(
    const fs::path& path, std::string_view head, std::string_view extension, bool is_ours) {
    const OtherFile* const other = recognise(head, extension);
    if (!other || (is_ours && !other->is_certain)) return;
    throw engine::Error(path.string(), other->text() + "; known: " + readExtensions());
}

const StrandImporter& importerOf(const fs::path& path, engine::OpenFile& file) {
    std::array<char, kRecognisedBytes> bytes{};  // longer than every magic
    const auto own = std::span(bytes).first(std::min<std::uintmax_t>(file.size(), bytes.size()));
    file.read(own);
    const std::string_view head(bytes.data(), bytes.size());
    const std::string extension = lowerCaseExtension(path);
    // A pointer of Git LFS begins like a text of TressFX.
    if (const OtherFile* const other = recognise(head, extension);
        other && other->is_certain && head.starts_with("version "))
        refuseOther(path, head, extension, true);
    for (const StrandImporter& importer : kImporters)
        if (!importer.magic.empty() && head.starts_with(importer.magic)) return importer;
    const StrandImporter* by_extension = nullptr;
    for (const StrandImporter& importer : kImporters) {
        const bool has_it =
            std::ranges::find(importer.extensions, extension) != importer.extensions.end();
        if (!has_it) continue;
        const bool looks_like =
            importer.looks_like && importer.looks_like(std::as_bytes(own), file.size());
        if (looks_like || !by_extension) by_extension = &importer;
        if (looks_like) break;
    }
    refuseOther(path, head, extension, by_extension != nullptr);
    if (by_extension) return *by_extension;
    throw engine::Error(
        path.string(), "unknown format of strands '" + extension + "'; known: " + readExtensions());
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
        "strands can't be written as '" + extension + "'; known: " + writtenExtensions());
}

std::vector<std::string> exportStrands(
    const StrandSet& strands, const std::filesystem::path& path, const engine::WritePoll& poll,
    const ExportExtras& extras) {
    const StrandExporter& exporter = strandExporterOf(path);
    std::vector<std::string> warnings;
    const auto write = [&](std::ostream& out) {
        try {
            warnings = exporter.write_with ? exporter.write_with(strands, extras, out)
                                           : exporter.write(strands, out);
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
    std::set<std::string_view> known;
    for (const StrandImporter& importer : kImporters)
        for (const std::string_view extension : importer.extensions)
            if (known.insert(extension).second)
                all.append(all.empty() ? "" : ", ").append(extension);
    return all;
}

const StrandImporter& strandImporterOf(const fs::path& path) {
    engine::OpenFile file(path);
    return importerOf(path, file);
}

namespace {

// Reads a file's bytes and returns what `read` makes of them: a function of the importer and the
// file. Errors get the path.
template <class Read>
auto readFile(
    const fs::path& path, std::uint32_t points_per_strand, const NamedFileCheck& check,
    const Read& read) {
    const engine::Step step("reads " + path.filename().string());
    engine::OpenFile file(path);
    const StrandImporter& importer = importerOf(path, file);
    // The bytes are not filled with zeros first, because grooms have hundreds of megabytes.
    const std::size_t size = importer.from_memory ? file.size() : 0;
    const auto storage = std::make_unique_for_overwrite<char[]>(size);
    const std::span bytes(storage.get(), size);
    file.read(bytes);
    try {
        return read(
            importer, StrandFile{
                          .bytes = std::as_bytes(bytes),
                          .path = path,
                          .points_per_strand = points_per_strand,
                          .check = orOwnFolder(check, path)});
    } catch (const engine::Error& error) {
        const std::string_view head(storage.get(), std::min<std::size_t>(size, kRecognisedBytes));
        throw engine::Error(path.string(), explained(error.what(), head, lowerCaseExtension(path)));
    }
}

}  // namespace

StrandSet importStrands(
    const fs::path& path, std::uint32_t points_per_strand, const NamedFileCheck& check,
    BadStrands bad) {
    return readFile(
        path, points_per_strand, check,
        [bad](const StrandImporter& importer, const StrandFile& file) {
            StrandSet strands = importer.read(file);
            if (bad == BadStrands::kept) return strands;
            return usableStrands(std::move(strands), bad);
        });
}

StrandSamples importStrandSamples(const fs::path& path, const NamedFileCheck& check) {
    return readFile(path, 0, check, [](const StrandImporter& importer, const StrandFile& file) {
        if (!importer.read_samples)
            throw engine::Error(
                std::string(importer.name) +
                " has no samples over time; formats that have: .abc, .usd, .usda, .usdc, "
                ".usdz");
        return importer.read_samples(file);
    });
}

// ---- Facts --------------------------------------------------------------------------------------

namespace {

constexpr FormatFact both(Fact fact, std::string_view how = {}) { return {fact, true, true, how}; }
constexpr FormatFact onlyRead(Fact fact, std::string_view how = {}) {
    return {fact, true, false, how};
}

constexpr auto kBySimulate = "written by `simulate --export`"sv;
constexpr auto kAnyLength = "of any length"sv;
constexpr auto kOneLength = "of one length"sv;
constexpr auto kPerPoint = "per point"sv;
constexpr auto kPerStrand = "per strand"sv;
constexpr auto kInColor = "in the colour"sv;

constexpr FormatFact kHairFacts[] = {
    both(Fact::strands, kAnyLength), both(Fact::widths, kPerPoint), both(Fact::colors, kPerPoint),
    both(Fact::transparencies, kPerPoint)};
constexpr FormatFact kTfxFacts[] = {
    both(Fact::strands, kOneLength), both(Fact::widths, kPerStrand), both(Fact::colors, kPerPoint),
    both(Fact::transparencies, kInColor), both(Fact::root_uvs)};
constexpr FormatFact kTfx3Facts[] = {
    onlyRead(Fact::strands, kOneLength), onlyRead(Fact::widths, kPerStrand),
    onlyRead(Fact::colors, kPerPoint), onlyRead(Fact::transparencies, kInColor),
    onlyRead(Fact::root_uvs)};
constexpr FormatFact kTfx2Facts[] = {onlyRead(Fact::strands, kAnyLength), onlyRead(Fact::root_uvs)};
constexpr FormatFact kHglFacts[] = {
    both(Fact::strands, kOneLength), both(Fact::unit, "m"), both(Fact::root_triangles)};
constexpr FormatFact kObjFacts[] = {both(Fact::strands, kAnyLength), both(Fact::colors, kPerPoint)};
constexpr FormatFact kGltfFacts[] = {
    both(Fact::strands, kAnyLength),
    onlyRead(Fact::guides, "in extras"),
    onlyRead(Fact::groups, "in extras"),
    both(Fact::widths, kPerPoint),
    both(Fact::colors, kPerPoint),
    both(Fact::transparencies, kPerPoint),
    both(Fact::unit, "m"),
    both(Fact::up, "+y")};
constexpr FormatFact kUsdaFacts[] = {
    both(Fact::strands, kAnyLength),
    both(Fact::guides),
    both(Fact::groups),
    both(Fact::widths, kPerPoint),
    both(Fact::colors, kPerPoint),
    both(Fact::transparencies, kPerPoint),
    both(Fact::root_uvs),
    both(Fact::unit, "any"),
    both(Fact::up, "+y; +z is read"),
    both(Fact::root_triangles),
    both(Fact::animation, kBySimulate)};
constexpr FormatFact kUsdFacts[] = {
    onlyRead(Fact::strands, kAnyLength),
    onlyRead(Fact::guides),
    onlyRead(Fact::groups),
    onlyRead(Fact::widths, kPerPoint),
    onlyRead(Fact::colors, kPerPoint),
    onlyRead(Fact::transparencies, kPerPoint),
    onlyRead(Fact::root_uvs),
    onlyRead(Fact::unit, "any"),
    onlyRead(Fact::up, "+y or +z"),
    onlyRead(Fact::root_triangles),
    onlyRead(Fact::animation)};
constexpr FormatFact kAlembicFacts[] = {
    both(Fact::strands, kAnyLength),
    both(Fact::guides),
    both(Fact::groups),
    both(Fact::widths, kPerPoint),
    both(Fact::colors, kPerPoint),
    both(Fact::root_uvs),
    both(Fact::unit, "own"),
    both(Fact::up, "own"),
    both(Fact::root_triangles, "own"),
    both(Fact::animation, kBySimulate)};
constexpr FormatFact kPointsFacts[] = {both(Fact::strands, kAnyLength)};
constexpr FormatFact kPointsReadFacts[] = {onlyRead(Fact::strands, kAnyLength)};
constexpr FormatFact kNpyFacts[] = {both(Fact::strands, kOneLength)};
constexpr FormatFact kNpzFacts[] = {
    both(Fact::strands, kOneLength), both(Fact::guides, "own"), both(Fact::groups, "own"),
    both(Fact::widths, "own, per point"), both(Fact::root_uvs)};
constexpr FormatFact kXmlFacts[] = {
    onlyRead(Fact::strands, kAnyLength), onlyRead(Fact::widths, kPerPoint)};

// Mitsuba's text and pbrt's curves.
constexpr FormatFact kCurvesFacts[] = {
    both(Fact::strands, kAnyLength), both(Fact::widths, kPerPoint)};

constexpr std::array kGltfs{".gltf"sv, ".glb"sv};
constexpr std::array kMitsubaBinary{".mitshair"sv};
constexpr std::array kMitsubaText{".txt"sv};
constexpr std::array kWrittenUsd{".usda"sv, ".usdc"sv};
constexpr std::array kReadUsd{".usd"sv, ".usdz"sv};

constexpr FormatFacts kFormatFacts[] = {
    {kHair, "Cem Yuksel's HAIR", kHairFacts},
    {kHair, "MonoHair's strands, without a header", kPointsReadFacts},
    {kTfx, "TressFX 4", kTfxFacts},
    {kTfx, "TressFX 3.1", kTfx3Facts},
    {kTfx, "TressFX 2, text", kTfx2Facts},
    {kHgl, "the thesis's", kHglFacts},
    {kPly, "vertices and edges, polylines, or points alone", kHairFacts},
    {kObj, "line elements", kObjFacts},
    {kGltfs, "line primitives", kGltfFacts},
    {kWrittenUsd, "BasisCurves, NurbsCurves", kUsdaFacts},
    {kReadUsd, "BasisCurves, NurbsCurves", kUsdFacts},
    {kAbc, "Alembic curves", kAlembicFacts},
    {kData, "USC-HairSalon, Hair20K", kPointsFacts},
    {kBin, "CT2Hair", kPointsReadFacts},
    {kNpy, "NumPy, (strands, points, 3)", kNpyFacts},
    {kNpz, "NumPy, names of DiffLocks", kNpzFacts},
    {kXml, "curves of Embree's tutorials", kXmlFacts},
    {kMitsubaBinary, "Mitsuba's hair, binary", kPointsFacts},
    {kMitsubaText, "Mitsuba's hair or curves, text", kCurvesFacts},
    {kPbrt, "curves of pbrt", kCurvesFacts},
};

constexpr std::array<std::string_view, static_cast<std::size_t>(Fact::count)> kFactNames{
    "strands",  "guides",  "groups", "widths", "colours",        "transparency",
    "root UVs", "normals", "unit",   "up",     "root triangles", "animation"};

// Returns a cell: "both, per point", "read"; empty for data that are neither read nor written.
std::string cellOf(const FormatFacts& format, Fact fact) {
    const auto row = std::ranges::find(format.facts, fact, &FormatFact::fact);
    if (row == format.facts.end()) return {};
    const std::string done = row->is_read && row->is_written ? "both"
                             : row->is_read                  ? "read"
                                                             : "written";
    return row->how.empty() ? done : done + ", " + std::string(row->how);
}

}  // namespace

std::span<const FormatFacts> formatFacts() { return kFormatFacts; }

std::vector<std::vector<std::string>> formatsTable() {
    std::vector<std::vector<std::string>> rows{{""}};
    for (const std::string_view name : kFactNames) rows.front().emplace_back(name);
    for (const FormatFacts& format : kFormatFacts) {
        std::string names;
        for (const std::string_view extension : format.extensions)
            names.append(names.empty() ? "`" : ", `").append(extension).append("`");
        std::vector<std::string>& row = rows.emplace_back();
        row.push_back(names.append(" ").append(format.name));
        for (std::size_t i = 0; i < kFactNames.size(); ++i)
            row.push_back(cellOf(format, static_cast<Fact>(i)));
    }
    return rows;
}

std::string formatsMarkdown() {
    std::string table;
    for (const std::vector<std::string>& row : formatsTable()) {
        const bool is_header = table.empty();
        table += '|';
        for (const std::string& cell : row) table += (cell.empty() ? "" : ' ' + cell) + " |";
        table += '\n';
        if (!is_header) continue;
        table += '|';
        for (std::size_t i = 0; i < row.size(); ++i) table += "---|";
        table += '\n';
    }
    return table;
}

}  // namespace hair::groom
