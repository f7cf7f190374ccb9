#include "benchmarks/report/environment.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

// Test vectors of the algorithm's authors.
TEST(Hash, AgreesWithThePublishedVectors) {
    EXPECT_EQ(report::hashText(""), "cbf29ce484222325");
    EXPECT_EQ(report::hashText("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(report::hashText("foobar"), "85944171f73967e8");
}

TEST(Hash, KeepsLeadingZeros) {
    EXPECT_EQ(report::hashText("77kepQFQ8Kl").size(), 16u);
    for (char c = ' '; c < '~'; ++c) EXPECT_EQ(report::hashText(std::string(3, c)).size(), 16u);
}

TEST(Hash, SeesEveryByte) {
    EXPECT_NE(
        report::hashText(std::string(1000, 'a')), report::hashText(std::string(999, 'a') + 'b'));
    EXPECT_NE(report::hashText(std::string(1, '\0')), report::hashText(""));
}

}  // namespace
}  // namespace benchmarks
