#include "benchmarks/axis.h"

#include <gmock/gmock.h>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;

TEST(ParseAxis, ReadsValuesAsJsonWhereTheyAre) {
    const Axis axis = parseAxis("/strands/density=16,64.5,true");
    EXPECT_EQ(axis.pointer, "/strands/density");
    EXPECT_THAT(axis.values, ElementsAre("16", "64.5", "true"));
}

TEST(ParseAxis, ReadsTheRestAsStrings) {
    EXPECT_THAT(
        parseAxis("/strands/backend=tessellation,\"a,b\",x=y").values,
        ElementsAre("\"tessellation\"", "\"a,b\"", "\"x=y\""));
}

TEST(ParseAxis, KeepsVectorsTogether) {
    EXPECT_THAT(
        parseAxis("/camera/position=[0,0,1],[0, 0, 2]").values, ElementsAre("[0,0,1]", "[0,0,2]"));
    EXPECT_THAT(
        parseAxis(R"(/simulation/wind={"strength":1,"direction":[0,1,0]},{})").values,
        ElementsAre(R"({"strength":1,"direction":[0,1,0]})", "{}"));
}

TEST(ParseAxis, RefusesWhatHasNoValues) {
    const std::string expected = ": expected POINTER=V1,V2, as in /strands/density=16,64";
    EXPECT_EQ(errorText([] { parseAxis("/strands/density"); }), "-a /strands/density" + expected);
    EXPECT_EQ(errorText([] { parseAxis("=1"); }), "-a =1" + expected);
    EXPECT_EQ(errorText([] { parseAxis("/a="); }), "-a /a=: a value is empty");
    EXPECT_EQ(errorText([] { parseAxis("/a=1,,2"); }), "-a /a=1,,2: a value is empty");
}

TEST(AxisLabels, AreTheLastTokens) {
    EXPECT_THAT(axisLabels({"/groom/guides", "/render/msaa"}), ElementsAre("guides", "msaa"));
}

TEST(AxisLabels, TakeMoreTokensUntilTheyDiffer) {
    EXPECT_THAT(
        axisLabels({"/simulation/global/stiffness", "/lod/level", "/simulation/local/stiffness"}),
        ElementsAre("global.stiffness", "level", "local.stiffness"));
    EXPECT_THAT(
        axisLabels({"/simulation/colliders/0/radius", "/simulation/colliders/1/radius"}),
        ElementsAre("0.radius", "1.radius"));
}

TEST(AxisLabels, NameTheOwnerOfAnElement) {
    EXPECT_THAT(axisLabels({"/camera/position/2"}), ElementsAre("position.2"));
}

TEST(ValueLabel, DropsAStringsQuotes) {
    EXPECT_EQ(valueLabel("\"lines\""), "lines");
    EXPECT_EQ(valueLabel("[0,0,1]"), "[0,0,1]");
    EXPECT_EQ(valueLabel("64"), "64");
}

}  // namespace
}  // namespace benchmarks
