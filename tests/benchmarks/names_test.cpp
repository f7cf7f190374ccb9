#include "benchmarks/scene/json.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndSubstitutions) {
    EXPECT_EQ(scene::editDistance("kitten", "sitting"), 3u);  // Levenshtein's textbook pair
    EXPECT_EQ(scene::editDistance("saturday", "sunday"), 3u);
    EXPECT_EQ(scene::editDistance("density", "density"), 0u);
    EXPECT_EQ(scene::editDistance("", "abc"), 3u);
    EXPECT_EQ(scene::editDistance("abc", ""), 3u);
}

TEST(UnknownName, SuggestsTheNearest) {
    EXPECT_EQ(
        scene::unknownName("unknown key", "densty", {"backend", "density"}),
        "unknown key (did you mean \"density\"?); known: backend, density");
}

TEST(UnknownName, SuggestsNothingFarAway) {
    EXPECT_EQ(
        scene::unknownName("unknown key", "q", {"guides", "file"}),
        "unknown key; known: guides, file");
}

}  // namespace
}  // namespace benchmarks
