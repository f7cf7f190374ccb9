#include "engine/device.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include "engine/commands.h"
#include "engine/buffer_image.h"
#include "engine/pipeline.h"
#include "engine/shaders.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"

namespace engine {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

template <class Exception, class Call>
std::string messageOf(Call&& call) {
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    return "nothing was thrown";
}

using DeviceTest = GpuTest;

TEST_F(DeviceTest, IsFoundByIndexAndByPartOfItsName) {
    const Instance instance(Validation::off);
    const std::vector<DeviceInfo> devices = listDevices(instance);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!devices[i].missing.empty()) continue;
        EXPECT_EQ(chooseDevice(instance, std::to_string(i)).name, devices[i].name);
        EXPECT_EQ(chooseDevice(instance, devices[i].name.substr(0, 4)).missing.size(), 0u);
    }
}

TEST_F(DeviceTest, ThatDoesNotExistIsNamedWithThoseThatDo) {
    const Instance instance(Validation::off);
    const std::string message =
        messageOf<NoDevice>([&] { chooseDevice(instance, "no such device"); });
    EXPECT_THAT(message, HasSubstr("no device is named 'no such device'"));
    EXPECT_THAT(message, HasSubstr(device().info().name));
}

TEST_F(DeviceTest, RefusesASampleCountThatItLacks) {
    if (device().supportsSamples(64)) GTEST_SKIP() << "this device has 64 samples";
    EXPECT_THAT(
        messageOf<Unsupported>(
            [&] { Target(device(), {.width = 4, .height = 4, .msaa = 64, .ssaa = 1}); }),
        HasSubstr("no 64-sample images"));
}

// Lavapipe of Mesa 23 and later keeps its memory in one file and would end the process by SIGBUS.
TEST_F(DeviceTest, TreatsALimitOnTheSizeOfFilesAsOneOnMemoryInFiles) {
    const bool is_in_file = device().info().driver_id == VK_DRIVER_ID_MESA_LLVMPIPE &&
                            !device().info().driver_version.starts_with("Mesa 22");
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto limited = [&](rlim_t mebibytes, const auto& action) {
        const rlimit limit{.rlim_cur = mebibytes << 20, .rlim_max = before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
        action();
        setrlimit(RLIMIT_FSIZE, &before);
    };
    std::string error;
    limited(255, [&] { error = errorText([] { const Device refused({.wanted = ""}); }); });
    EXPECT_THAT(
        error, is_in_file ? HasSubstr("files may have at most 261120 KiB here: raise the limit")
                          : HasSubstr("no error"));
    limited(256, [&] {
        const Device small({.wanted = ""});
        EXPECT_TRUE(!is_in_file || small.freeBytes() <= 128u << 20) << small.freeBytes();
        // Exceeds the limit: refused, or allowed if the driver's memory is in no file.
        error = errorText([&] {
            const Buffer large(
                small, {.size = 300u << 20,
                        .usage = Usage::readback,
                        .name = "large",
                        .purpose = "tests"});
            std::ranges::fill(large.mapped(), std::byte{1});
        });
    });
    EXPECT_EQ(error == "no error", !is_in_file) << error;
}

TEST_F(DeviceTest, RefusesAPictureThatIsTooLarge) {
    EXPECT_THAT(
        messageOf<Unsupported>(
            [&] { Target(device(), {.width = 1u << 20, .height = 4, .msaa = 1, .ssaa = 1}); }),
        HasSubstr("an image side of 1048576 px exceeds the device's"));
}

// strands/frames.comp reads guides and their first frames and writes normals. Here all three are at
// the same address, inside or past the end of the only buffer. The layer's messages about that
// differ between versions.
TEST_F(DeviceTest, ChecksAddressesInShadersWhereThatIsAskedFor) {
    struct Push {
        std::array<float, 16> head{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        std::array<VkDeviceAddress, 3> addresses;
        std::array<std::uint32_t, 2> counts{1, 2};  // guides, vertices of each
    };
    const Device checked({.wanted = "", .validation = Validation::gpu_assisted});
    checked.messages().take();  // newer layers report what they enable
    const ComputePipeline frames(
        checked, {.shader = "strands/frames.comp", .push_size = sizeof(Push)});
    const std::vector<float> zeros(64, 0.0f);
    const Buffer memory = makeBuffer(checked, zeros, "frames", "tests");
    const auto messagesOf = [&](VkDeviceAddress at) {
        runOnce(checked, [&](Commands& commands) {
            commands.bind(frames, Push{.addresses = {at, at, at}});
            commands.uses({{memory, Access::compute_write}});
            commands.dispatch(1);
        });
        return checked.messages().take();
    };
    EXPECT_THAT(messagesOf(memory.address()), IsEmpty());
    EXPECT_THAT(messagesOf(memory.address() + 4 * zeros.size()), Not(IsEmpty()));
}

TEST_F(DeviceTest, ListsTheShadersWhenOneIsUnknown) {
    EXPECT_THAT(
        messageOf<Error>([] { shaderCode("strands/none.vert"); }),
        HasSubstr("strands/tessellation.vert"));
}

}  // namespace
}  // namespace engine
