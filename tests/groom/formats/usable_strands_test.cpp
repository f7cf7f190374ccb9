// Tests what becomes of strands that can't be used, and of guides, groups and parts that only some
// strands have, in files of several formats.
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/build_groom.h"
#include "hair/groom/edit.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"
#include "tests/required.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Four strands of three points along y, at x = 0 to 3.
StrandSet fourStrands() {
    StrandSet set;
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) set.points.emplace_back(i, k, 0);
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

bool isPython(std::string_view extension) { return extension.starts_with(".usd"); }

// Calls `test` with the file that every exporter writes of the strands.
template <class Test>
void forEachFormat(const StrandSet& strands, const Test& test) {
    const TemporaryFolder folder;
    for (const StrandExporter& exporter : strandExporters()) {
        if (isPython(exporter.extension) && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(exporter.extension);
        test(folder.write(
            "a" + std::string(exporter.extension), writeText(exporter.write, strands).bytes));
    }
}

// ---- One rule for all formats -------------------------------------------------------------------

TEST(UsableStrands, AreReadAndTheOthersNamedInEveryFormat) {
    StrandSet strands = fourStrands();
    strands.points[4].y = kNan;
    strands.points[11].z = std::numeric_limits<float>::infinity();
    forEachFormat(strands, [](const std::filesystem::path& path) {
        const StrandSet read = importStrands(path);
        EXPECT_EQ(brokenPromise(read), "");
        EXPECT_THAT(read.ends, ElementsAre(3, 6));
        ASSERT_EQ(read.points.size(), 6u);
        EXPECT_EQ(read.points[1], glm::vec3(0, 1, 0));
        EXPECT_EQ(read.points[4], glm::vec3(2, 1, 0));
        EXPECT_THAT(
            read.warnings,
            Contains("2 strands with a position that is not finite (the first is strand 1, counted "
                     "from 0) are left out"));
        ASSERT_EQ(read.left_out.size(), 1u);
        EXPECT_EQ(read.left_out[0].count, 2u);
        EXPECT_EQ(read.left_out[0].first, 1u);
        EXPECT_THAT(
            errorText([&] { importStrands(path, 0, {}, BadStrands::refused); }),
            AllOf(
                HasSubstr(path.string() + ": 2 strands with a position that is not finite"),
                HasSubstr("--strict"), HasSubstr("groom fix")));
    });
}

TEST(UsableStrands, AreRequiredInEveryFormat) {
    StrandSet strands = fourStrands();
    for (glm::vec3& point : strands.points) point.x = kNan;
    forEachFormat(strands, [](const std::filesystem::path& path) {
        EXPECT_THAT(
            errorText([&] { importStrands(path); }),
            HasSubstr("no strand can be used; the file has only 4 strands with a position that is "
                      "not finite (the first is strand 0"));
    });
}

// Strand 2 has a negative width in the middle; TressFX has one width for each strand.
TEST(UsableStrands, HaveWidthsThatAreNotNegative) {
    StrandSet strands = fourStrands();
    strands.widths.values.assign(12, 0.5f);
    for (std::size_t k = 6; k < 9; ++k) strands.widths.values[k] = -0.25f;
    std::size_t formats = 0;
    forEachFormat(strands, [&](const std::filesystem::path& path) {
        const StrandSet read = importStrands(path);
        EXPECT_EQ(brokenPromise(read), "");
        if (!read.widths.known()) return;  // the format has none
        ++formats;
        EXPECT_THAT(read.ends, ElementsAre(3, 6, 9));
        EXPECT_EQ(read.points.back(), glm::vec3(3, 2, 0));
        EXPECT_EQ(read.widths.at(8), 0.5f);
        EXPECT_THAT(
            read.warnings,
            Contains("1 strand with a negative width (strand 2, counted from 0) is left out"));
        EXPECT_THAT(
            errorText([&] { importStrands(path, 0, {}, BadStrands::refused); }),
            AllOf(HasSubstr("1 strand with a negative width"), HasSubstr("--strict")));
    });
    EXPECT_GE(formats, 7u);
}

// A cubic curve may be thinner than at all its vertices, and Catmull-Rom's below zero: that is cut
// unless a vertex is negative itself.
TEST(UsableStrands, OfCurvesAreCutAtZeroOnlyBetweenVertices) {
    const auto scene = [](const std::string& radii) {
        std::string vertices;
        std::istringstream words(radii);
        int k = 0;
        for (std::string radius; words >> radius; ++k)
            vertices += std::to_string(k) + " 0 0 " + radius + ' ';
        return "<?xml version=\"1.0\"?><scene><Curves basis=\"catmull_rom\" type=\"flat\">"
               "<positions>" +
               vertices + "</positions><indices>0</indices></Curves></scene>";
    };
    const TemporaryFolder folder;
    const StrandSet cut = importStrands(folder.write("a.xml", scene("1 0 0 1")));
    EXPECT_EQ(std::ranges::min(cut.widths.values), 0.0f);
    EXPECT_THAT(
        errorText([&] { importStrands(folder.write("b.xml", scene("1 0.5 -0.5 1"))); }),
        HasSubstr("1 strand with a negative width"));
}

// Formats of edges and of equally long strands have no strands of one point.
TEST(UsableStrands, HaveTwoPoints) {
    StrandSet strands = fourStrands();
    strands.ends = {3, 4, 5, 12};
    const TemporaryFolder folder;
    for (const std::string extension : {".hair", ".data", ".abc", ".usda"}) {
        if (isPython(extension) && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(extension);
        const auto path = folder.file("a" + extension);
        exportStrands(strands, path);
        const StrandSet read = importStrands(path);
        EXPECT_THAT(read.ends, ElementsAre(3, 10));
        EXPECT_THAT(
            read.warnings, Contains("2 strands of a single point (the first is strand 1, counted "
                                    "from 0) are left out"));
        EXPECT_THAT(
            errorText([&] { importStrands(path, 0, {}, BadStrands::refused); }),
            HasSubstr("2 strands of a single point"));
    }
}

TEST(UsableStrands, KeepTheirDataAndTriangles) {
    StrandSet strands = fourStrands();
    strands.points[4].y = kNan;
    for (int k = 0; k < 12; ++k) {
        strands.widths.values.push_back(static_cast<float>(k));
        strands.colors.values.emplace_back(k);
    }
    for (int i = 0; i < 4; ++i) strands.root_uvs.emplace_back(i, 10 + i);
    strands.groups = {5, 6, 7, 8};
    strands.guides = {0, 1, 1, 0};
    strands.root_triangles = {{0, 1, 2}, {3, 2, 0}};
    const StrandSet read = usableStrands(strands);
    EXPECT_THAT(read.widths.values, ElementsAre(0, 1, 2, 6, 7, 8, 9, 10, 11));
    EXPECT_EQ(read.colors.values[3], glm::vec3(6));
    EXPECT_EQ(read.root_uvs[2], glm::vec2(3, 13));
    EXPECT_THAT(read.groups, ElementsAre(5, 7, 8));
    EXPECT_THAT(read.guides, ElementsAre(0, 1, 0));
    EXPECT_THAT(read.root_triangles, ElementsAre(std::array<std::uint32_t, 3>{2, 1, 0}));
}

TEST(UsableStrands, AreThoseOfReportedFiles) {
    const StrandSet one = importStrands(corpus("hair/reported_one_point.hair"));
    EXPECT_EQ(one.strandCount(), 11u);
    EXPECT_THAT(one.warnings, ElementsAre(leftOutStrand("of a single point", 4)));
    EXPECT_THAT(
        errorText([] { importStrands(corpus("findings/hair/reported_only_points.hair")); }),
        HasSubstr("no strand can be used; the file has only 12 strands of a single point"));
}

// ---- Mending ------------------------------------------------------------------------------------

TEST(MendStrands, LeavesOutPointsAndThenStrands) {
    StrandSet strands = fourStrands();
    strands.points[0].y = kNan;  // strand 0 begins at its second point
    strands.points[4].y = kNan;  // strand 1 keeps its ends
    strands.points[7].y = strands.points[8].y = kNan;  // strand 2 keeps one point
    for (int k = 0; k < 12; ++k) strands.widths.values.push_back(static_cast<float>(k));
    const EditedStrands mended = mendStrands(strands);
    EXPECT_EQ(brokenPromise(mended.strands), "");
    EXPECT_THAT(mended.strands.ends, ElementsAre(2, 4, 7));
    EXPECT_THAT(mended.strands.widths.values, ElementsAre(1, 2, 3, 5, 9, 10, 11));
    ASSERT_EQ(mended.notes.size(), 2u);
    EXPECT_EQ(mended.notes[0].count, 4u);
    EXPECT_EQ(mended.notes[1].what, "left out: strands of a single point");
    EXPECT_EQ(mended.notes[1].count, 1u);
}

// Strand 1 loses its middle point, strand 3 its last one.
TEST(MendStrands, MendsFilesOfEveryFormat) {
    StrandSet strands = fourStrands();
    strands.points[4].y = kNan;
    strands.points[11].z = std::numeric_limits<float>::infinity();
    forEachFormat(strands, [](const std::filesystem::path& path) {
        const EditedStrands mended = mendStrands(importStrands(path, 0, {}, BadStrands::kept));
        EXPECT_EQ(brokenPromise(mended.strands), "");
        EXPECT_THAT(mended.strands.ends, ElementsAre(3, 5, 8, 10));
        ASSERT_EQ(mended.strands.points.size(), 10u);
        EXPECT_EQ(mended.strands.points[4], glm::vec3(1, 2, 0));
        EXPECT_EQ(mended.strands.points[9], glm::vec3(3, 1, 0));
        ASSERT_FALSE(mended.notes.empty());
        EXPECT_GE(mended.notes[0].count, 2u);  // pbrt's curves have more points than vertices
    });
}

TEST(MendStrands, ChangesNoGoodStrands) {
    const EditedStrands mended = mendStrands(fourStrands());
    expectBitEqual(mended.strands.points, fourStrands().points);
    ASSERT_EQ(mended.notes.size(), 1u);
    EXPECT_EQ(mended.notes[0].count, 0u);
}

// ---- Guides and groups --------------------------------------------------------------------------

// Six strands; the file flags the third and the last as guides. Formats that hold flags and groups.
StrandSet flaggedStrands() {
    StrandSet set;
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 4; ++k) set.points.emplace_back(0.01 * i, 0.01 * k, 0.001 * i * i);
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    set.guides = {0, 0, 1, 0, 0, 1};
    set.groups = {3, 3, 3, 8, 8, 8};
    set.metres_per_unit = 1.0;
    return set;
}

template <class Test>
void forEachFlaggingFormat(const Test& test, const StrandSet& strands = flaggedStrands()) {
    const TemporaryFolder folder;
    for (const std::string extension : {".npz", ".abc", ".usda"}) {
        if (isPython(extension) && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(extension);
        exportStrands(strands, folder.file("a" + extension));
        test(folder.path(), "a" + extension);
    }
}

GroomSettings settingsOf(const std::string& file) {
    GroomSettings settings;
    settings.file = file;
    return settings;
}

std::string buildError(const GroomSettings& settings, const std::filesystem::path& folder) {
    return errorText([&] { buildGroom(settings, nullptr, folder, 1); });
}

TEST(FlaggedGuides, AreTheGuidesAndNotHair) {
    forEachFlaggingFormat([](const std::filesystem::path& folder, const std::string& file) {
        const Groom groom = buildGroom(settingsOf(file), nullptr, folder, 1);
        ASSERT_EQ(groom.strand_count, 2u);
        EXPECT_EQ(groom.strand(0)[1], flaggedStrands().points[9]);
        EXPECT_EQ(groom.strand(1)[3], flaggedStrands().points[23]);
        EXPECT_EQ(groom.bindings.size(), 4u);
        ASSERT_THAT(groom.bound_ends, ElementsAre(4, 8, 12, 16));
        EXPECT_EQ(groom.bound_points[8], flaggedStrands().points[12]);
        EXPECT_THAT(groom.guide_groups, ElementsAre(3, 8));
        EXPECT_THAT(groom.groups, ElementsAre(3, 3, 8, 8));
    });
}

TEST(FlaggedGuides, AreChosenFromByTheirNumber) {
    forEachFlaggingFormat([](const std::filesystem::path& folder, const std::string& file) {
        GroomSettings settings = settingsOf(file);
        settings.guides = 1;
        EXPECT_EQ(buildGroom(settings, nullptr, folder, 1).strand_count, 1u);
        settings.guides = 3;
        EXPECT_THAT(
            buildError(settings, folder),
            HasSubstr("/groom/guides is 3, but the file flags 2 strands as guides; 0 takes them"));
    });
}

TEST(FlaggedGuides, AreHairToo_IfThereIsNoOther) {
    StrandSet strands = flaggedStrands();
    strands.guides.assign(6, 1);
    forEachFlaggingFormat(
        [](const std::filesystem::path& folder, const std::string& file) {
            const Groom groom = buildGroom(settingsOf(file), nullptr, folder, 1);
            EXPECT_EQ(groom.strand_count, 6u);
            EXPECT_EQ(groom.bindings.size(), 6u);
        },
        strands);
}

TEST(Groups, AreChosenByTheScene) {
    forEachFlaggingFormat([](const std::filesystem::path& folder, const std::string& file) {
        GroomSettings settings = settingsOf(file);
        settings.groups = "8";
        const Groom groom = buildGroom(settings, nullptr, folder, 1);
        EXPECT_EQ(groom.strand_count, 1u);
        EXPECT_THAT(groom.groups, ElementsAre(8, 8));
        settings.groups = " 3, 8";
        EXPECT_EQ(buildGroom(settings, nullptr, folder, 1).strand_count, 2u);
        settings.groups = "3, 4";
        EXPECT_THAT(
            buildError(settings, folder),
            HasSubstr("/groom/groups: no strand belongs to group 4; the file has 3, 8"));
        settings.groups = "3 8";
        EXPECT_THAT(buildError(settings, folder), HasSubstr("'3 8' is not the number of a group"));
    });
}

TEST(Groups, AreRefusedIfTheFileHasNone) {
    forEachFormat(fourStrands(), [](const std::filesystem::path& path) {
        GroomSettings settings = settingsOf(path.filename().string());
        settings.groups = "0";
        EXPECT_THAT(buildError(settings, path.parent_path()), HasSubstr("the file has no groups"));
    });
}

TEST(Groups, AreKeptByTheFilter) {
    const EditedStrands edited = filterStrands(flaggedStrands(), {.groups = {8}}, nullptr, 1.0);
    EXPECT_THAT(edited.strands.groups, ElementsAre(8, 8, 8));
    ASSERT_EQ(edited.notes.size(), 1u);
    EXPECT_EQ(edited.notes[0].count, 3u);
}

TEST(Warnings, OfBadStrandsAreInTheGroom) {
    StrandSet strands = fourStrands();
    strands.points[1].x = kNan;
    forEachFormat(strands, [](const std::filesystem::path& path) {
        const std::string name = path.filename().string();
        const Groom groom = buildGroom(settingsOf(name), nullptr, path.parent_path(), 1);
        EXPECT_EQ(groom.strand_count, 3u);
        EXPECT_THAT(groom.warnings, ElementsAre(name + ": " + leftOutStrand(kNoPosition, 0)));
    });
}

// ---- Reported files of USD ----------------------------------------------------------------------

// Curves under a prim with a custom property, as Blender writes those of objects, and under one
// with none. The names of Blender's objects and data are no data of the user.
constexpr const char* kUserProperties = R"(#usda 1.0
(metersPerUnit = 1)
def Xform "x" {
    custom int userProperties:groom_group_id = 7
    custom string userProperties:blender:object_name = "x"
    custom double userProperties:density = 2
    def BasisCurves "c" {
        uniform token type = "linear"
        int[] curveVertexCounts = [2]
        point3f[] points = [(0,0,0),(0,1,0)]
        custom string userProperties:blender:data_name = "c.001"
        custom string userProperties:blenderName:data = "c.001"
    }
}
def Xform "y" {
    def BasisCurves "c" {
        uniform token type = "linear"
        int[] curveVertexCounts = [2]
        point3f[] points = [(0,0,0),(0,1,0)]
        custom int userProperties:groom_group_id = 9
        custom bool userProperties:groom_guide = 1
        custom string userProperties:note = "x"
    }
}
)";

constexpr const char* kNamedGroups = R"(#usda 1.0
(metersPerUnit = 1)
def BasisCurves "c" {
    uniform token type = "linear"
    int[] curveVertexCounts = [2, 2, 2]
    point3f[] points = [(0,0,0),(0,1,0),(1,0,0),(1,1,0),(2,0,0),(2,1,0)]
    string[] primvars:groom_group_name = ["brow", "hair", "brow"] (interpolation = "uniform")
}
)";

class ReportedUsd : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    }
    static std::string nameOf(const std::string& stem) { return stem + GetParam(); }
    static std::filesystem::path path(const std::string& stem) {
        return inAllKinds().file(nameOf(stem));
    }
    static StrandSet read(const std::string& stem) { return importStrands(path(stem)); }

    // Has the stages as .usda, .usdc and .usdz, which usd-core wrote.
    static const TemporaryFolder& inAllKinds() {
        static const std::unique_ptr<const TemporaryFolder> made = [] {
            auto folder = std::make_unique<const TemporaryFolder>();
            for (const auto& entry : std::filesystem::directory_iterator(corpus("usd")))
                if (entry.path().filename().string().starts_with("reported_"))
                    std::filesystem::copy(entry.path(), folder->path());
            folder->write("user_properties.usda", kUserProperties);
            folder->write("named_groups.usda", kNamedGroups);
            const std::string script =
                "import glob\nfrom pxr import Sdf, UsdUtils\nfor name in glob.glob(\"*.usda\"):\n"
                "    assert Sdf.Layer.FindOrOpen(name).Export(name[:-1] + \"c\")\n"
                "    assert UsdUtils.CreateNewUsdzPackage(name[:-1] + \"c\", name[:-1] + \"z\")\n";
            const Outcome outcome = runInShell(
                "cd '" + folder->path().string() + "' && '" + pythonInterpreter() + "' -c '" +
                script + "' 2>&1");
            if (outcome.status != 0) throw std::runtime_error(outcome.output);
            return folder;
        }();
        return *made;
    }
};

TEST_P(ReportedUsd, StatesUnitAndUpwardAxis) {
    const StrandSet set = read("reported_up_stated");
    EXPECT_EQ(set.strandCount(), 4u);
    EXPECT_EQ(set.metres_per_unit, 1.0);
    EXPECT_EQ(set.up, 1);
    EXPECT_EQ(set.points[1], glm::vec3(0.1f, 1.7f, 0.001f));
}

TEST_P(ReportedUsd, FlagsGuidesAndHasGroups) {
    const StrandSet set = read("reported_guides_flag");
    EXPECT_THAT(set.guides, ElementsAre(0, 0, 0, 0, 1, 1));
    EXPECT_THAT(set.groups, ElementsAre(0, 0, 1, 1, 0, 1));
    GroomSettings settings = settingsOf(nameOf("reported_guides_flag"));
    const Groom groom = buildGroom(settings, nullptr, inAllKinds().path(), 1);
    EXPECT_EQ(groom.strand_count, 2u);
    EXPECT_EQ(groom.bindings.size(), 4u);
    EXPECT_THAT(groom.guide_groups, ElementsAre(0, 1));
    settings.groups = "1";
    const Groom one = buildGroom(settings, nullptr, inAllKinds().path(), 1);
    EXPECT_EQ(one.strand_count, 1u);
    EXPECT_EQ(one.bindings.size(), 2u);
}

TEST_P(ReportedUsd, HasHiddenCurves) {
    const StrandSet set = read("reported_invisible");
    EXPECT_EQ(set.strandCount(), 2u);
    EXPECT_THAT(
        set.warnings, Contains("1 strand of invisible prims, 1 strand of prims of purpose "
                               "\"guide\": left out"));
}

TEST_P(ReportedUsd, HasOneWidth) {
    const StrandSet set = read("reported_usd_width1");
    EXPECT_EQ(set.widths.everywhere, 0.0001f);
    EXPECT_THAT(set.widths.values, IsEmpty());
}

TEST_P(ReportedUsd, HasTextureCoordinatesOfVertices) {
    const StrandSet set = read("reported_st_vertex");
    EXPECT_THAT(set.root_uvs, ElementsAre(glm::vec2(0.1f, 0.2f), glm::vec2(0.7f, 0.8f)));
    EXPECT_THAT(set.warnings, IsEmpty());
}

// A pinned curve begins and ends at its end vertices, and so do its widths.
TEST_P(ReportedUsd, HasPinnedCurves) {
    const StrandSet set = read("reported_pinned_varying");
    ASSERT_EQ(set.strandCount(), 1u);
    // The ends are sums of products in doubles, whose rounding is not the same on all processors.
    EXPECT_LT(glm::distance(set.points.front(), glm::vec3(0, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(set.points.back(), glm::vec3(0, 6, 0)), 1e-6f);
    EXPECT_FLOAT_EQ(set.widths.values.front(), 0.1f);
    EXPECT_FLOAT_EQ(set.widths.values.back(), 0.1f);
}

TEST_P(ReportedUsd, HasAColourOnOnePrim) {
    const StrandSet set = read("reported_half_width");
    ASSERT_EQ(set.colors.values.size(), 5u);
    EXPECT_EQ(set.colors.values[2], glm::vec3(0.3f, 0.2f, 0.1f));
    EXPECT_EQ(set.colors.values[3], glm::vec3(1.0f));
    EXPECT_THAT(set.warnings, Contains("2 of 5 points have no colour and become white"));
    EXPECT_EQ(set.widths.values[0], 0.0001f);
    EXPECT_EQ(set.widths.values[4], 0.00005f);
}

// 24 time codes a second, which is USD's default.
TEST_P(ReportedUsd, DoesNotPlayIfStrandsVanish) {
    const StrandSet first = read("reported_seq");
    EXPECT_EQ(first.strandCount(), 2u);
    EXPECT_EQ(first.metres_per_unit, 0.01);
    EXPECT_THAT(first.warnings, ElementsAre("/a: one of its 3 time samples is read"));
    const auto refused = HasSubstr(
        "/a: at time code 2 (0.0416667 s) it has 1 curves, but 2 at first: strands that appear, "
        "vanish or change their number of points don't play");
    EXPECT_THAT(errorText([] { importStrandSamples(path("reported_seq")); }), refused);
    GroomSettings settings = settingsOf(nameOf("reported_seq"));
    EXPECT_EQ(buildGroom(settings, nullptr, inAllKinds().path(), 1).strand_count, 2u);
    for (const CacheMode mode : {CacheMode::play, CacheMode::follow}) {
        settings.cache.mode = mode;
        EXPECT_THAT(buildError(settings, inAllKinds().path()), refused);
    }
}

TEST_P(ReportedUsd, HasUserProperties) {
    const StrandSet set = read("user_properties");
    EXPECT_THAT(set.groups, ElementsAre(7, 9));
    EXPECT_THAT(set.guides, ElementsAre(0, 1));
    EXPECT_THAT(set.warnings, ElementsAre("userProperties:density, userProperties:note: left out"));
}

TEST_P(ReportedUsd, HasNamedGroups) {
    const StrandSet set = read("named_groups");
    EXPECT_THAT(set.groups, ElementsAre(0, 1, 0));
    EXPECT_THAT(set.warnings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ReportedUsd, testing::Values(".usda", ".usdc", ".usdz"),
    [](const auto& kind) { return std::string(kind.param).substr(1); });

}  // namespace
}  // namespace hair::groom
