#include "benchmarks/scene/scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

std::string merged(const char* target, const char* patch, const char* known = "{}") {
    scene::Json document = scene::Json::parse(target);
    scene::mergePatch(document, scene::Json::parse(patch), scene::Json::parse(known));
    return document.dump();
}

// Rows of RFC 7386, appendix A, in which the documents are objects.
TEST(MergePatch, DoesWhatTheRfcSays) {
    EXPECT_EQ(merged(R"({"a":"b"})", R"({"a":"c"})"), R"({"a":"c"})");
    EXPECT_EQ(merged(R"({"a":"b"})", R"({"b":"c"})"), R"({"a":"b","b":"c"})");
    EXPECT_EQ(merged(R"({"a":"b"})", R"({"a":null})"), "{}");
    EXPECT_EQ(merged(R"({"a":"b","b":"c"})", R"({"a":null})"), R"({"b":"c"})");
    EXPECT_EQ(merged(R"({"a":["b"]})", R"({"a":"c"})"), R"({"a":"c"})");
    EXPECT_EQ(merged(R"({"a":"c"})", R"({"a":["b"]})"), R"({"a":["b"]})");
    EXPECT_EQ(
        merged(R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"c":1}})"),
        R"({"a":{"b":"d"}})");
    EXPECT_EQ(merged(R"({"a":[{"b":"c"}]})", R"({"a":[1]})"), R"({"a":[1]})");
    EXPECT_EQ(merged(R"({"e":null})", R"({"a":1})"), R"({"e":null,"a":1})");
    EXPECT_EQ(
        merged("{}", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{"ccc":1}}})"),
        R"({"a":{"bb":{}}})");
}

TEST(MergePatch, RemovesNothingThatCannotBeThere) {
    EXPECT_EQ(
        errorText([] { merged(R"({"a":{"b":1}})", R"({"a":{"bb":null}})", R"({"a":{"c":1}})"); }),
        "/a/bb: nothing to remove (did you mean 'b'?); known: c, b");
    EXPECT_EQ(
        errorText([] { merged("{}", R"({"a":{"b":null}})"); }),
        "/a/b: the base has nothing to remove here");
}

}  // namespace
}  // namespace benchmarks
