#include "benchmarks/viewer/scene_file.h"

#include <gmock/gmock.h>

#include "benchmarks/scene/scene.h"
#include "engine/pictures.h"
#include "engine/png_text.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::uint8_t> kFourPixels{255, 0, 0, 255, 0,   255, 0,  128,
                                            0,   0, 1, 0,   255, 255, 90, 7};
constexpr const char* kScene = "{ \"description\": \"größer\", \"seed\": 7 }\n";

std::string fromHex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return bytes;
}

// A PNG of one pixel with a chunk between its header and its picture. Python's zlib and binascii
// made these files.
std::string pngWith(const std::string& chunk) {
    return fromHex("89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c489") + chunk +
           fromHex("0000000d4944415478da63f8cfc0f01f00050001ff56c72f0d0000000049454e44ae426082");
}

const std::string kText =
    fromHex("0000001d744558746861697262656e63682d7363656e65007b202273656564223a2037207dcd9970d0");
const std::string kCompressed = fromHex(
    "000000267a5458746861697262656e63682d7363656e65000078daab56502a4e4d4d51b2523057a805001b0103af9a"
    "780063");
const std::string kInternational = fromHex(
    "00000030695458746861697262656e63682d7363656e65000100656e00537a656e650078daab56502a4e4d4d51b252"
    "3057a805001b0103afbd56325b");

class Screenshot : public testing::Test {
protected:
    std::filesystem::path shot() const {
        writeScreenshot(folder_.file("a.png"), 2, 2, kFourPixels, kScene);
        return folder_.file("a.png");
    }

    std::optional<std::string> sceneIn(std::string_view file) const {
        return scene::sceneOfScreenshot(folder_.write("b.png", file));
    }

    std::string errorOf(std::string_view file) const {
        return folder_.relative(errorText([&] { sceneIn(file); }));
    }

    TemporaryFolder folder_;
};

TEST_F(Screenshot, HasThePictureAndTheScene) {
    const auto path = shot();
    EXPECT_EQ(engine::readImage(path).rgba, kFourPixels);
    EXPECT_EQ(scene::sceneOfScreenshot(path), kScene);
}

TEST_F(Screenshot, IsASceneFile) {
    const scene::Scene scene = scene::loadScene(shot());
    EXPECT_EQ(scene.settings.seed, 7u);
    EXPECT_EQ(scene.settings.description, "größer");
    EXPECT_EQ(scene.directory, folder_.path());
    EXPECT_EQ(scene.name, "a");
}

TEST_F(Screenshot, KeepsItsSceneInOtherKindsOfText) {
    EXPECT_EQ(sceneIn(pngWith(kText)), "{ \"seed\": 7 }");
    EXPECT_EQ(sceneIn(pngWith(kCompressed)), "{ \"seed\": 7 }");
    EXPECT_EQ(sceneIn(pngWith(kInternational)), "{ \"seed\": 7 }");
}

TEST_F(Screenshot, MayHaveNoScene) {
    EXPECT_EQ(sceneIn(pngWith("")), std::nullopt);
    engine::writePng(folder_.file("c.png"), 2, 2, kFourPixels);
    EXPECT_EQ(scene::sceneOfScreenshot(folder_.file("c.png")), std::nullopt);
    EXPECT_EQ(
        folder_.relative(errorText([&] { scene::loadScene(folder_.file("c.png")); })),
        "c.png: is a picture without a scene in it");
}

TEST_F(Screenshot, IsRefusedWhereItIsCutOff) {
    for (const std::string& chunk : {kText, kCompressed, kInternational}) {
        const std::string file = pngWith(chunk);
        for (std::size_t size = 0; size < file.size(); ++size)
            EXPECT_THAT(errorOf(file.substr(0, size)), StartsWith("b.png: byte ")) << size;
    }
}

TEST_F(Screenshot, IsRefusedWhereABitIsWrong) {
    // A checksum finds every single-bit error. An error in a length truncates the file or shifts a
    // checksum.
    const std::string whole = textOf(shot());
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        std::string file = whole;
        file[bit / 8] = static_cast<char>(file[bit / 8] ^ 1 << bit % 8);
        EXPECT_THAT(errorOf(file), StartsWith("b.png: byte ")) << bit;
    }
}

TEST_F(Screenshot, SaysWhatIsWrong) {
    EXPECT_EQ(errorOf("{}"), "b.png: byte 0: is not a PNG");
    EXPECT_EQ(
        errorOf(pngWith("").substr(0, 40)), "b.png: byte 33: the file ends before its last chunk");
    std::string damaged = pngWith(kText);
    damaged[60] ^= 1;
    EXPECT_EQ(errorOf(damaged), "b.png: byte 33: the checksum of the chunk is wrong");
}

TEST_F(Screenshot, GetsANameThatIsFree) {
    const auto name = [&] { return freeName(folder_.path(), "shot", ".png"); };
    EXPECT_EQ(name(), folder_.file("shot-0001.png"));
    folder_.write("shot-0001.png", "");
    folder_.write("shot-0002.png", "");
    EXPECT_EQ(name(), folder_.file("shot-0003.png"));
    // A dangling link would be written through, so its name is not free.
    std::filesystem::create_symlink("nowhere", folder_.file("shot-0003.png"));
    EXPECT_EQ(name(), folder_.file("shot-0004.png"));
    EXPECT_EQ(freeName(folder_.path(), "shot", ""), folder_.file("shot-0001"));
}

}  // namespace
}  // namespace benchmarks::viewer
