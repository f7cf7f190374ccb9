#pragma once

#include <bit>
#include <cstring>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "hair/groom/files.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {

using ReadStrands = decltype(StrandImporter::read);
using WriteStrands = decltype(StrandExporter::write);

// Reads as importStrands() does.
inline StrandSet
readText(ReadStrands read, std::string_view text, const std::filesystem::path& path = {}) {
    return usableStrands(read({std::as_bytes(std::span(text)), path}));
}

inline std::string readError(ReadStrands read, std::string_view text) {
    return errorText([&] { readText(read, text); });
}

inline StrandSet readFile(ReadStrands read, const std::filesystem::path& path) {
    return readText(read, textOf(path), path);
}

struct Written {
    std::string bytes;
    std::vector<std::string> warnings;
};

inline Written writeText(WriteStrands write, const StrandSet& strands) {
    std::ostringstream out;
    std::vector<std::string> warnings = write(strands, out);
    return {out.str(), warnings};
}

inline std::filesystem::path corpus(std::string_view file) {
    return std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "tests/corpus" / file;
}

template <class Value>
void expectBitEqual(const std::vector<Value>& read, const std::vector<Value>& expected) {
    ASSERT_EQ(read.size(), expected.size());
    if (read.empty()) return;
    EXPECT_EQ(std::memcmp(read.data(), expected.data(), read.size() * sizeof(Value)), 0);
}

// Strands of 5, 2 and 3 points, with floats that are difficult to preserve: both zeros, the least
// and the greatest, neighbours of round numbers.
inline StrandSet hardStrands() {
    StrandSet set;
    set.ends = {5, 7, 10};
    set.points = {
        {0.0f, -0.0f, 1e-45f},
        {0.1f, 0.2f, 0.3f},
        {3.4028235e38f, -1.17549435e-38f, 16777217.0f},
        {std::nextafter(1.0f, 2.0f), std::nextafter(1.0f, 0.0f), 1e-30f},
        {1.0f / 3.0f, 2.0f / 3.0f, 123456.789f},
        {-1.0f, 0.0f, 0.0f},
        {-1.0f, 9.999999e9f, 5e-7f},
        {2.0f, 0.0f, 0.0f},
        {2.0f, 1.0f, 0.0f},
        {2.0f, 2.0f, -0.0f}};
    for (std::size_t i = 0; i < set.points.size(); ++i) {
        const float share = static_cast<float>(i) / 7.0f;
        set.widths.values.push_back(1e-4f / (1.0f + share));
        set.transparencies.values.push_back(share / 3.0f);
        set.colors.values.push_back({share / 2.0f, 1.0f / 3.0f, 1.0f - share / 2.0f});
    }
    return set;
}

// "<reason> is left out" with the number of the strand, as warnings say it.
inline std::string leftOutStrand(const std::string& reason, std::uint32_t strand) {
    return warningOf({.reason = reason, .count = 1, .first = strand});
}
inline const std::string kNoPosition = "with a position that is not finite";

// The strands of the examples in text formats: three points in a plane, and two beside them.
inline void expectTheStrands(const StrandSet& strands) {
    EXPECT_THAT(strands.ends, testing::ElementsAre(3, 5));
    EXPECT_THAT(
        strands.points, testing::ElementsAre(
                            glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 2, 0.5f),
                            glm::vec3(4, 0, 0), glm::vec3(4, 1, 0)));
    EXPECT_FALSE(strands.metres_per_unit);
}

}  // namespace hair::groom
