#include "hair/groom/build_groom.h"

#include <algorithm>
#include <span>

#include <algorithm>
#include <span>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/files.h"
#include "hair/groom/growth/grow.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/style/strokes.h"
#include "hair/groom/style/style.h"
#include "tests/error_text.h"
#include "tests/groom/style/sample_strands.h"
#include "tests/groom/test_meshes.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Groom grown(std::uint32_t guides) { return grow(makeCap(), {}, "", guides, 1); }

// A file of guides that holds only points and widths.
GroomSettings fileOf(const TemporaryFolder& folder, const Groom& groom) {
    StrandSet strands = strandsOf(groom);
    strands.root_triangles.clear();
    exportStrands(strands, folder.file("guides.hair"));
    GroomSettings settings;
    settings.file = "guides.hair";
    return settings;
}

TEST(BuildGroom, ReadsTheFileBesideTheScene) {
    const TemporaryFolder folder;
    const Groom guides = grown(20);
    exportStrands(strandsOf(guides), folder.file("guides.HGL"));
    GroomSettings settings;
    settings.file = "guides.HGL";
    const Groom groom = buildGroom(settings, nullptr, folder.file(""), 1);
    EXPECT_EQ(groom.points, guides.points);
    EXPECT_EQ(groom.root_triangles, guides.root_triangles);
}

TEST(BuildGroom, GrowsWhereNoFileIsNamed) {
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.grow.vertices = 5;
    const Groom groom = buildGroom(settings, &cap, "scenes", 7);
    EXPECT_EQ(groom.points, grow(cap, settings.grow, "", 30, 7).points);
    EXPECT_TRUE(groom.bindings.empty());
}

// The guides are strands of the dense groom, each bound to itself alone. There are as many roots as
// the settings request, all on the cap.
TEST(BuildGroom, ChoosesGuidesFromGrownStrands) {
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.grow.strands = 2000;
    settings.grow.vertices = 5;
    settings.style.frizz.amplitude = 0.003f;
    const Groom groom = buildGroom(settings, &cap, "scenes", 7);
    EXPECT_EQ(groom.strand_count, 30u);
    ASSERT_EQ(groom.bindings.size(), 2000u);
    EXPECT_FALSE(groom.root_triangles.empty());
    const Groom dense = style(grow(cap, settings.grow, "", 30, 7), settings.style, 7, nullptr);
    ASSERT_EQ(dense.strand_count, 2000u);
    EXPECT_LT(reconstructionError(dense, groom, groom.bindings).mean, 0.02);
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < dense.strand_count && found < 30; ++i)
        found += std::ranges::equal(dense.strand(i), groom.strand(found)) ? 1u : 0u;
    EXPECT_EQ(found, 30u);
    settings.grow.strands = 20;
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, &cap, "scenes", 7); }), HasSubstr("20 strands"));
}

// The renderer draws the styled shapes of grown strands, not the mean of their guides.
TEST(BuildGroom, KeepsThePointsOfGrownStrands) {
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.grow.strands = 500;
    settings.style.frizz.amplitude = 0.003f;
    const Groom groom = buildGroom(settings, &cap, "scenes", 7);
    const Groom dense = style(grow(cap, settings.grow, "", 30, 7), settings.style, 7, nullptr);
    EXPECT_EQ(groom.bound_points, dense.points);
    ASSERT_EQ(groom.bound_ends.size(), 500u);
    EXPECT_EQ(groom.bound_ends.back(), dense.points.size());
}

// Vellus hairs and those of the file come after the strands that guides move. They follow the head
// alone: no weights, their root as offset, their own width.
TEST(BuildGroom, AddsStrandsThatFollowTheHead) {
    const TemporaryFolder folder;
    StrandSet file{.ends = {3, 6}, .metres_per_unit = 1.0};
    for (int i = 0; i < 6; ++i) file.points.emplace_back(0.01f * static_cast<float>(i), 0.2f, 0.3f);
    file.widths.values = {1e-4f, 1e-4f, 1e-4f, 2e-4f, 2e-4f, 2e-4f};
    exportStrands(file, folder.file("lashes.npz"));
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.grow.strands = 500;
    settings.grow.vellus.share = 0.1f;
    settings.fixed = "lashes.npz";
    const Groom groom = buildGroom(settings, &cap, folder.path(), 7);
    ASSERT_EQ(groom.bindings.size(), 500u + 50u + 2u);
    ASSERT_EQ(groom.bound_ends.size(), groom.bindings.size());
    for (std::size_t i = 0; i < groom.bindings.size(); ++i) {
        const StrandBinding& binding = groom.bindings[i];
        EXPECT_EQ(binding.followsHead(), i >= 500) << i;
        EXPECT_EQ(binding.width, i < 500 ? 0.0f : i < 550 ? 3e-5f : i < 551 ? 1e-4f : 2e-4f) << i;
        if (i >= 500) {
            EXPECT_EQ(binding.offset, groom.boundStrand(i)[0]) << i;
        }
    }
    EXPECT_TRUE(std::ranges::equal(groom.boundStrand(550), std::span(file.points).first(3)));
}

TEST(BuildGroom, GrowsTheThesissNumberOfGuides) {
    const Mesh cap = makeCap();
    EXPECT_EQ(buildGroom({}, &cap, "scenes", 1).strand_count, 86u);
}

TEST(BuildGroom, ScalesThenTurnsThenMovesAFile) {
    const TemporaryFolder folder;
    Groom strand{.strand_count = 1, .vertices_per_strand = 2};
    strand.points = {{1.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 3.0f}};
    strand.widths = {0.5f, 0.25f};
    GroomSettings settings = fileOf(folder, strand);
    settings.placement = {
        .scale = 0.5f, .rotation = {90.0f, 0.0f, 90.0f}, .translation = {0.0f, 0.0f, 10.0f}};
    const Groom groom = buildGroom(settings, nullptr, folder.path(), 1);
    // By hand: (1, 2, 3) halved, (x, y, z) -> (x, -z, y) about x, then -> (-y, x, z) about z.
    const std::array expected{glm::vec3(0.0f, 0.5f, 10.0f), glm::vec3(1.5f, 0.5f, 11.0f)};
    for (int i = 0; i < 3; ++i) {  // 90 degrees as a float are off by 1e-8
        EXPECT_NEAR(groom.points[0][i], expected[0][i], 1e-6);
        EXPECT_NEAR(groom.points[1][i], expected[1][i], 1e-6);
    }
    EXPECT_EQ(groom.widths, (std::vector{0.25f, 0.125f}));
}

TEST(BuildGroom, TakesEveryStrandOfAFileForAGuide) {
    const TemporaryFolder folder;
    const Groom guides = grown(40);
    const Groom groom = buildGroom(fileOf(folder, guides), nullptr, folder.path(), 1);
    EXPECT_EQ(groom.points, guides.points);
    EXPECT_FALSE(groom.root_triangles.empty());
    ASSERT_EQ(groom.bindings.size(), 40u);
    for (std::uint32_t i = 0; i < 40; ++i) {
        EXPECT_EQ(groom.bindings[i].guides[0], i);
        EXPECT_EQ(groom.bindings[i].weights, glm::vec3(1.0f, 0.0f, 0.0f));
    }
}

// Brushes move each strand of a file by itself, at its own points. They don't change the choice of
// guides.
TEST(BuildGroom, BrushesEveryStrandOfAFile) {
    const TemporaryFolder folder;
    const Groom dense = grown(200);
    GroomSettings settings = fileOf(folder, dense);
    settings.guides = 50;
    settings.vertices = 5;
    const Groom without = buildGroom(settings, nullptr, folder.path(), 1);
    const glm::vec3 tip = dense.strand(0).back();
    settings.edits = {
        {.tool = BrushTool::comb,
         .radius = 0.06f,
         .strength = 1.0f,
         .path = {{tip}, {tip + glm::vec3(0.02f, 0.03f, 0.0f)}}}};
    const Groom groom = buildGroom(settings, nullptr, folder.path(), 1);

    const Strokes strokes(settings.edits, nullptr, 0.0, middleOfRoots(dense));
    const Groom brushed = replay(dense, strokes);
    ASSERT_NE(brushed.points, dense.points);
    EXPECT_EQ(groom.bound_points, brushed.points);
    EXPECT_EQ(groom.bound_ends, without.bound_ends);
    EXPECT_EQ(groom.points, replay(without, strokes).points);
    EXPECT_EQ(groom.root_triangles, without.root_triangles);
}

TEST(BuildGroom, BrushesGrownGuidesAfterStyling) {
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.style.cut.length = 0.1f;
    const Groom without = buildGroom(settings, &cap, "scenes", 7);
    settings.edits = {
        {.tool = BrushTool::lengthen,
         .radius = 0.05f,
         .strength = 0.5f,
         .path = {{without.strand(3).front()}}}};
    const Groom groom = buildGroom(settings, &cap, "scenes", 7);
    EXPECT_EQ(
        groom.points,
        replay(without, Strokes(settings.edits, &cap, 0.0, middleOfRoots(without))).points);
    double length = 0.0;
    for (std::size_t i = 1; i < groom.vertices_per_strand; ++i)
        length += glm::distance(groom.strand(3)[i - 1], groom.strand(3)[i]);
    EXPECT_NEAR(length, 0.15, 1e-6);  // its root is on the path
}

TEST(BuildGroom, ChoosesGuidesFromAFileAndBindsTheOthers) {
    const TemporaryFolder folder;
    const Groom dense = grown(200);
    GroomSettings settings = fileOf(folder, dense);
    settings.guides = 50;
    const Groom groom = buildGroom(settings, nullptr, folder.path(), 1);
    EXPECT_EQ(groom.strand_count, 50u);
    ASSERT_EQ(groom.bindings.size(), 200u);
    EXPECT_FALSE(groom.root_triangles.empty());
    for (std::uint32_t i = 0; i < 200; ++i) {
        const StrandBinding& binding = groom.bindings[i];
        glm::vec3 root = binding.offset;
        for (int k = 0; k < 3; ++k)
            root += binding.weights[k] *
                    groom.strand(binding.guides[static_cast<std::size_t>(k)]).front();
        // A sum of four floats below 0.1 m.
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(root[axis], dense.strand(i).front()[axis], 1e-7) << i;
    }
}

TEST(BuildGroom, RefusesMoreGuidesThanTheFileHas) {
    const TemporaryFolder folder;
    GroomSettings settings = fileOf(folder, grown(20));
    settings.guides = 21;
    const std::string error =
        folder.relative(errorText([&] { buildGroom(settings, nullptr, folder.path(), 1); }));
    EXPECT_THAT(error, StartsWith("guides.hair: "));
    EXPECT_THAT(error, HasSubstr("21"));
    EXPECT_THAT(error, HasSubstr("20"));
}

TEST(BuildGroom, KnowsTheNormalsOfTheMeshUnderAFile) {
    const TemporaryFolder folder;
    const Mesh cap = makeCap();
    const Groom guides = grown(40);
    const Groom groom = buildGroom(fileOf(folder, guides), &cap, folder.path(), 1);
    ASSERT_EQ(groom.root_normals.size(), 40u);
    // The cap's exact normals, interpolated in triangles of 1.8 / 24 rad, are off by less than an
    // eighth of the square of that angle.
    for (std::uint32_t i = 0; i < 40; ++i)
        EXPECT_GT(glm::dot(groom.root_normals[i], glm::normalize(guides.strand(i)[0])), 0.999f);
    EXPECT_TRUE(buildGroom(fileOf(folder, guides), nullptr, folder.path(), 1).root_normals.empty());
}

TEST(BuildGroom, StylesWhatItHas) {
    const TemporaryFolder folder;
    GroomSettings settings = fileOf(folder, grown(20));
    settings.style.taper = {.root_width = 2e-3f, .tip_width = 1e-3f};
    const Mesh cap = makeCap();
    EXPECT_EQ(buildGroom(settings, nullptr, folder.path(), 1).widths.front(), 2e-3f);
    settings.file.clear();
    EXPECT_EQ(buildGroom(settings, &cap, folder.path(), 1).widths.front(), 2e-3f);
}

TEST(BuildGroom, NamesThePath) {
    GroomSettings settings;
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
        StartsWith("scenes/assets/head.glb: "));
    Mesh bald = makeCap();
    bald.materials.pop_back();
    bald.triangle_materials.assign(bald.triangle_materials.size(), 0);
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, &bald, "scenes", 1); }),
        StartsWith("scenes/assets/head.glb: "));
    settings.file = "gone.hgl";
    EXPECT_EQ(
        errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
        "scenes/gone.hgl: no such file");
}

TEST(BuildGroom, ListsTheFormatsItKnows) {
    const TemporaryFolder folder;
    folder.write("guides.xyz", "no hair");
    GroomSettings settings;
    settings.file = "guides.xyz";
    const std::string error = errorText([&] { buildGroom(settings, nullptr, folder.path(), 1); });
    for (const StrandImporter& importer : strandImporters())
        for (const std::string_view extension : importer.extensions)
            EXPECT_THAT(error, HasSubstr(std::string(extension)));
}

}  // namespace
}  // namespace hair::groom
