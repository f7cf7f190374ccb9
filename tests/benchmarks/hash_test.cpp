#include "benchmarks/report/environment.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

// Test vectors from the algorithm's authors.
TEST(Hash, AgreesWithThePublishedVectors) {
    EXPECT_EQ(report::hashText(""), "cbf29ce484222325");
    EXPECT_EQ(report::hashText("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(report::hashText("foobar"), "85944171f73967e8");
}

// FIPS 180-4's examples as published by NIST, with two blocks and a million letters.
TEST(Sha256, AgreesWithThePublishedVectors) {
    EXPECT_EQ(
        report::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(
        report::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(
        report::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(
        report::sha256(std::string(1000000, 'a')),
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
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
