#include "benchmarks/scene/pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

TEST(Pattern, IsFoundAnywhereInAName) {
    const scene::Pattern pattern("density:(1|64)$");
    EXPECT_TRUE(pattern.isIn("s/density:1"));
    EXPECT_FALSE(pattern.isIn("s/density:16"));
    EXPECT_TRUE(pattern.isIn("s/density:64"));
    EXPECT_TRUE(scene::Pattern("").isIn("s/density:16"));
    EXPECT_TRUE(scene::Pattern("guides:\\d+/.*msaa:1").isIn("thesis/guides:86/msaa:1"));
}

TEST(Pattern, RefusesWhatIsNone) {
    for (const char* wrong : {"(x", "[a", "*", "a**b)", "(?=x)", "(a)\\1"})
        EXPECT_NE(errorText([&] { scene::Pattern{wrong}; }), "no error") << wrong;
}

// std::regex of libstdc++ recurses for each character, so a megabyte of text would overflow the
// stack.
TEST(Pattern, TakesTextsOfAnyLength) {
    const std::string text(std::size_t{4} << 20, 'a');
    EXPECT_TRUE(scene::Pattern("^(a|b)*$").isIn(text));
    EXPECT_FALSE(scene::Pattern("(a|b)*c").isIn(text));
}

// With backtracking, each character doubles the time, so forty would take an hour.
TEST(Pattern, TakesTimeByTheTextAlone) {
    EXPECT_FALSE(scene::Pattern("^(a+)+$").isIn(std::string(100'000, 'a') + 'b'));
    // A pattern that needs too many states is refused.
    EXPECT_NE(errorText([] { scene::Pattern("((a{1000}){1000}){1000}"); }), "no error");
}

TEST(CaseFile, HasTheValuesOfTheAxes) {
    const auto file = [](const char* pattern, const char* name) {
        return scene::caseFile(pattern, "thesis", name).string();
    };
    EXPECT_EQ(file("out/{case}.png", "thesis/guides:86/msaa:4"), "out/guides-86_msaa-4.png");
    EXPECT_EQ(file("{case}/{case}_%04d.png", "thesis/msaa:4"), "msaa-4/msaa-4_%04d.png");
    EXPECT_EQ(file("{case}.npy", "thesis"), "thesis.npy");  // without a sweep
    EXPECT_EQ(file("{case}.npy", "thesis2/msaa:4"), "thesis2_msaa-4.npy");  // of a suite
    EXPECT_EQ(file("{case}.npy", "thesis/file:a\\b\"c*?<>|"), "file-a-b-c-----.npy");
    EXPECT_EQ(file("one.npy", "thesis/msaa:4"), "one.npy");
    EXPECT_TRUE(scene::hasCasePlace("x/{case}.png"));
    EXPECT_FALSE(scene::hasCasePlace("x/case.png"));
}

}  // namespace
}  // namespace benchmarks
