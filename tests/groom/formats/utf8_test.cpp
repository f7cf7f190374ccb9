#include "hair/groom/formats/text.h"

#include <gtest/gtest.h>

namespace hair::groom {
namespace {

// The forms of RFC 3629, section 4, and their limits.
TEST(Utf8, KnowsItsForms) {
    for (const char* text :
         {"", "hair", "\u00e4", "\u07ff", "\u0800", "\ud7ff", "\uffff", "\U00010000",
          "\U0010ffff"}) {
        EXPECT_TRUE(isUtf8(text)) << text;
    }
    for (const char* text :
         {"\xe4", "\xc3", "\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80",
          "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\xe2\x82"}) {
        EXPECT_FALSE(isUtf8(text)) << text;
    }
}

TEST(Utf8, TakesLatin1) { EXPECT_EQ(utf8FromLatin1("br\xe4un \xff"), "br\u00e4un \u00ff"); }

}  // namespace
}  // namespace hair::groom
