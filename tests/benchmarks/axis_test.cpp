#include "benchmarks/scene/axis.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;

// Returns the texts of an argument's values.
std::vector<std::string> parsed(const std::string& argument) {
    std::vector<std::string> texts;
    for (const scene::Document& value : scene::parseAxis(argument).values)
        texts.push_back(value.text());
    return texts;
}

TEST(ParseAxis, ReadsValuesAsJsonWhereTheyAre) {
    const scene::Axis axis = scene::parseAxis("/strands/density=16,64.5,true");
    EXPECT_EQ(axis.pointer, "/strands/density");
    EXPECT_THAT(
        axis.values,
        ElementsAre(scene::Document(16), scene::Document(64.5), scene::Document(true)));
}

TEST(ParseAxis, ReadsTheRestAsStrings) {
    EXPECT_THAT(
        parsed("/strands/backend=tessellation,\"a,b\",x=y"),
        ElementsAre("\"tessellation\"", "\"a,b\"", "\"x=y\""));
}

TEST(ParseAxis, KeepsVectorsTogether) {
    EXPECT_THAT(parsed("/camera/position=[0,0,1],[0, 0, 2]"), ElementsAre("[0,0,1]", "[0,0,2]"));
    EXPECT_THAT(
        parsed(R"(/simulation/wind={"strength":1,"direction":[0,1,0]},{})"),
        ElementsAre(R"({"strength":1,"direction":[0,1,0]})", "{}"));
}

TEST(ParseAxis, RefusesWhatHasNoValues) {
    const std::string expected = ": expected POINTER=V1,V2, as in /strands/density=16,64";
    EXPECT_EQ(
        errorText([] { scene::parseAxis("/strands/density"); }), "-a /strands/density" + expected);
    EXPECT_EQ(errorText([] { scene::parseAxis("=1"); }), "-a =1" + expected);
    EXPECT_EQ(errorText([] { scene::parseAxis("/a="); }), "-a /a=: a value is empty");
    EXPECT_EQ(errorText([] { scene::parseAxis("/a=1,,2"); }), "-a /a=1,,2: a value is empty");
}

TEST(ParseAxis, WritesOutRanges) {
    EXPECT_THAT(parsed("/groom/guides=pow2:4:6,86"), ElementsAre("16", "32", "64", "86"));
    EXPECT_THAT(parsed("/a=pow2:0:5:2"), ElementsAre("1", "4", "16"));
    EXPECT_THAT(parsed("/a=3:5"), ElementsAre("3", "4", "5"));
    EXPECT_THAT(parsed("/a=10:50:20"), ElementsAre("10", "30", "50"));
    EXPECT_THAT(parsed("/a=10:49:20,1"), ElementsAre("10", "30", "1"));
    EXPECT_THAT(parsed("/a=-1:1:0.5"), ElementsAre("-1", "-0.5", "0", "0.5", "1"));
    EXPECT_EQ(parsed("/a=0:1:0.1").size(), 11u);  // although ten times 0.1 is rounded
    EXPECT_THAT(parsed("/a=7:7"), ElementsAre("7"));
    EXPECT_EQ(parsed("/a=pow2:52:52")[0], "4503599627370496");
}

TEST(ParseAxis, TakesForStringsWhatIsNoRange) {
    EXPECT_THAT(
        parsed("/a=c:d,1:x,pow2:,pow2:3,1:2:3:4,:,\"1:2\",pow10:1:2"),
        ElementsAre(
            "\"c:d\"", "\"1:x\"", "\"pow2:\"", "\"pow2:3\"", "\"1:2:3:4\"", "\":\"", "\"1:2\"",
            "\"pow10:1:2\""));
}

TEST(ParseAxis, RefusesRangesWithoutValues) {
    const std::pair<const char*, const char*> errors[] = {
        {"5:3", "5:3: the last value is below the first"},
        {"1:3:0", "1:3:0: the step is not above 0"},
        {"1:3:-1", "1:3:-1: the step is not above 0"},
        {"0:1e9", "0:1e9: has more than 100000 values"},
        {"pow2:6:4", "pow2:6:4: the last value is below the first"},
        {"pow2:-1:4", "pow2:-1:4: exponents must be whole numbers in [0, 52]"},
        {"pow2:1:53", "pow2:1:53: exponents must be whole numbers in [0, 52]"},
        {"pow2:1:3:0.5", "pow2:1:3:0.5: exponents must be whole numbers in [0, 52]"}};
    for (const auto& [range, error] : errors) {
        const std::string argument = std::string("/a=") + range;
        EXPECT_EQ(errorText([&] { scene::parseAxis(argument); }), "-a " + argument + ": " + error);
    }
}

TEST(AxisLabels, AreTheLastTokens) {
    EXPECT_THAT(
        scene::axisLabels({"/groom/guides", "/render/msaa"}), ElementsAre("guides", "msaa"));
}

TEST(AxisLabels, TakeMoreTokensUntilTheyDiffer) {
    EXPECT_THAT(
        scene::axisLabels(
            {"/simulation/global/stiffness", "/lod/level", "/simulation/local/stiffness"}),
        ElementsAre("global.stiffness", "level", "local.stiffness"));
    EXPECT_THAT(
        scene::axisLabels({"/simulation/colliders/0/radius", "/simulation/colliders/1/radius"}),
        ElementsAre("0.radius", "1.radius"));
}

TEST(AxisLabels, NameTheOwnerOfAnElement) {
    EXPECT_THAT(scene::axisLabels({"/camera/position/2"}), ElementsAre("position.2"));
}

TEST(ValueLabel, DropsAStringsQuotes) {
    EXPECT_EQ(scene::valueLabel("lines"), "lines");
    EXPECT_EQ(scene::valueLabel({0, 0, 1}), "[0,0,1]");
    EXPECT_EQ(scene::valueLabel(64), "64");
}

}  // namespace
}  // namespace benchmarks
