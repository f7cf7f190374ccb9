#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <zlib.h>

#include "engine/pictures.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ReadImage, GivesWhatWasWritten) {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t i = 0; i < 4 * 5 * 3; ++i) rgba.push_back(static_cast<std::uint8_t>(i * 4));
    writePng(folder.file("a.png"), 5, 3, rgba);
    const Pixels pixels = readImage(folder.file("a.png"));
    EXPECT_EQ(pixels.width, 5u);
    EXPECT_EQ(pixels.height, 3u);
    EXPECT_EQ(pixels.rgba, rgba);
}

// Truevision TGA 2.0: 18 bytes. Type 3 is uncompressed grey; bit 5 of the last byte: top row first.
TEST(ReadImage, MakesGreyRedGreenAndBlue) {
    const TemporaryFolder folder;
    std::string tga(18, '\0');
    tga[2] = 3;
    tga[12] = 2;
    tga[14] = 1;
    tga[16] = 8;
    tga[17] = 0x20;
    const Pixels pixels = readImage(folder.write("a.tga", tga + "\x10\x80"));
    EXPECT_EQ(pixels.width, 2u);
    EXPECT_EQ(pixels.height, 1u);
    EXPECT_EQ(pixels.rgba, (std::vector<std::uint8_t>{16, 16, 16, 255, 128, 128, 128, 255}));
}

TEST(ReadImage, NamesTheFileThatItCannotRead) {
    const TemporaryFolder folder;
    EXPECT_EQ(errorText([] { readImage("no.png"); }), "no.png: no such file");
    EXPECT_THAT(errorText([&] { readImage(folder.path()); }), HasSubstr("not a file"));
    for (const std::string_view content : {"", "hello, this is text", "\x89PNG\r\n\x1a\n"}) {
        const auto path = folder.write("bad.png", content);
        EXPECT_THAT(
            errorText([&] { readImage(path); }),
            AllOf(StartsWith(path.string() + ": "), HasSubstr("not a PNG")));
    }
}

TEST(ReadImage, RefusesAPictureThatEnds) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> rgba(4 * 64 * 64, 77);
    writePng(folder.file("a.png"), 64, 64, rgba);
    const std::string bytes = textOf(folder.file("a.png"));
    for (std::size_t size = 0; size < bytes.size() - 12; size += 7) {  // the last chunk is empty
        const auto path = folder.write("cut.png", bytes.substr(0, size));
        EXPECT_THAT(errorText([&] { readImage(path); }), StartsWith(path.string() + ": "));
    }
}

// A picture of one pixel with 256 MiB of zeros, which deflate to a megabyte.
TEST(ReadImage, RefusesMoreDataThanThePictureHas) {
    const TemporaryFolder folder;
    const auto chunk = [](const std::string& type, const std::string& data) {
        std::string bytes;
        const auto number = [&](std::uint32_t value) {
            for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
        };
        number(static_cast<std::uint32_t>(data.size()));
        bytes += type + data;
        const std::string sum = type + data;
        number(static_cast<std::uint32_t>(
            crc32_z(0, reinterpret_cast<const Bytef*>(sum.data()), sum.size())));
        return bytes;
    };
    const auto png = [&](std::size_t zeros) {
        std::vector<Bytef> deflated(compressBound(zeros));
        uLongf size = deflated.size();
        const std::vector<Bytef> data(zeros);
        EXPECT_EQ(compress2(deflated.data(), &size, data.data(), zeros, 1), Z_OK);
        const std::string header("\0\0\0\1\0\0\0\1\10\0\0\0\0", 13);  // grey
        return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) +
               chunk("IDAT", {reinterpret_cast<const char*>(deflated.data()), size}) +
               chunk("IEND", "");
    };
    EXPECT_EQ(
        readImage(folder.write("a.png", png(2))).rgba, (std::vector<std::uint8_t>{0, 0, 0, 255}));
    EXPECT_THAT(
        errorText([&] { readImage(folder.write("b.png", png(std::size_t{1} << 28))); }),
        HasSubstr("the data exceed a picture of this size"));
}

// Only a Truevision TGA header, for 65,535 by 65,535 grey pixels. A reader that trusts it allocates
// 4 to 16 GiB.
TEST(ReadImage, ChecksTheSizeBeforeItDecodes) {
    const TemporaryFolder folder;
    std::string tga(18, '\0');
    tga[2] = 3;
    tga[12] = tga[13] = tga[14] = tga[15] = '\xff';
    tga[16] = 8;
    const auto path = folder.write("huge.tga", tga);
    EXPECT_EQ(
        errorText([&] { readImage(path); }),
        path.string() + ": has 65535 by 65535 pixels; expected 1 to 2^26 in all");
}

// Allowed sizes, in files of a few bytes: stb allocates a JPEG's 1 GB and a TGA's 64 MB of pixels
// before it finds that they are missing.
TEST(ReadImage, RefusesAPictureThatIsTooShortForItsSize) {
    const TemporaryFolder folder;
    std::string tga(18, '\0');
    tga[2] = 3;
    tga[13] = tga[15] = 0x1f;  // 7,936 by 7,936
    tga[16] = 8;
    // ITU-T T.81, annex B: SOI, and a progressive frame (SOF2) with three channels.
    const std::string jpeg(
        "\xff\xd8\xff\xc2\0\x11\x08\x1f\0\x1f\0\3\1\x11\0\2\x11\0\3\x11\0\xff\xd9", 23);
    for (const std::string& bytes : {tga, jpeg}) {
        const auto path = folder.write("short.tga", bytes);
        EXPECT_EQ(
            errorText([&] { readImage(path); }),
            path.string() + ": ends too early for a picture of its size");
    }
}

// ITU-T T.81, B.2.4.2: 257 codes, one of 2 bits and 256 of 16 bits. stb would write past the end of
// its own table.
TEST(ReadImage, RefusesAHuffmanTableOfMoreCodesThanThereAre) {
    const TemporaryFolder folder;
    const auto jpeg = [](int last_count) {
        std::string table("\0\0\1\0\0\0\0\0\0\0\0\0\0\0\0\xff", 16);
        table += static_cast<char>(last_count);
        table.append(257, '\0');
        const std::string length{
            static_cast<char>((table.size() + 2) >> 8),
            static_cast<char>((table.size() + 2) & 0xff)};
        return "\xff\xd8\xff\xc4" + length + table + "\xff\xd9";
    };
    const auto path = folder.write("a.jpg", jpeg(1));
    EXPECT_EQ(
        errorText([&] { readImage(path); }), path.string() + ": a Huffman table has 257 codes");
    // A table after fill bytes, and one that exceeds its segment.
    folder.write("a.jpg", "\xff" + jpeg(1));
    EXPECT_EQ(
        errorText([&] { readImage(path); }), path.string() + ": a Huffman table has 257 codes");
    folder.write("a.jpg", std::string("\xff\xd8\xff\xc4\0\3\0", 7) + std::string(40, '\x20'));
    EXPECT_EQ(errorText([&] { readImage(path); }), path.string() + ": a Huffman table is cut off");
}

}  // namespace
}  // namespace engine
