#include "benchmarks/report/environment.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <gmock/gmock.h>

#include "tests/gpu_fixture.h"

namespace benchmarks::measure {
namespace {

#ifdef __clang__
const std::string kCompilerVersion = std::to_string(__clang_major__) + ".";
#else
const std::string kCompilerVersion = std::to_string(__GNUC__) + ".";
#endif

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

class EnvironmentTest : public GpuTest {
protected:
    static report::Environment describe(engine::Validation validation) {
        return report::describeEnvironment(device(), {"hairbench", "run"}, 7, validation);
    }
};

TEST_F(EnvironmentTest, HasTheDevicesIdentity) {
    const report::DeviceRecord record = describe(engine::Validation::off).device;
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device().info().handle, &properties);
    unsigned vendor = 0, product = 0;
    ASSERT_EQ(std::sscanf(record.id.c_str(), "%x:%x", &vendor, &product), 2);
    EXPECT_EQ(vendor, properties.vendorID);
    EXPECT_EQ(product, properties.deviceID);
    EXPECT_THAT(record.id, MatchesRegex("[0-9a-f]+:[0-9a-f]+"));
    EXPECT_EQ(record.timestamp_valid_bits, device().info().timestamp_valid_bits);
}

// The specification's minimum values (Vulkan 1.3, Required Limits), for a device with tessellation
// and geometry shaders, which every device here has.
TEST_F(EnvironmentTest, HasLimitsThatMeetTheSpecification) {
    const auto limits = describe(engine::Validation::off).device.limits;
    const auto limit = [&](const std::string& name) {
        const auto found = std::ranges::find(limits, name, &std::pair<std::string, double>::first);
        return found == limits.end() ? -1.0 : found->second;
    };
    EXPECT_GE(limit("maxTessellationGenerationLevel"), 64.0);
    EXPECT_GE(limit("maxTessellationPatchSize"), 32.0);
    EXPECT_GE(limit("maxGeometryOutputVertices"), 256.0);
    EXPECT_GE(limit("maxComputeWorkGroupInvocations"), 128.0);
    EXPECT_GE(limit("maxComputeSharedMemorySize"), 16384.0);
    EXPECT_GE(limit("maxPushConstantsSize"), 128.0);
    EXPECT_GE(limit("maxStorageBufferRange"), 134217728.0);
    EXPECT_GE(limit("maxImageDimension2D"), 4096.0);
    EXPECT_GE(limit("maxMemoryAllocationCount"), 4096.0);
    EXPECT_EQ(static_cast<unsigned>(limit("framebufferColorSampleCounts")) & 5u, 5u);  // 1 and 4
}

// lavapipe's tessellator has 16-bit indices; other drivers have no limit of this kind.
TEST_F(EnvironmentTest, SaysHowManyVerticesATessellatedDrawMayMake) {
    const auto limits = describe(engine::Validation::off).device.limits;
    const std::pair<std::string, double> lavapipe{"maxTessellatedVertices", 65536.0};
    const bool is_lavapipe = device().info().driver_id == VK_DRIVER_ID_MESA_LLVMPIPE;
    EXPECT_EQ(std::ranges::find(limits, lavapipe) != limits.end(), is_lavapipe);
}

TEST_F(EnvironmentTest, SaysWhetherValidationIsOn) {
    EXPECT_EQ(describe(engine::Validation::off).validation, false);
    EXPECT_EQ(describe(engine::Validation::on).validation, true);
}

TEST_F(EnvironmentTest, EchoesTheCommandAndTheSeed) {
    const report::Environment environment = describe(engine::Validation::off);
    EXPECT_THAT(environment.command, ElementsAre("hairbench", "run"));
    EXPECT_EQ(environment.seed, 7u);
    EXPECT_THAT(environment.started, MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z"));
}

TEST(BuildRecord, SaysHowTheProgramWasBuilt) {
    const report::BuildRecord build = report::describeBuild();
    EXPECT_EQ(build.version, HAIRBENCH_VERSION);
    EXPECT_THAT(build.compiler, HasSubstr(kCompilerVersion));
    EXPECT_EQ(build.flags.find("  "), std::string::npos);
#ifdef NDEBUG
    EXPECT_THAT(build.flags, HasSubstr("-DNDEBUG"));
#endif
    // The suffix and the flag agree.
    if (!build.commit.empty())
        EXPECT_EQ(build.dirty, build.commit.ends_with("-dirty"));
    else
        EXPECT_EQ(build.dirty, std::nullopt);
}

}  // namespace
}  // namespace benchmarks::measure
