#include "engine/buffer_image.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/commands.h"
#include "engine/transfer.h"
#include "tests/gpu_fixture.h"

namespace engine {
namespace {

using TransferTest = GpuTest;

TEST_F(TransferTest, BringsBackWhatItTookThere) {
    std::vector<std::uint32_t> values(100'000);
    std::iota(values.begin(), values.end(), 7u);
    const Buffer buffer = makeBuffer(device(), values, "values", "tests");
    EXPECT_NE(buffer.address(), 0u);
    EXPECT_EQ(downloadAs<std::uint32_t>(device(), buffer), values);
}

TEST_F(TransferTest, GivesAnEmptyArrayAnAddress) {
    const Buffer buffer = makeBuffer(device(), std::vector<std::uint32_t>(), "nothing", "tests");
    EXPECT_NE(buffer.address(), 0u);
    EXPECT_EQ(buffer.size(), sizeof(std::uint32_t));
}

TEST_F(TransferTest, FillsABuffer) {
    const Buffer buffer(
        device(), {.size = 64, .usage = Usage::storage, .name = "filled", .purpose = "tests"});
    runOnce(device(), [&](Commands& commands) { commands.fill(buffer, 0xABCD1234u); });
    EXPECT_EQ(
        downloadAs<std::uint32_t>(device(), buffer), std::vector<std::uint32_t>(16, 0xABCD1234u));
}

TEST_F(TransferTest, CountsTheMemoryThatBuffersHold) {
    const std::uint64_t before = device().allocatedBytes();
    {
        const Buffer buffer(
            device(),
            {.size = 1 << 20, .usage = Usage::storage, .name = "MiB", .purpose = "tests"});
        EXPECT_GE(device().allocatedBytes(), before + (1 << 20));
    }
    EXPECT_EQ(device().allocatedBytes(), before);
}

TEST_F(TransferTest, SaysWhichBufferTheDeviceHasNoRoomFor) {
    try {
        const Buffer buffer(
            device(), {.size = std::size_t{1} << 50, .name = "a petabyte", .purpose = "tests"});
        FAIL() << "a petabyte was allocated";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("buffer 'a petabyte' of 1125899906842624 B"));
    }
    device().messages().take();  // the validation layer also reports the size
}

}  // namespace
}  // namespace engine
