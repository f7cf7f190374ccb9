#include <limits>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"

namespace benchmarks {
namespace {

// Handwritten, with members out of alphabetical order.
constexpr const char* kText = R"({"seed":7,"camera":{"up":[0,1,0.5]},"a":null})";

scene::Document example() { return scene::Document(scene::Json::parse(kText)); }

static_assert(std::is_nothrow_move_constructible_v<scene::Document>);
static_assert(std::is_nothrow_move_assignable_v<scene::Document>);
static_assert(!std::is_convertible_v<std::string, scene::Document>);  // that would quote JSON text

TEST(Document, IsNullUntilItIsGivenAValue) {
    EXPECT_TRUE(scene::Document().json().is_null());
    EXPECT_EQ(scene::Document().text(), "null");
    EXPECT_EQ(scene::Document(), scene::Document(nullptr));
}

TEST(Document, HasTheValueItWasMadeFrom) {
    const scene::Document document = example();
    EXPECT_EQ(document.json().at("seed"), 7);
    EXPECT_EQ(document.json().at("camera").at("up").at(2), 0.5);
}

TEST(Document, KeepsTheOrderOfMembersInItsText) { EXPECT_EQ(example().text(), kText); }

TEST(Document, IsTextAlsoWhereBytesAreNoUtf8) {
    EXPECT_EQ(scene::Document("caf\xe9").text(), "\"caf\xef\xbf\xbd\"");
}

TEST(Document, IsCopiedAsAValue) {
    scene::Document original = example();
    const scene::Document copy = original;
    EXPECT_EQ(copy, original);
    EXPECT_NE(&copy.json(), &original.json());
    original = scene::Document(1);
    EXPECT_EQ(copy.text(), kText);
    original = copy;
    EXPECT_EQ(original.text(), kText);
}

TEST(Document, IsItselfAfterSelfAssignment) {
    scene::Document document = example();
    const scene::Document& same = document;
    document = same;
    EXPECT_EQ(document.text(), kText);
}

TEST(Document, IsMovedWithoutACopy) {
    scene::Document from = example();
    const scene::Json* const value = &from.json();
    const scene::Document to = std::move(from);
    EXPECT_EQ(&to.json(), value);
    EXPECT_TRUE(from.json().is_null());  // NOLINT(bugprone-use-after-move)
}

TEST(Document, IsEqualWhereItsTextIs) {
    EXPECT_EQ(example(), example());
    EXPECT_EQ(scene::Document(std::int64_t{16}), scene::Document(std::uint64_t{16}));
    EXPECT_NE(scene::Document(1), scene::Document(1.0));
    EXPECT_NE(scene::Document(0.0), scene::Document(-0.0));
    EXPECT_NE(scene::Document(1), scene::Document("1"));
    EXPECT_NE(
        scene::Document(scene::Json::parse(R"({"a":1,"b":2})")),
        scene::Document(scene::Json::parse(R"({"b":2,"a":1})")));
    EXPECT_NE(scene::Document(), scene::Document(scene::Json::object()));
}

TEST(SameText, IsThatOfTheTexts) {
    const scene::Json values[] = {
        scene::Json(1),
        scene::Json(1u),
        scene::Json(1.0),
        scene::Json(0.0),
        scene::Json(-0.0),
        scene::Json(-1),
        scene::Json("1"),
        scene::Json(true),
        scene::Json(nullptr),
        scene::Json(std::numeric_limits<double>::quiet_NaN()),
        scene::Json::array(),
        scene::Json::array({1, 2}),
        scene::Json::array({1, 2.0}),
        scene::Json::array({2, 1}),
        scene::Json::object(),
        scene::Json::parse(R"({"a":1,"b":2})"),
        scene::Json::parse(R"({"b":2,"a":1})"),
        scene::Json::parse(R"({"a":1,"b":[{}]})"),
        scene::Json(18446744073709551615u)};
    for (const scene::Json& a : values)
        for (const scene::Json& b : values) {
            if (a.is_null() != b.is_null())
                continue;  // NaN, which no document has, is written as "null"
            EXPECT_EQ(scene::sameText(a, b), a.dump() == b.dump()) << a << ' ' << b;
        }
}

}  // namespace
}  // namespace benchmarks
