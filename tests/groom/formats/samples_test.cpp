// Tests strands over time: StrandImporter::read_samples, and the guides that play.
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "tests/error_text.h"
#include "tests/groom/formats/alembic_files.h"
#include "tests/groom/formats/usd_files.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// ---- Alembic ------------------------------------------------------------------------------------

std::string floats(const std::vector<float>& values) {
    Bytes bytes;
    for (const float value : values) bytes.f32(value);
    return bytes.str();
}

// Curves of two vertices with these samples of their points.
MadeObject moving(const std::vector<std::vector<float>>& samples) {
    MadeProperty points = madeFloats("P", 3, samples.front());
    MadeProperty sizes = madeIntegers("nVertices", {});
    points.samples.clear();
    sizes.samples.clear();
    bool same = true;
    for (const auto& sample : samples) {
        points.samples.push_back(floats(sample));
        sizes.samples.push_back(
            madeIntegers("", std::vector<std::int32_t>(sample.size() / 6, 2)).samples.front());
        same = same && sample.size() == samples.front().size();
    }
    if (same) sizes.samples.resize(1);
    return madeCurves("hair", {points, sizes, madeKind(1, 0, 0)});
}

std::string archiveAt(const MadeObject& object, const std::string& times) {
    MadeArchive archive;
    return archive.finish(archive.object({.children = {object}}), times);
}

const std::vector<float> kFirst{0, 0, 0, 0, 1, 0};
const std::vector<float> kSecond{1, 0, 0, 1, 1, 0};
const std::vector<float> kThird{1, 0, 3, 1, 1, 3};

class AlembicSamples : public testing::Test {
protected:
    StrandSamples read(const std::string& archive) const {
        return importStrandSamples(folder_.write("a.abc", archive));
    }
    std::string error(const std::string& archive) const {
        return folder_.relative(errorText([&] { read(archive); }));
    }
    TemporaryFolder folder_;
};

// Alembic's TimeSampling: uniform from 2 s at 24 Hz, cyclic with two samples a second, and a time
// for each.
TEST_F(AlembicSamples, AreReadWithTheTimesOfEachKindOfSampling) {
    const auto timesOf = [&](double cycle, const std::vector<double>& own) {
        Bytes bytes;
        bytes.u32(3).f64(cycle).u32(static_cast<std::uint32_t>(own.size()));
        for (const double time : own) bytes.f64(time);
        const StrandSamples samples =
            read(archiveAt(moving({kFirst, kSecond, kThird}), bytes.str()));
        EXPECT_THAT(samples.ends, ElementsAre(2));
        EXPECT_EQ(
            samples.points, (std::vector<glm::vec3>{
                                {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 3}, {1, 1, 3}}));
        return samples.times;
    };
    EXPECT_THAT(timesOf(0.25, {2.0}), ElementsAre(0.0, 0.25, 0.5));
    EXPECT_THAT(timesOf(1.0, {0.5, 0.75}), ElementsAre(0.0, 0.25, 1.0));
    constexpr double kAcyclic = std::numeric_limits<double>::max() / 32.0;
    EXPECT_THAT(timesOf(kAcyclic, {0.0, 0.125, 8.0}), ElementsAre(0.0, 0.125, 8.0));
}

TEST_F(AlembicSamples, OfStillCurvesAreOne) {
    const StrandSamples samples = read(madeArchive({moving({kFirst})}));
    EXPECT_THAT(samples.times, ElementsAre(0.0));
    EXPECT_EQ(samples.points.size(), 2u);
}

TEST_F(AlembicSamples, AreRefusedIfStrandsOrTimesDoNotFit) {
    std::vector<float> two = kFirst;
    two.insert(two.end(), kSecond.begin(), kSecond.end());
    EXPECT_THAT(
        error(madeArchive({moving({kFirst, two})})),
        AllOf(HasSubstr("a.abc: "), HasSubstr("at sample 1 (1 s) there are 2 strands")));
    const std::string falling = Bytes().u32(3).f64(-1.0).u32(1).f64(0.0).str();
    EXPECT_THAT(
        error(archiveAt(moving({kFirst, kSecond}), falling)), HasSubstr("times of samples"));
    constexpr double kAcyclic = std::numeric_limits<double>::max() / 32.0;
    const std::string few = Bytes().u32(3).f64(kAcyclic).u32(1).f64(0.0).str();
    EXPECT_THAT(
        error(archiveAt(moving({kFirst, kSecond}), few)), HasSubstr("1 times, but there are 2"));
    EXPECT_THAT(
        error(archiveAt(moving({kFirst, kSecond}), Bytes().u32(3).str())),
        HasSubstr("a time sampling is expected"));
}

TEST(StrandSamples, AreRefusedForAFormatThatHasNone) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.obj", "v 0 0 0\nv 0 1 0\nl 1 2\n");
    EXPECT_THAT(
        errorText([&] { importStrandSamples(file); }), HasSubstr("OBJ has no samples over time"));
}

// ---- USD ----------------------------------------------------------------------------------------

using UsdSamplesTest = UsdFiles;

// A quarter of a second between samples; the transform moves too. (x, y, z) is (x, z, -y) with +y
// up.
const char* const kPlaying = R"(#usda 1.0
( metersPerUnit = 0.01
  upAxis = "Z"
  timeCodesPerSecond = 4 )
def Xform "head" {
    double3 xformOp:translate.timeSamples = { 10: (0, 0, 0), 12: (0, 0, 8) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def BasisCurves "hair" {
        uniform token type = "linear"
        int[] curveVertexCounts = [2, 3]
        point3f[] points.timeSamples = {
            10: [(0, 1, 2), (0, 1, 3), (4, 0, 0), (4, 0, 1), (4, 0, 2)],
            11: [(1, 1, 2), (1, 1, 3), (4, 0, 0), (4, 0, 1), (4, 0, 2)] }
    }
}
)";

TEST_F(UsdSamplesTest, AreReadAtAllTimesAtWhichPointsOrPlacesHaveSamples) {
    const TemporaryFolder files;
    const StrandSamples samples = importStrandSamples(files.write("a.usda", kPlaying));
    EXPECT_THAT(samples.ends, ElementsAre(2, 5));
    EXPECT_THAT(samples.times, ElementsAre(0.0, 0.25, 0.5));
    EXPECT_EQ(samples.metres_per_unit, 0.01);
    ASSERT_EQ(samples.points.size(), 15u);
    EXPECT_EQ(samples.points[0], glm::vec3(0, 2, -1));
    EXPECT_EQ(samples.points[5], glm::vec3(1, 6, -1));
    EXPECT_EQ(samples.points[10], glm::vec3(1, 10, -1));
    EXPECT_EQ(samples.points[14], glm::vec3(4, 10, 0));
}

// `usd_seq.usda` of a report: two curves, then one, then two of other lengths.
TEST_F(UsdSamplesTest, AreRefusedWithTheTimeIfStrandsChange) {
    const TemporaryFolder files;
    const std::string head = "#usda 1.0\n( timeCodesPerSecond = 4 )\ndef BasisCurves \"a\" {\n"
                             "uniform token type = \"linear\"\n";
    const auto vanishing = files.write(
        "vanishing.usda", head + "int[] curveVertexCounts.timeSamples = { 1: [3,3], 2: [3] }\n"
                                 "point3f[] points.timeSamples = {\n"
                                 "1: [(0,0,0),(0,0,1),(0,0,2),(5,0,0),(5,0,1),(5,0,2)],\n"
                                 "2: [(0,0,0),(0,0,1),(0,0,2)] }\n}\n");
    EXPECT_THAT(
        errorText([&] { importStrandSamples(vanishing); }),
        HasSubstr("/a: at time code 2 (0.25 s) it has 1 curves, but 2 at first"));
    const auto growing = files.write(
        "growing.usda", head + "int[] curveVertexCounts.timeSamples = { 1: [2], 3: [3] }\n"
                               "point3f[] points.timeSamples = {\n"
                               "1: [(0,0,0),(0,0,1)], 3: [(0,0,0),(0,0,1),(0,0,2)] }\n}\n");
    EXPECT_THAT(
        errorText([&] { importStrandSamples(growing); }),
        HasSubstr("/a: at time code 3 (0.5 s) it has 3 points, but 2 at first"));
}

// ---- Guides -------------------------------------------------------------------------------------

TEST_F(UsdSamplesTest, BecomeTheMotionOfGuidesInMetresAndResampled) {
    const TemporaryFolder files;
    files.write("a.usda", kPlaying);
    GroomSettings settings;
    settings.file = "a.usda";
    settings.vertices = 3;
    settings.placement.translation = {0, 1, 0};
    settings.cache.mode = CacheMode::play;
    const Groom groom = buildGroom(settings, nullptr, files.path(), 1);
    EXPECT_THAT(groom.cache.times, ElementsAre(0.0, 0.25, 0.5));
    EXPECT_EQ(groom.cache.strength, std::nullopt);
    ASSERT_EQ(groom.cache.points.size(), 3u * 2u * 3u);
    const auto expectNear = [](const glm::vec3& found, const glm::vec3& expected) {
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], 1e-6);
    };
    // The first strand has two points, so its middle is new.
    expectNear(groom.cache.points[0], {0, 1.02f, -0.01f});
    expectNear(groom.cache.points[1], {0, 1.025f, -0.01f});
    expectNear(groom.cache.points[6], {0.01f, 1.06f, -0.01f});
    expectNear(groom.cache.points[17], {0.04f, 1.1f, 0});

    settings.cache.mode = CacheMode::follow;
    settings.cache.strength = 250.0f;
    EXPECT_EQ(buildGroom(settings, nullptr, files.path(), 1).cache.strength, 250.0f);

    files.write("other.obj", "v 0 0 0\nv 0 1 0\nl 1 2\n");
    settings.file = "other.obj";
    settings.cache.file = "a.usda";
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, nullptr, files.path(), 1); }),
        HasSubstr("the cache has 2 strands with 5 points, but /groom/file has 1 with 2"));
    settings.file = "a.usda";
    settings.style.cut.length = 0.001f;
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, nullptr, files.path(), 1); }),
        HasSubstr("use only one of them"));
}

}  // namespace
}  // namespace hair::groom
