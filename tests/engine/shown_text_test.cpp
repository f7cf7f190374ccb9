#include "engine/error.h"

#include <string>

#include <gtest/gtest.h>

namespace engine {
namespace {

// ECMA-48: a terminal's control sequence starts with a control character, C0 or C1.
TEST(ShownText, ObeysNothing) {
    EXPECT_EQ(shownText("a\x1b[31mb\x07\x7f"), "a?[31mb??");
    EXPECT_EQ(shownText("a\u009b31mb"), "a?31mb");
    EXPECT_EQ(shownText("one\nhairbench: ok\r\ttwo"), "one hairbench: ok  two");
    EXPECT_EQ(shownText(std::string("a\0b", 3)), "a?b");
}

// UAX #9, section 2: embeddings, overrides, isolates and marks.
TEST(ShownText, RunsOneWay) {
    for (const char* each :
         {"\u202a", "\u202b", "\u202c", "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069",
          "\u200e", "\u200f", "\u061c"})
        EXPECT_EQ(shownText(std::string("a") + each + "b"), "a?b") << each;
    EXPECT_EQ(shownText("a\u2028b\u2029c\u200bd\ufeffe"), "a?b?c?d?e");
}

TEST(ShownText, IsUtf8) {
    EXPECT_EQ(shownText("Härchen 毛 😀"), "Härchen 毛 😀");
    // RFC 3629: a lone continuation byte, a missing one, two overlong forms, a surrogate, and a
    // value past U+10FFFF.
    EXPECT_EQ(shownText("\x80"), "?");
    EXPECT_EQ(shownText("\xe6\xaf"), "??");
    EXPECT_EQ(shownText("\xc0\xaf"), "??");
    EXPECT_EQ(shownText("\xe0\x80\xaf"), "???");
    EXPECT_EQ(shownText("\xed\xa0\x80"), "???");
    EXPECT_EQ(shownText("\xf4\x90\x80\x80"), "????");
}

TEST(ShownText, IsCutBetweenCharacters) {
    EXPECT_EQ(shownText("12345", 5), "12345");
    std::string text;
    for (int i = 0; i < 100; ++i) text += "毛";
    for (std::size_t longest = 60; longest < 70; ++longest) {
        const std::string shown = shownText(text, longest);
        EXPECT_LE(shown.size(), longest);
        EXPECT_GT(shown.size(), longest - 6);
        EXPECT_EQ(shown.find('?'), std::string::npos);
        EXPECT_NE(shown.find(" [...] "), std::string::npos);
    }
}

}  // namespace
}  // namespace engine
