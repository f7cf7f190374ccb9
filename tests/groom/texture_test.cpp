#include "hair/groom/growth/root_density.h"

#include <gmock/gmock.h>

#include "engine/pictures.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

// Pixel (column, row) has its centre at ((column + 1/2) / width, (row + 1/2) / height).
TEST(Texture, IsLinearBetweenPixelCentres) {
    const Texture texture(2, 2, {0.0f, 1.0f, 0.5f, 0.25f});
    EXPECT_DOUBLE_EQ(texture({0.25, 0.25}), 0.0);
    EXPECT_DOUBLE_EQ(texture({0.75, 0.25}), 1.0);
    EXPECT_DOUBLE_EQ(texture({0.25, 0.75}), 0.5);
    EXPECT_DOUBLE_EQ(texture({0.75, 0.75}), 0.25);
    EXPECT_DOUBLE_EQ(texture({0.5, 0.25}), 0.5);
    EXPECT_DOUBLE_EQ(texture({0.5, 0.5}), 0.4375);  // the mean of the four
    EXPECT_DOUBLE_EQ(texture({0.375, 0.75}), 0.4375);  // a quarter of the way
}

TEST(Texture, GoesOnAsItsEdge) {
    const Texture texture(2, 1, {0.25f, 0.75f});
    for (const double v : {-3.0, 0.0, 0.5, 1.0, 7.0}) {
        EXPECT_DOUBLE_EQ(texture({-5.0, v}), 0.25);
        EXPECT_DOUBLE_EQ(texture({0.1, v}), 0.25);
        EXPECT_DOUBLE_EQ(texture({2.0, v}), 0.75);
    }
    EXPECT_DOUBLE_EQ(Texture(1, 1, {0.5f})({0.3, 0.9}), 0.5);
}

// Rec. 709: luma = 0.2126 R + 0.7152 G + 0.0722 B.
TEST(Texture, IsTheLumaOfAFile) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels{255, 0, 0,   255, 0,   255, 0,   0,
                                           0,   0, 255, 255, 255, 255, 255, 255};
    engine::writePng(folder.file("a.png"), 4, 1, pixels);
    const Texture texture = readTexture(folder.file("a.png"));
    // Stored as float, 6e-8 below 1.
    EXPECT_NEAR(texture({0.125, 0.5}), 0.2126, 1e-7);
    EXPECT_NEAR(texture({0.375, 0.5}), 0.7152, 1e-7);
    EXPECT_NEAR(texture({0.625, 0.5}), 0.0722, 1e-7);
    EXPECT_NEAR(texture({0.875, 0.5}), 1.0, 1e-7);
}

TEST(Texture, NamesTheFileThatIsMissing) {
    EXPECT_EQ(errorText([] { readTexture("no/mask.png"); }), "no/mask.png: no such file");
}

}  // namespace
}  // namespace hair::groom
