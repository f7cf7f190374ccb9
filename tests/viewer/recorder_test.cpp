#include "benchmarks/viewer/scene_file.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include <gmock/gmock.h>

#include "engine/pictures.h"
#include "engine/png_text.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::HasSubstr;

class RecorderTest : public GpuTest {
protected:
    // A small picture with moving hair.
    static hair::Settings settings() {
        hair::Settings settings;
        settings.groom.guides = 10;
        settings.strands.density = 4;
        settings.render.width = 48;
        settings.render.height = 32;
        settings.simulation.wind.strength = 0.5f;
        return settings;
    }

    static Player player() { return Player(device(), settings(), HAIRBENCH_SCENES_DIR); }

    TemporaryFolder folder_;
};

// ---- A reader of animated PNGs of its own: the specification's sections 5.3 and 11.3.6 ----------

std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t length = 4) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < length; ++i)
        number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

struct PlayedFrame {
    std::vector<std::uint8_t> rgba;  // the whole picture
    std::uint32_t pixels = 0;  // that the file has of it
    double seconds = 0.0;
};

// Returns the frames as a browser shows them. Decodes each part as a PNG of its own.
std::vector<PlayedFrame> framesOf(const std::string& file, std::uint32_t width) {
    struct Chunk {
        std::string_view type, data;
    };
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < file.size();) {
        const std::size_t length = numberAt(file, at);
        chunks.push_back(
            {std::string_view(file).substr(at + 4, 4),
             std::string_view(file).substr(at + 8, length)});
        at += length + 12;
    }
    EXPECT_EQ(chunks.front().type, "IHDR");
    EXPECT_EQ(chunks.back().type, "IEND");
    std::vector<PlayedFrame> frames;
    std::vector<std::uint8_t> canvas;
    std::uint32_t sequence = 0, counted = 0;
    std::string_view control;
    for (const Chunk& chunk : chunks) {
        if (chunk.type == "acTL") counted = numberAt(chunk.data, 0);
        if (chunk.type == "fcTL") {
            EXPECT_EQ(numberAt(chunk.data, 0), sequence++);
            control = chunk.data;
        }
        if (chunk.type != "IDAT" && chunk.type != "fdAT") continue;
        std::string_view data = chunk.data;
        if (chunk.type == "fdAT") {
            EXPECT_EQ(numberAt(data, 0), sequence++);
            data.remove_prefix(4);
        }
        std::string header(chunks.front().data);
        header.replace(0, 8, control.substr(4, 8));
        const engine::Pixels part = engine::decodeImage(
            file.substr(0, 8) + engine::pngChunk("IHDR", header) + engine::pngChunk("IDAT", data) +
            engine::pngChunk("IEND", {}));
        canvas.resize(std::max(canvas.size(), part.rgba.size()));
        const std::uint32_t left = numberAt(control, 12), top = numberAt(control, 16);
        for (std::uint32_t y = 0; y < part.height; ++y)
            std::copy_n(
                &part.rgba[std::size_t{4} * y * part.width], std::size_t{4} * part.width,
                &canvas[std::size_t{4} * ((y + top) * width + left)]);
        frames.push_back(
            {canvas, part.width * part.height,
             static_cast<double>(numberAt(control, 20, 2)) / numberAt(control, 22, 2)});
    }
    EXPECT_EQ(counted, frames.size());
    return frames;
}

TEST_F(RecorderTest, WritesEachShownFrameOnce) {
    Player shown = player();
    Recorder recorder;
    recorder.frame(shown.shown());
    EXPECT_FALSE(recorder.records());
    EXPECT_EQ(recorder.message(), "");
    const auto place = folder_.file("new/take.png");
    recorder.start(place);
    EXPECT_EQ(recorder.message(), "recording 0 frames to " + place.string() + ", 0 bytes");
    std::vector<std::vector<std::uint8_t>> expected;
    for (int i = 0; i < 3; ++i) {
        expected.push_back(shown.played().picture());
        recorder.frame(shown.shown());
        recorder.frame(shown.shown());  // the window is drawn more often than the hair
        // The file plays after every frame, even if the program ends there.
        const std::vector<PlayedFrame> frames = framesOf(textOf(place), 48);
        ASSERT_EQ(frames.size(), expected.size());
        for (std::size_t k = 0; k < frames.size(); ++k) {
            EXPECT_EQ(frames[k].rgba, expected[k]) << k;
            EXPECT_NEAR(frames[k].seconds, 1.0 / 60.0, 1e-6);  // /run/frame_time, a float
            // Only hair moves, and it does not fill the picture.
            if (k > 0) {
                EXPECT_LT(frames[k].pixels, 48u * 32u) << k;
            }
        }
        shown.next();
    }
    EXPECT_THAT(recorder.summary(), HasSubstr("recorded 3 frames to " + place.string()));
    recorder.stop();
    EXPECT_FALSE(recorder.records());
    recorder.frame(shown.shown());
    EXPECT_EQ(framesOf(textOf(place), 48).size(), 3u);
    // Other programs show the first frame, and the viewer opens the scene.
    EXPECT_EQ(engine::readImage(place).rgba, expected.front());
    EXPECT_EQ(openScene(place).settings.groom.guides, settings().groom.guides);
}

TEST_F(RecorderTest, KeepsAFrameThatEqualsTheLast) {
    engine::AnimatedPng film(folder_.file("still.png"), 3, 2);
    std::vector<std::uint8_t> picture(24);
    std::iota(picture.begin(), picture.end(), std::uint8_t{40});
    film.add(picture, 0.25);
    film.add(picture, 0.1);
    std::vector<std::uint8_t> other = picture;
    other[23] = 7;
    film.add(other, 3600.0);  // the longest that the format has is 65.535 s
    const auto frames = framesOf(textOf(folder_.file("still.png")), 3);
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[1].rgba, picture);
    EXPECT_EQ(frames[1].pixels, 1u);
    EXPECT_EQ(frames[2].rgba, other);
    EXPECT_EQ(frames[2].pixels, 1u);
    EXPECT_EQ(frames[0].seconds, 0.25);
    EXPECT_EQ(frames[1].seconds, 0.1);
    EXPECT_EQ(frames[2].seconds, 65.535);
}

TEST_F(RecorderTest, EndsWhereThePicturesSizeChanges) {
    Player shown = player();
    Recorder recorder;
    recorder.start(folder_.file("take.png"));
    recorder.frame(shown.shown());
    hair::Settings wider = settings();
    wider.render.width = 64;
    shown.apply(wider);
    shown.next();
    EXPECT_THAT(
        errorText([&] { recorder.frame(shown.shown()); }), HasSubstr("the picture's size changed"));
    EXPECT_FALSE(recorder.records());
    EXPECT_EQ(framesOf(textOf(folder_.file("take.png")), 48).size(), 1u);
}

TEST_F(RecorderTest, SaysWhereNoFolderCanBeMade) {
    folder_.write("file", "");
    Recorder recorder;
    EXPECT_THAT(
        errorText([&] { recorder.start(folder_.file("file/take.png")); }),
        HasSubstr(folder_.file("file").string()));
    EXPECT_FALSE(recorder.records());
}

TEST_F(RecorderTest, StopsWhereAPictureCannotBeWritten) {
    Player shown = player();
    Recorder recorder;
    recorder.start(folder_.file("take/film.png"));
    std::filesystem::remove_all(folder_.file("take"));
    EXPECT_THAT(
        errorText([&] { recorder.frame(shown.shown()); }),
        HasSubstr(folder_.file("take/film.png").string()));
    EXPECT_FALSE(recorder.records());
    recorder.frame(shown.shown());
}

}  // namespace
}  // namespace benchmarks::viewer
