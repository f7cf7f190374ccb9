#include <type_traits>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"

namespace benchmarks {
namespace {

// Made by hand, in an order that is not the alphabet's.
constexpr const char* kText = R"({"seed":7,"camera":{"up":[0,1,0.5]},"a":null})";

Document example() { return Document(Json::parse(kText)); }

static_assert(std::is_nothrow_move_constructible_v<Document>);
static_assert(std::is_nothrow_move_assignable_v<Document>);
static_assert(!std::is_convertible_v<std::string, Document>);  // which would quote JSON text

TEST(Document, IsNullUntilItIsGivenAValue) {
    EXPECT_TRUE(Document().json().is_null());
    EXPECT_EQ(Document().text(), "null");
    EXPECT_EQ(Document(), Document(nullptr));
}

TEST(Document, HasTheValueItWasMadeFrom) {
    const Document document = example();
    EXPECT_EQ(document.json().at("seed"), 7);
    EXPECT_EQ(document.json().at("camera").at("up").at(2), 0.5);
}

TEST(Document, KeepsTheOrderOfMembersInItsText) { EXPECT_EQ(example().text(), kText); }

TEST(Document, IsTextAlsoWhereBytesAreNoUtf8) {
    EXPECT_EQ(Document("caf\xe9").text(), "\"caf\xef\xbf\xbd\"");
}

TEST(Document, IsCopiedAsAValue) {
    Document original = example();
    const Document copy = original;
    EXPECT_EQ(copy, original);
    EXPECT_NE(&copy.json(), &original.json());
    original = Document(1);
    EXPECT_EQ(copy.text(), kText);
    original = copy;
    EXPECT_EQ(original.text(), kText);
}

TEST(Document, IsItselfAfterSelfAssignment) {
    Document document = example();
    const Document& same = document;
    document = same;
    EXPECT_EQ(document.text(), kText);
}

TEST(Document, IsMovedWithoutACopy) {
    Document from = example();
    const Json* const value = &from.json();
    const Document to = std::move(from);
    EXPECT_EQ(&to.json(), value);
    EXPECT_TRUE(from.json().is_null());  // NOLINT(bugprone-use-after-move)
}

TEST(Document, IsEqualWhereItsTextIs) {
    EXPECT_EQ(example(), example());
    EXPECT_EQ(Document(std::int64_t{16}), Document(std::uint64_t{16}));
    EXPECT_NE(Document(1), Document(1.0));
    EXPECT_NE(Document(0.0), Document(-0.0));
    EXPECT_NE(Document(1), Document("1"));
    EXPECT_NE(Document(Json::parse(R"({"a":1,"b":2})")), Document(Json::parse(R"({"b":2,"a":1})")));
    EXPECT_NE(Document(), Document(Json::object()));
}

}  // namespace
}  // namespace benchmarks
