#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "hair/fields.h"
#include "hair/groom/files.h"
#include "hair/groom_settings.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

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
        errorText([] { exportStrands(kTwoStrands, "a.usdc"); }),
        "a.usdc: strands can't be written as '.usdc'; known: .hair, .hgl, .tfx, .obj, .ply, .gltf, "
        ".glb, .usda, .data, .npy, .npz, .abc, .mitshair, .txt, .pbrt");
}

TEST(ExportStrands, ReturnsTheWarnings) {
    const TemporaryFolder folder;
    StrandSet strands = kTwoStrands;
    strands.widths.everywhere = 0.5f;
    EXPECT_THAT(
        exportStrands(strands, folder.file("a.hgl")), testing::ElementsAre(HasSubstr("widths")));
    EXPECT_THAT(exportStrands(strands, folder.file("a.HAIR")), IsEmpty());
}

}  // namespace
}  // namespace hair::groom
