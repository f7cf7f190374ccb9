#include <gtest/gtest.h>

#include "tests/rendering/transparency/layers.h"

namespace hair::rendering {
namespace {

class ListedFragmentsTest : public TransparencyTest {
protected:
    static ListedFragments listed(Settings settings, const std::vector<double>& depths) {
        settings.render.transparency = Transparency::fragment_list;
        const DeviceHair hair(device(), straightStrands(layerLines(depths)), settings);
        Renderer renderer(device(), settings, hair.view(), {});
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        for (int i = 0; i < 2; ++i)
            loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
        loop.finish();
        return renderer.blend().listed().value();
    }
};

// Layers of 60 x 160 px cover 0.26 of the picture. The lists have room for one fragment a pixel:
// six layers need more, one does not.
TEST_F(ListedFragmentsTest, AreCountedThoughThereIsNoRoom) {
    Settings settings = layered(0.5f);
    settings.render.list_length = 1;
    const ListedFragments one = listed(settings, {0.0});
    EXPECT_EQ(one.capacity, kSide * kSide);
    // The tolerance is for the perimeter of 440 px: half of it may be rounded either way.
    EXPECT_NEAR(static_cast<double>(one.wanted), 60.0 * 160, 220);
    EXPECT_EQ(one.dropped(), 0u);

    const ListedFragments six = listed(settings, {0, 0, 0, 0, 0, 0});
    EXPECT_EQ(six.wanted, 6 * one.wanted);
    EXPECT_EQ(six.dropped(), six.wanted - six.capacity);
}

}  // namespace
}  // namespace hair::rendering
