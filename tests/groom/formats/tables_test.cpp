#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "hair/fields.h"
#include "hair/groom/files.h"
#include "hair/groom_settings.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"

// Tests
// importStrands and exportStrands: the choice of a row for a file, and the errors if there is
// none.
namespace hair::groom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const StrandSet kTwoStrands{.ends = {2, 4}, .points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}};

std::string fileError(const std::filesystem::path& path) {
    return errorText([&] { importStrands(path); });
}

TEST(ImportStrands, GoesByTheExtensionInAnyCase) {
    const TemporaryFolder folder;
    for (const StrandExporter& exporter : strandExporters()) {
        if (exporter.extension.starts_with(".usd")) continue;  // another program reads it
        std::string name = "a" + std::string(exporter.extension);
        exportStrands(kTwoStrands, folder.file(name));
        for (char& c : name) c = static_cast<char>(std::toupper(c));
        std::filesystem::rename(
            folder.file("a" + std::string(exporter.extension)), folder.file(name));
        EXPECT_EQ(importStrands(folder.file(name)).points, kTwoStrands.points) << name;
    }
}

TEST(ImportStrands, GoesByTheFirstBytesWhereTheyAreAnotherFormats) {
    const TemporaryFolder folder;
    for (const std::string written : {".hair", ".tfx", ".ply", ".glb", ".abc"}) {
        exportStrands(kTwoStrands, folder.file("a" + written));
        for (const std::string name : {"b.hair", "b.hgl", "b.obj", "b.gltf", "b.txt", "b"}) {
            std::filesystem::rename(folder.file("a" + written), folder.file(name));
            EXPECT_EQ(importStrands(folder.file(name)).points, kTwoStrands.points)
                << written << name;
            std::filesystem::rename(folder.file(name), folder.file("a" + written));
        }
    }
}

TEST(ImportStrands, NamesTheFileOnce) {
    const TemporaryFolder folder;
    const std::string bytes = writeText(strandExporters()[0].write, kTwoStrands).bytes;
    const auto path = folder.write("cut.hair", bytes.substr(0, 100));
    EXPECT_EQ(
        fileError(path), path.string() + ": byte 100: truncated: the header alone is 128 bytes");
    EXPECT_EQ(
        fileError(folder.file("missing.hair")),
        folder.file("missing.hair").string() + ": no such file");
    std::filesystem::create_directory(folder.file("folder.hair"));
    EXPECT_EQ(
        fileError(folder.file("folder.hair")),
        folder.file("folder.hair").string() + ": is not a file");
    EXPECT_THAT(fileError(folder.write("empty.hair", "")), HasSubstr("byte 0: truncated"));
}

TEST(ImportStrands, ListsWhatItKnows) {
    const TemporaryFolder folder;
    const auto path = folder.write("hair.xyz", "unknown");
    EXPECT_EQ(
        fileError(path),
        path.string() +
            ": unknown format of strands '.xyz'; known: .hair, .tfx, .hgl, .ply, .obj, .gltf, "
            ".glb, .usd, .usda, .usdc, .usdz, .data, .npy, .npz, .xml, .bin, .abc, .mitshair, "
            ".txt, .pbrt");
}

// The settings do not know the formats, so their help has its own list.
TEST(ImportStrands, IsListedInTheHelpOfItsSetting) {
    const std::vector<Field>& fields = tableOf(static_cast<const GroomSettings*>(nullptr)).fields();
    const auto file = std::ranges::find(fields, std::string_view("file"), &Field::name);
    ASSERT_NE(file, fields.end());
    EXPECT_THAT(file->help, HasSubstr("(" + readExtensions() + ")"));
}

// The first bytes are those stated in the formats' own descriptions.
TEST(ImportStrands, NamesWhatItDoesNotRead) {
    using namespace std::string_literals;
    const TemporaryFolder folder;
    const std::pair<std::string, const char*> kOthers[] = {
        {"\x89HDF\r\n\x1a\n"s, "an HDF5 file, such as an Alembic file from before 2013, which is "
                               "not read: convert it with Alembic's \"abcconvert -toOgawa\""},
        {"Kaydara FBX Binary  \0\x1a\0"s, "an FBX file"},
        {"; FBX 7.7.0 project file\n"s, "an FBX file in text, which is not read: import it in "
                                        "Blender and export its curves as USD"},
        {"BLENDER-v405"s, "a Blender file, which is not read: export"},
        {"\x28\xb5\x2f\xfd"s, "compressed with Zstandard"},
        {"//Maya ASCII 2024 scene\n"s, "a Maya scene (ASCII)"},
        {"FOR4\0\0\0\x28"s
         "CACH"s,
         "a Maya scene or cache"},
        {"PK\3\4\x14\0"s, "a zip archive, which is not read: unpack it"},
        {"#usda 1.0\n"s, "a USD file, which is not read: name it .usda"},
        {"PXR-USDC"s, "name it .usdc"}};
    for (const auto& [bytes, reason] : kOthers) {
        for (const char* name : {"a.abc", "a.hair", "a.data", "a"}) {
            const auto path = folder.write(name, bytes);
            EXPECT_THAT(fileError(path), AllOf(StartsWith(path.string() + ": "), HasSubstr(reason)))
                << name;
        }
    }
    // The beginnings that Git LFS's specification, git-annex, HTML's and the formats' own documents
    // state; a pointer of Git LFS begins like a text of TressFX.
    const std::pair<std::string, const char*> kStandIns[] = {
        {"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 5\n"s,
         "is a pointer of Git LFS, which is not read: it stands for a large file: run 'git lfs "
         "pull'"},
        {"/annex/objects/SHA256E-s5--00.hair\n"s, "run 'git annex get'"},
        {"<!DOCTYPE html>\n<html lang=\"en\">"s, "a page in HTML, which is not read"},
        {"\xef\xbb\xbf \r\n<HTML><head>"s, "download the file itself"},
        {"; FBX 7.5.0 project file\n"s, "an FBX file in text"},
        {"\x7fNSJb\0"s, "from Houdini"},
        {"PK\3\4\x14\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10\0\0\0archive/data.pkl"s,
         "a file of PyTorch, which is not read: load it in Python"}};
    for (const auto& [bytes, reason] : kStandIns)
        for (const char* name : {"a.tfx", "a.hair", "a.data", "a.usda", "a"})
            EXPECT_THAT(fileError(folder.write(name, bytes)), HasSubstr(reason)) << name;
    // Four bytes of a pickle are a count of strands too, so that only the reader finds out.
    EXPECT_THAT(
        fileError(folder.write("a.data", "\x80\x04\x95\x10rest of it")),
        AllOf(HasSubstr("truncated"), HasSubstr("by its first bytes it is a Python pickle")));
    EXPECT_THAT(fileError(folder.write("a.tgz", "\x1f\x8b\x08\x01")), HasSubstr("with gzip"));
    EXPECT_THAT(fileError(folder.write("a.pkl", "\x80\x04\x95")), HasSubstr("Python pickle"));
    // A HairSalon file with 559,903 strands begins like a gzip file, and NumPy archives are zip
    // files.
    EXPECT_EQ(strandImporterOf(folder.write("a.data", "\x1f\x8b\x08")).extensions[0], ".data");
    EXPECT_EQ(strandImporterOf(folder.write("a.npz", "PK\3\4")).extensions[0], ".npz");
}

// Files of three programs have the extension .hair.
TEST(ImportStrands, TellsFilesOfOneExtensionApart) {
    const TemporaryFolder folder;
    const auto nameOf = [&](std::string_view bytes) {
        return strandImporterOf(folder.write("a.hair", bytes)).name;
    };
    EXPECT_EQ(nameOf(textOf(corpus("hair/points_only.hair"))), "Cem Yuksel's HAIR");
    EXPECT_EQ(nameOf(textOf(corpus("other_hair/monohair.hair"))), "MonoHair's strands");
    EXPECT_EQ(nameOf(textOf(corpus("mitshair/binary.mitshair"))), "Mitsuba's hair");
    EXPECT_EQ(nameOf(textOf(corpus("mitshair/comments.txt"))), "Mitsuba's hair in text");
    EXPECT_EQ(nameOf("0 0 0"), "Mitsuba's hair in text");
    EXPECT_EQ(nameOf(""), "Cem Yuksel's HAIR");
    EXPECT_EQ(nameOf("nothing of these, but long enough for a count"), "Cem Yuksel's HAIR");
    // A damaged file keeps its format, if it still can have its strands.
    EXPECT_THAT(
        fileError(folder.write("a.hair", textOf(corpus("other_hair/monohair.hair")).substr(0, 60))),
        HasSubstr("byte 60: truncated: 3 strands of 9 points without a header are 122 bytes"));
}

TEST(ExportStrands, WritesWholeFilesOrNone) {
    const TemporaryFolder folder;
    for (const StrandExporter& exporter : strandExporters()) {
        if (exporter.extension == ".usdc" && pythonInterpreter().empty()) continue;
        const auto path = folder.file("none" + std::string(exporter.extension));
        const std::string error = errorText([&] { exportStrands({}, path); });
        if (error != "no error") {
            EXPECT_THAT(error, StartsWith(path.string() + ": "));
            EXPECT_THAT(error.substr(path.string().size()), Not(HasSubstr(path.string())));
        }
        std::filesystem::remove(path);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ExportStrands, ListsWhatItKnows) {
    EXPECT_EQ(
        errorText([] { exportStrands(kTwoStrands, "a.usdz"); }),
        "a.usdz: strands can't be written as '.usdz'; known: .hair, .hgl, .tfx, .obj, .ply, .gltf, "
        ".glb, .usda, .usdc, .data, .npy, .npz, .abc, .mitshair, .txt, .pbrt");
}

TEST(ExportStrands, ReturnsTheWarnings) {
    const TemporaryFolder folder;
    StrandSet strands = kTwoStrands;
    strands.widths.everywhere = 0.5f;
    EXPECT_THAT(
        exportStrands(strands, folder.file("a.hgl")), testing::ElementsAre(HasSubstr("widths")));
    EXPECT_THAT(exportStrands(strands, folder.file("a.HAIR")), IsEmpty());
}

// ---- Facts --------------------------------------------------------------------------------------

// A part of strands, and whether they have it.
struct KnownPart {
    Fact fact;
    bool (*has)(const StrandSet& set);
};

constexpr KnownPart kParts[] = {
    {Fact::guides, [](const StrandSet& s) { return !s.guides.empty(); }},
    {Fact::groups, [](const StrandSet& s) { return !s.groups.empty(); }},
    {Fact::widths, [](const StrandSet& s) { return s.widths.known(); }},
    {Fact::colors, [](const StrandSet& s) { return s.colors.known(); }},
    {Fact::transparencies,
     [](const StrandSet& s) {
         return !s.transparencies.values.empty() || s.transparencies.everywhere.value_or(0) != 0;
     }},
    {Fact::root_uvs, [](const StrandSet& s) { return !s.root_uvs.empty(); }},
    {Fact::unit, [](const StrandSet& s) { return s.metres_per_unit.has_value(); }},
    {Fact::up, [](const StrandSet& s) { return s.up.has_value(); }},
    {Fact::root_triangles, [](const StrandSet& s) { return !s.root_triangles.empty(); }},
};

// Three strands with every part, each value different; `sizes` are their points.
StrandSet strandsWithAll(std::vector<std::uint32_t> sizes) {
    StrandSet set;
    for (const std::uint32_t size : sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            const auto n = static_cast<float>(set.points.size());
            set.points.emplace_back(set.ends.size(), k, 0);
            set.widths.values.push_back(0.001f * static_cast<float>(set.ends.size() + 1));
            set.transparencies.values.push_back(n / 32);
            set.colors.values.emplace_back(n / 32, 0.5f, 0.25f);
        }
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    set.root_uvs = {{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}};
    set.groups = {1, 2, 2};
    set.guides = {0, 1, 0};
    set.root_triangles = {{0, 1, 2}};
    set.metres_per_unit = 1.0;
    set.up = 1;
    return set;
}

const FormatFact* factOf(const FormatFacts& format, Fact fact) {
    const auto row = std::ranges::find(format.facts, fact, &FormatFact::fact);
    return row == format.facts.end() ? nullptr : &*row;
}

TEST(FormatFacts, CoverAllFormatsAndNoOthers) {
    std::set<std::string_view> read;
    std::set<std::string_view> written;
    for (const FormatFacts& format : formatFacts()) {
        const FormatFact* const strands = factOf(format, Fact::strands);
        ASSERT_TRUE(strands) << format.name;
        for (const std::string_view extension : format.extensions) {
            if (strands->is_read) read.insert(extension);
            if (!strands->is_written) continue;
            EXPECT_TRUE(written.insert(extension).second) << extension;
        }
        for (const FormatFact& fact : format.facts)
            EXPECT_TRUE(fact.is_read || fact.is_written) << format.name;
    }
    std::set<std::string_view> importers, playing, with_samples;
    for (const StrandImporter& importer : strandImporters()) {
        importers.insert(importer.extensions.begin(), importer.extensions.end());
        if (importer.read_samples)
            with_samples.insert(importer.extensions.begin(), importer.extensions.end());
    }
    EXPECT_EQ(read, importers);
    for (const FormatFacts& format : formatFacts())
        if (const FormatFact* const fact = factOf(format, Fact::animation); fact && fact->is_read)
            playing.insert(format.extensions.begin(), format.extensions.end());
    EXPECT_EQ(playing, with_samples);
    std::set<std::string_view> exporters;
    for (const StrandExporter& exporter : strandExporters()) exporters.insert(exporter.extension);
    EXPECT_EQ(written, exporters);
}

// The parts that come back from a file are those that the table says are written and read.
TEST(FormatFacts, AreThoseOfWrittenFiles) {
    const TemporaryFolder folder;
    for (const FormatFacts& format : formatFacts()) {
        const FormatFact& strands = *factOf(format, Fact::strands);
        if (!strands.is_written) continue;
        for (const std::string_view extension : format.extensions) {
            SCOPED_TRACE(extension);
            if (extension.starts_with(".usd") && pythonInterpreter().empty()) continue;
            const bool is_any = strands.how == "of any length";
            const auto sizes =
                is_any ? std::vector<std::uint32_t>{4, 6, 5} : std::vector<std::uint32_t>{4, 4, 4};
            const auto path = folder.file("a" + std::string(extension));
            exportStrands(strandsWithAll(sizes), path);
            const StrandSet set = importStrands(path);
            EXPECT_EQ(set.ends, strandsWithAll(sizes).ends);
            for (const KnownPart& part : kParts) {
                const FormatFact* const fact = factOf(format, part.fact);
                EXPECT_EQ(part.has(set), fact && fact->is_read && fact->is_written)
                    << static_cast<int>(part.fact);
            }
            if (factOf(format, Fact::widths)) {
                EXPECT_EQ(set.widths.values.size(), set.points.size());
            }
            if (is_any) continue;
            // Strands of other lengths are resampled to one.
            exportStrands(strandsWithAll({4, 6, 5}), path);
            EXPECT_TRUE(commonSize(importStrands(path)));
        }
    }
}

// No file of the corpus has a part that the table says is not read.
TEST(FormatFacts, AllowThePartsOfTheCorpus) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus(""))) {
        const std::string path = entry.path().string();
        if (!entry.is_regular_file() || path.find("findings") != path.npos) continue;
        const std::string extension = lowerCaseExtension(path);
        if (extension.starts_with(".usd") && pythonInterpreter().empty()) continue;
        std::vector<const FormatFacts*> formats;
        for (const FormatFacts& format : formatFacts())
            if (std::ranges::find(format.extensions, extension) != format.extensions.end())
                formats.push_back(&format);
        if (formats.empty()) continue;  // a script
        SCOPED_TRACE(path);
        const StrandSet set = importStrands(path);
        for (const KnownPart& part : kParts) {
            if (!part.has(set)) continue;
            EXPECT_TRUE(std::ranges::any_of(formats, [&](const FormatFacts* format) {
                const FormatFact* const fact = factOf(*format, part.fact);
                return fact && fact->is_read;
            })) << static_cast<int>(part.fact);
        }
    }
}

TEST(FormatFacts, AreTheTableOfTheDocumentation) {
    EXPECT_THAT(
        textOf(std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "docs/grooms.md"),
        HasSubstr(formatsMarkdown()))
        << "write it anew: hairbench groom formats --markdown";
}

}  // namespace
}  // namespace hair::groom
