// Tests that usd-core reads the files of USD that are written.
#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <type_traits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/files.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/usd_export.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/random.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class Element>
std::string bits(const std::vector<Element>& elements) {
    std::string text;
    const auto* words = reinterpret_cast<const std::uint32_t*>(elements.data());
    for (std::size_t i = 0; i < elements.size() * sizeof(Element) / 4; ++i) {
        char word[16];
        std::snprintf(word, sizeof word, " %08x", words[i]);
        text += word;
    }
    return text + '\n';
}

// A float of any size: all bit patterns except infinities and NaNs.
float anyFloat(std::uint32_t index) {
    std::uint32_t word = pcg(index);
    if ((word & 0x7f800000u) == 0x7f800000u) word &= ~0x40000000u;
    return std::bit_cast<float>(word);
}

StrandSet everything() {
    StrandSet set;
    set.ends = {3, 4, 200};
    for (std::uint32_t k = 0; k < 200; ++k) {
        // Below 2^126, because the extent adds the width.
        const auto small = [](float x) { return x * 0x1p-2f; };
        set.points.emplace_back(
            small(anyFloat(10 * k)), small(anyFloat(10 * k + 1)), small(anyFloat(10 * k + 2)));
        set.widths.values.push_back(small(std::abs(anyFloat(10 * k + 3))));
        set.colors.values.emplace_back(0.1f, 1.0f / static_cast<float>(k + 1), 0.5f);
        set.transparencies.values.push_back(static_cast<float>(k) / 256.0f);
    }
    // Numbers that decimals are likely to get wrong: -0, the least float, and a float that is
    // wrongly rounded by way of a double.
    set.points[0] = {-0.0f, 0x1p-149f, 7.038531e-26f};
    set.points[1] = {16777216.0f, -1e20f, 0.1f};
    set.root_uvs = {{0.1f, 0.2f}, {0.3f, 0.4f}, {1.0f, 0.0f}};
    set.root_triangles = {{0, 1, 2}, {2, 1, 0}};
    set.groups = {-2147483647, 5, 2147483647};
    set.guides = {0, 1, 0};
    set.metres_per_unit = 0.01;
    set.comment = "a \"quoted\" \\ comment\n\u00e4\t\x7f";
    return set;
}

std::string dump(const std::filesystem::path& path) {
    const Outcome outcome = runPython("tests/groom/formats/dump_usd.py", "'" + path.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    return outcome.output;
}

class UsdExportTest : public testing::Test {
protected:
    void SetUp() override {
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    }

    std::filesystem::path exported(const StrandSet& set) {
        const auto path = folder_.file("hair.usda");
        std::ofstream file(path, std::ios::binary);
        warnings_ = exportUsda(set, file);
        return path;
    }

    TemporaryFolder folder_;
    std::vector<std::string> warnings_;
};

TEST_F(UsdExportTest, WritesAllThatStrandsHaveToTheLastBit) {
    const StrandSet set = everything();
    const std::string text = dump(exported(set));
    EXPECT_THAT(warnings_, ElementsAre());
    EXPECT_THAT(text, HasSubstr("/hair linear nonperiodic\nmetersPerUnit 0.01\n"));
    EXPECT_THAT(text, HasSubstr("doc b'a \"quoted\" \\\\ comment\\n\\xc3\\xa4\\t\\x7f'\n"));
    EXPECT_THAT(text, HasSubstr("curveVertexCounts int[]: 00000003 00000001 000000c4\n"));
    EXPECT_THAT(text, HasSubstr("widths float[] vertex:" + bits(set.widths.values)));
    EXPECT_THAT(
        text, HasSubstr("primvars:displayColor color3f[] vertex:" + bits(set.colors.values)));
    std::vector<float> opacities;
    for (const float transparency : set.transparencies.values)
        opacities.push_back(1.0f - transparency);
    EXPECT_THAT(text, HasSubstr("primvars:displayOpacity float[] vertex:" + bits(opacities)));
    EXPECT_THAT(text, HasSubstr("primvars:st texCoord2f[] uniform:" + bits(set.root_uvs)));
    EXPECT_THAT(
        text, HasSubstr("primvars:groom_group_id int[] uniform: 80000001 00000005 7fffffff\n"));
    EXPECT_THAT(
        text, HasSubstr("primvars:groom_guide int[] uniform: 00000000 00000001 00000000\n"));
    EXPECT_THAT(text, HasSubstr("hairbench:rootTriangles int3[]:" + bits(set.root_triangles)));
    EXPECT_THAT(text, HasSubstr("points point3f[]:" + bits(set.points)));
}

TEST_F(UsdExportTest, WritesWhatIsTheSameEverywhereOnce) {
    StrandSet set;
    set.ends = {2};
    set.points = {{0, 0, 0}, {0, -1, 0}};
    set.widths.everywhere = 0.5f;
    set.colors.everywhere = glm::vec3(0.25f, 0.5f, 1.0f);
    set.transparencies.everywhere = 0.0f;
    const std::string text = dump(exported(set));
    EXPECT_THAT(text, HasSubstr("metersPerUnit none\ndoc b''\n"));
    EXPECT_THAT(textOf(folder_.file("hair.usda")), testing::Not(HasSubstr("upAxis")));
    EXPECT_THAT(text, HasSubstr("widths float[] constant:" + bits(std::vector{0.5f})));
    EXPECT_THAT(
        text,
        HasSubstr(
            "primvars:displayColor color3f[] constant:" + bits(std::vector{0.25f, 0.5f, 1.0f})));
    EXPECT_THAT(
        text, HasSubstr("primvars:displayOpacity float[] constant:" + bits(std::vector{1.0f})));
    EXPECT_THAT(
        text,
        HasSubstr(
            "extent float3[]:" + bits(std::vector{-0.25f, -1.25f, -0.25f, 0.25f, 0.25f, 0.25f})));
    EXPECT_THAT(text, testing::Not(HasSubstr("primvars:st")));
    EXPECT_THAT(text, testing::Not(HasSubstr("rootTriangles")));
}

TEST_F(UsdExportTest, ReadsBackEqual) {
    const StrandSet set = everything();
    const StrandSet back = importUsd({.bytes = {}, .path = exported(set)});
    EXPECT_THAT(back.warnings, ElementsAre());
    EXPECT_EQ(back.ends, set.ends);
    EXPECT_EQ(bits(back.points), bits(set.points));
    EXPECT_EQ(bits(back.widths.values), bits(set.widths.values));
    EXPECT_EQ(bits(back.colors.values), bits(set.colors.values));
    EXPECT_EQ(bits(back.transparencies.values), bits(set.transparencies.values));
    EXPECT_EQ(back.root_uvs, set.root_uvs);
    EXPECT_EQ(back.root_triangles, set.root_triangles);
    EXPECT_EQ(back.groups, set.groups);
    EXPECT_EQ(back.guides, set.guides);
    EXPECT_EQ(back.metres_per_unit, set.metres_per_unit);
    EXPECT_EQ(back.comment, set.comment);
}

TEST_F(UsdExportTest, SaysWhatItCannotHold) {
    StrandSet set;
    set.ends = {1};
    set.points = {{0, 0, 0}};
    set.transparencies.everywhere = 0.1f;  // 1 - 0.1f has three bits fewer
    set.comment = "br\xe4un";
    const std::string text = dump(exported(set));
    EXPECT_THAT(
        warnings_, ElementsAre(
                       "the comment is not UTF-8: taken as Latin-1",
                       "the unit of length is not known, so the file states none; other programs "
                       "take it as cm",
                       "the transparencies are rounded: USD holds opacities"));
    EXPECT_THAT(text, HasSubstr("doc b'br\\xc3\\xa4un'"));
}

TEST_F(UsdExportTest, WritesFramesAsTimeSamples) {
    StrandSet set;
    set.ends = {2, 4};
    set.points.resize(4);
    set.widths.everywhere = 0.125f;
    set.metres_per_unit = 1.0;
    const auto path = folder_.file("moving.usda");
    std::vector<std::vector<glm::vec3>> frames;
    {
        std::ofstream file(path, std::ios::binary);
        UsdaAnimation animation(file, set, {.frames = 12, .frame_time = double{1.0f / 60.0f}});
        for (std::uint32_t i = 0; i < 12; ++i) {
            auto& points = frames.emplace_back();
            for (std::uint32_t k = 0; k < 4; ++k) points.emplace_back(0.1f * i, k / 3.0f, i * k);
            animation.frame(points);
        }
        animation.finish();
        EXPECT_THAT(animation.warnings(), ElementsAre());
    }
    const std::string text = dump(path);
    EXPECT_THAT(text, HasSubstr("time 0 to 11, 60.0, 60.0 per second\n"));
    for (std::uint32_t i = 0; i < 12; ++i) {
        EXPECT_THAT(
            text, HasSubstr("points point3f[] @" + std::to_string(i) + ":" + bits(frames[i])));
    }
    EXPECT_THAT(text, HasSubstr("extent float3[] @11:"));
    const StrandSet back = importUsd({.bytes = {}, .path = path});
    EXPECT_EQ(back.points, frames[0]);
    EXPECT_THAT(back.warnings, ElementsAre("/hair: one of its 12 time samples is read"));
}

// usd-core tells the same of both files.
TEST_F(UsdExportTest, WritesTheSameInBinaryForm) {
    const auto binary = folder_.file("moving.usdc");
    EXPECT_EQ(
        exportStrands(everything(), binary), exportStrands(everything(), folder_.file("a.usda")));
    EXPECT_EQ(dump(binary), dump(folder_.file("a.usda")));
    EXPECT_TRUE(engine::readFile(binary).starts_with("PXR-USDC"));
    const auto write = [&]<class Animation>(std::type_identity<Animation>, const auto& path) {
        std::ofstream file(path, std::ios::binary);
        Animation animation(file, everything(), {.frames = 3, .frame_time = 0.1});
        for (int i = 0; i < 3; ++i) {
            std::vector<glm::vec3> points = everything().points;
            for (glm::vec3& point : points) point.y += 0.1f * static_cast<float>(i);
            animation.frame(points);
        }
        animation.finish();
    };
    write(std::type_identity<UsdcAnimation>(), binary);
    write(std::type_identity<UsdaAnimation>(), folder_.file("a.usda"));
    EXPECT_EQ(dump(binary), dump(folder_.file("a.usda")));
    EXPECT_THAT(dump(binary), HasSubstr("points point3f[] @2:"));
}

}  // namespace
}  // namespace hair::groom
