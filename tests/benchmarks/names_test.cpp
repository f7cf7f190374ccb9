#include "benchmarks/scene/json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
        "unknown key (did you mean 'density'?); known: backend, density");
}

TEST(UnknownName, SuggestsNothingFarAway) {
    EXPECT_EQ(
        scene::unknownName("unknown key", "q", {"guides", "file"}),
        "unknown key; known: guides, file");
}

// Errors of the JSON library that readers of reports meet.
TEST(JsonReason, SaysWhatWasExpected) {
    const auto reason = [](const auto& read) -> std::string {
        try {
            read(scene::Json::parse(R"({"name": "a", "list": [1]})"));
        } catch (const scene::Json::exception& error) {
            return scene::jsonReason(error);
        }
        return "no error";
    };
    using scene::Json;
    EXPECT_EQ(
        reason([](const Json& json) { json.at("name").get<double>(); }),
        "expected a number, found a string");
    EXPECT_EQ(
        reason([](const Json& json) { json.at("list").get<std::string>(); }),
        "expected a string, found an array");
    EXPECT_EQ(reason([](const Json& json) { json.at("nmae"); }), "'nmae' is missing");
    EXPECT_EQ(
        reason([](const Json& json) { json.at("name").at("first"); }),
        "expected an object or an array, found a string");
    EXPECT_EQ(
        reason([](const Json& json) { json.at("list").at(3); }), "array index 3 is out of range");
}

}  // namespace
}  // namespace benchmarks
