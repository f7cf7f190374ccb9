#include "benchmarks/hash.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

// Test vectors of the algorithm's authors.
TEST(Hash, AgreesWithThePublishedVectors) {
    EXPECT_EQ(hashText(""), "cbf29ce484222325");
    EXPECT_EQ(hashText("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(hashText("foobar"), "85944171f73967e8");
}

TEST(Hash, KeepsLeadingZeros) {
    EXPECT_EQ(hashText("77kepQFQ8Kl").size(), 16u);
    for (char c = ' '; c < '~'; ++c) EXPECT_EQ(hashText(std::string(3, c)).size(), 16u);
}

TEST(Hash, SeesEveryByte) {
    EXPECT_NE(hashText(std::string(1000, 'a')), hashText(std::string(999, 'a') + 'b'));
    EXPECT_NE(hashText(std::string(1, '\0')), hashText(""));
}

}  // namespace
}  // namespace benchmarks
