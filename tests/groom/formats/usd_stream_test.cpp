#include "hair/groom/formats/usd_import.h"

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

template <class Value>
void append(std::vector<std::byte>& bytes, const Value& value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

constexpr UsdStreamHeader kHeader{
    .magic = UsdStreamHeader::kMagic,
    .metres_per_unit = 0.01,
    .strands = 2,
    .points = 3,
    .widths = 3,
    .transparencies = 1,
    .colors = 3,
    .root_uvs = 2,
    .root_triangles = 1,
    .groups = 2,
    .guides = 2,
    .comment = 4,
    .warnings = 7,
    .stated = 3};

// The offsets of the arrays.
constexpr std::size_t kSizes = 112;
constexpr std::size_t kPointStream = kSizes + 8;
constexpr std::size_t kWidths = kPointStream + 36;
constexpr std::size_t kTriangles = kWidths + 12 + 4 + 36 + 16;

std::vector<std::byte> stream() {
    std::vector<std::byte> bytes;
    append(bytes, kHeader);
    append(bytes, std::array{1u, 2u});
    for (int k = 0; k < 9; ++k) append(bytes, static_cast<float>(k));
    append(bytes, std::array{0.5f, 0.25f, 0.125f});
    append(bytes, 0.75f);
    for (int k = 0; k < 9; ++k) append(bytes, static_cast<float>(-k));
    append(bytes, std::array{0.1f, 0.2f, 0.3f, 0.4f});
    append(bytes, std::array{0u, 1u, 0u});
    append(bytes, std::array{-7, 8});
    append(bytes, std::array<std::uint8_t, 2>{1, 0});
    for (const char c : std::string("hairone\ntwo")) append(bytes, c);
    return bytes;
}

template <class Value>
std::vector<std::byte> with(std::size_t offset, const Value& value) {
    std::vector<std::byte> bytes = stream();
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return bytes;
}

std::string refusal(const std::vector<std::byte>& bytes) {
    return errorText([&] { readUsdStream(bytes); });
}

TEST(UsdStream, HoldsAllThatStrandsHave) {
    const StrandSet set = readUsdStream(stream());
    EXPECT_THAT(set.ends, ElementsAre(1u, 3u));
    EXPECT_THAT(
        set.points, ElementsAre(glm::vec3(0, 1, 2), glm::vec3(3, 4, 5), glm::vec3(6, 7, 8)));
    EXPECT_THAT(set.widths.values, ElementsAre(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(set.transparencies.everywhere, 0.75f);
    EXPECT_TRUE(set.transparencies.values.empty());
    EXPECT_EQ(set.colors.at(2), glm::vec3(-6, -7, -8));
    EXPECT_THAT(set.root_uvs, ElementsAre(glm::vec2(0.1f, 0.2f), glm::vec2(0.3f, 0.4f)));
    EXPECT_THAT(set.root_triangles, ElementsAre(std::array{0u, 1u, 0u}));
    EXPECT_THAT(set.groups, ElementsAre(-7, 8));
    EXPECT_THAT(set.guides, ElementsAre(1, 0));
    EXPECT_EQ(set.metres_per_unit, 0.01);
    EXPECT_EQ(set.up, 1);
    EXPECT_EQ(set.comment, "hair");
    EXPECT_THAT(set.warnings, ElementsAre("one", "two"));
}

TEST(UsdStream, HasNoUnitAndNoUpwardAxisUnlessStated) {
    constexpr std::size_t kStated = 104;
    EXPECT_FALSE(readUsdStream(with(kStated, std::uint64_t{2})).metres_per_unit);
    EXPECT_EQ(readUsdStream(with(kStated, std::uint64_t{2})).up, 1);
    EXPECT_EQ(readUsdStream(with(kStated, std::uint64_t{1})).metres_per_unit, 0.01);
    EXPECT_FALSE(readUsdStream(with(kStated, std::uint64_t{1})).up);
    EXPECT_THAT(refusal(with(kStated, std::uint64_t{4})), StartsWith("byte 104: "));
}

TEST(UsdStream, RefusesEveryTruncationAndTrailingBytes) {
    const std::vector<std::byte> whole = stream();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_THAT(refusal({whole.begin(), whole.begin() + size}), StartsWith("byte ")) << size;
    }
    std::vector<std::byte> longer = whole;
    longer.push_back({});
    EXPECT_THAT(refusal(longer), StartsWith("byte " + std::to_string(whole.size())));
}

TEST(UsdStream, RefusesEveryOtherCount) {
    for (std::size_t i = 0; i < 11; ++i) {
        std::uint64_t count = 0;
        std::memcpy(&count, stream().data() + 16 + 8 * i, sizeof count);
        for (const std::uint64_t wrong :
             {count + 1, count - 1, std::uint64_t{0}, std::uint64_t{1} << 32,
              std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
            if (wrong == count) continue;
            EXPECT_THAT(refusal(with(16 + 8 * i, wrong)), StartsWith("byte ")) << i << ' ' << wrong;
        }
    }
}

TEST(UsdStream, RefusesNumbersThatMakeNoSense) {
    EXPECT_THAT(refusal(with(0, 'h')), StartsWith("byte 0: "));
    EXPECT_THAT(refusal(with(8, 0.0)), StartsWith("byte 8: "));
    EXPECT_THAT(refusal(with(8, -1.0)), StartsWith("byte 8: "));
    EXPECT_THAT(refusal(with(8, std::numeric_limits<double>::infinity())), StartsWith("byte 8: "));
    EXPECT_THAT(refusal(with(kSizes, std::array{1u, 3u})), StartsWith("byte 116: "));
    EXPECT_THAT(refusal(with(kSizes, std::array{2u, ~0u})), StartsWith("byte 116: "));
    EXPECT_THAT(refusal(with(kSizes, std::array{1u, 1u})), StartsWith("byte 24: "));
    EXPECT_THAT(refusal(with(kTriangles + 4, 2u)), StartsWith("byte 224: strand 2"));
    EXPECT_THAT(
        refusal(with(kTriangles + 12 + 8, std::uint8_t{2})), StartsWith("byte 244: a guide"));
}

}  // namespace
}  // namespace hair::groom
