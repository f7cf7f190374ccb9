#include <gtest/gtest.h>

#include "hair/groom/mesh/gltf_model.h"

namespace hair::groom {
namespace {

// RFC 4648, section 10.
TEST(DecodeBase64, GivesTheStandardsVectors) {
    EXPECT_EQ(decodeBase64(""), "");
    EXPECT_EQ(decodeBase64("Zg=="), "f");
    EXPECT_EQ(decodeBase64("Zm8="), "fo");
    EXPECT_EQ(decodeBase64("Zm9v"), "foo");
    EXPECT_EQ(decodeBase64("Zm9vYg=="), "foob");
    EXPECT_EQ(decodeBase64("Zm9vYmE="), "fooba");
    EXPECT_EQ(decodeBase64("Zm9vYmFy"), "foobar");
}

// Section 4: the last two characters of the alphabet have the values 62 and 63.
TEST(DecodeBase64, KnowsTheWholeAlphabet) { EXPECT_EQ(decodeBase64("+/+/"), "\xfb\xff\xbf"); }

TEST(DecodeBase64, RefusesOtherText) {
    for (const char* text :
         {"Z", "Zg=", "Zg", "Z===", "====", "Zg==Zg==", "Zm9\n", "Zm9-",
          "Zm\xff"
          "v"})
        EXPECT_FALSE(decodeBase64(text)) << text;
}

}  // namespace
}  // namespace hair::groom
