#include "engine/pictures.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}

// PNG specification, 2nd edition: signature in 5.2, header chunk in 11.2.2.
TEST(ImageFile, WritesAPngOfTheSizeAndKindAsked) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "made" / "picture.png";
    const std::vector<std::uint8_t> pixels(4 * 5 * 3, 200);
    writePng(path, 5, 3, pixels);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_GT(bytes.size(), 33u);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(bytes.substr(12, 4), "IHDR");
    EXPECT_EQ(bigEndian(bytes, 16), 5u);
    EXPECT_EQ(bigEndian(bytes, 20), 3u);
    EXPECT_EQ(bytes[24], 8);  // bits per channel
    EXPECT_EQ(bytes[25], 6);  // RGBA
}

TEST(ImageFile, SaysWhichFileItCannotWrite) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels(4, 0);
    EXPECT_THROW(writePng(folder.path(), 1, 1, pixels), Error);
}

}  // namespace
}  // namespace engine
