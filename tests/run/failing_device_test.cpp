// Tests runs on a device with failing calls.
#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/report/report.h"
#include "benchmarks/run/run.h"
#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "tests/failing_calls.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

using testing::HasSubstr;

constexpr VkResult kNoHostMemory = VK_ERROR_OUT_OF_HOST_MEMORY;
constexpr VkResult kNoMemory = VK_ERROR_OUT_OF_DEVICE_MEMORY;
constexpr VkResult kLost = VK_ERROR_DEVICE_LOST;

// Returns the calls of a run without a window that can fail: Vulkan 1.3.296, "Return Codes" of each
// command.
const std::vector<failing::Call>& calls() {
    using failing::call;
    using failing::maker;
    static const std::vector<failing::Call> all{
        maker<&vkAllocateMemory, &vkFreeMemory>("vkAllocateMemory", {kNoHostMemory, kNoMemory}),
        call<&vkMapMemory>("vkMapMemory", {kNoHostMemory, kNoMemory, VK_ERROR_MEMORY_MAP_FAILED}),
        call<&vkBindBufferMemory>("vkBindBufferMemory", {kNoHostMemory, kNoMemory}),
        call<&vkBindImageMemory>("vkBindImageMemory", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateBuffer, &vkDestroyBuffer>("vkCreateBuffer", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateImage, &vkDestroyImage>("vkCreateImage", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateBufferView, &vkDestroyBufferView>(
            "vkCreateBufferView", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateImageView, &vkDestroyImageView>(
            "vkCreateImageView", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateSampler, &vkDestroySampler>("vkCreateSampler", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateDescriptorPool, &vkDestroyDescriptorPool>(
            "vkCreateDescriptorPool", {kNoHostMemory, kNoMemory, VK_ERROR_FRAGMENTATION}),
        call<&vkAllocateDescriptorSets>(
            "vkAllocateDescriptorSets",
            {kNoHostMemory, kNoMemory, VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY}),
        maker<&vkCreateDescriptorSetLayout, &vkDestroyDescriptorSetLayout>(
            "vkCreateDescriptorSetLayout", {kNoHostMemory, kNoMemory}),
        maker<&vkCreatePipelineLayout, &vkDestroyPipelineLayout>(
            "vkCreatePipelineLayout", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateShaderModule, &vkDestroyShaderModule>(
            "vkCreateShaderModule", {kNoHostMemory, kNoMemory}),
        call<&vkCreateComputePipelines>("vkCreateComputePipelines", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateGraphicsPipelines, &vkDestroyPipeline>(
            "vkCreateGraphicsPipelines", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateCommandPool, &vkDestroyCommandPool>(
            "vkCreateCommandPool", {kNoHostMemory, kNoMemory}),
        call<&vkAllocateCommandBuffers>("vkAllocateCommandBuffers", {kNoHostMemory, kNoMemory}),
        call<&vkBeginCommandBuffer>("vkBeginCommandBuffer", {kNoHostMemory, kNoMemory}),
        call<&vkEndCommandBuffer>("vkEndCommandBuffer", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateSemaphore, &vkDestroySemaphore>(
            "vkCreateSemaphore", {kNoHostMemory, kNoMemory}),
        maker<&vkCreateQueryPool, &vkDestroyQueryPool>(
            "vkCreateQueryPool", {kNoHostMemory, kNoMemory}),
        call<&vkGetQueryPoolResults>("vkGetQueryPoolResults", {kNoHostMemory, kNoMemory, kLost}),
        call<&vkQueueSubmit2>("vkQueueSubmit2", {kNoHostMemory, kNoMemory, kLost}),
        call<&vkResetFences>("vkResetFences", {kNoMemory}),
        call<&vkWaitForFences>("vkWaitForFences", {kNoHostMemory, kNoMemory, kLost, VK_TIMEOUT}),
        call<&vkWaitSemaphores>("vkWaitSemaphores", {kNoHostMemory, kNoMemory, kLost, VK_TIMEOUT})};
    return all;
}

// Waits are repeated.
bool isTriedAgain(const std::string& call, VkResult result) {
    return call.starts_with("vkWait") && result != kLost;
}

// VulkanMemoryAllocator tries other memory.
bool mayBeDoneWithout(const std::string& call) {
    return call == "vkAllocateMemory" || call == "vkMapMemory";
}

// Without HAIRBENCH_FAILURES=all one kind of memory stands for both, and the first call of a
// function for all its calls.
bool isTried(const failing::Call& call, VkResult result, std::size_t after) {
    const char* const wanted = std::getenv("HAIRBENCH_FAILURES");
    if (wanted && std::string_view(wanted) == "all") return true;
    return after == 0 && (result == call.results.front() || result != kNoMemory);
}

// Two small cases on a device whose calls can be made to fail.
class FailingDevice : public testing::Test {
protected:
    void SetUp() override {
        scene_ = folder_.write("tiny.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "groom": {"guides": 40},
            "strands": {"tessellation": 1, "backend": "software"},
            "render": {"width": 48, "height": 48},
            "run": {"warmup": 2, "frames": 2, "max_time": 0},
            "sweep": {"/render/msaa": null,
                      "/strands/density": [1, 2]}})");
        options_.scene.scene = scene_;
        options_.order_seed = 1;
        options_.pictures = false;
        plan_ = planRun(options_.scene, "", "");
        ASSERT_EQ(plan_.cases.size(), 2u);
    }

    struct Played {
        scene::Json report;
        FinishedRun finished;
        std::map<std::string, std::size_t> calls;
        std::map<std::string, long> left;  // objects after the last device was destroyed
        std::size_t failures = 0;
    };

    // Runs the cases; some calls of the first device fail.
    Played play(const failing::Plan& failure, engine::DeviceOptions device_options = {}) {
        // Descriptor pools and sets are used without push descriptors.
        device_options.mask = [mask = device_options.mask](engine::DeviceInfo& info) {
            info.features.erase(engine::Feature::push_descriptors);
            if (mask) mask(info);
        };
        RunDevice device(device_options);
        static_cast<void>(device.get());
        for (const failing::Call& each : calls()) each.install();
        failing::plan = failure;
        failing::failures = 0;
        const std::filesystem::path out =
            folder_.file("report" + std::to_string(runs_++) + ".json");
        measure::HairCache cache = measure::userHairCache(false);
        Played played{
            .report = {},
            .finished = playRun(device, options_, plan_, out, cache, [](const FinishedRun&) {}),
            .calls = {},
            .left = {}};
        device.drop();
        failing::plan = {};
        played.failures = failing::failures;
        for (const failing::Call& each : calls()) {
            played.calls[each.name] = *each.calls;
            if (each.alive) played.left[each.name] = *each.alive;
        }
        // One function destroys both kinds of pipelines.
        played.left["vkCreateGraphicsPipelines"] += failing::Made<&vkCreateComputePipelines>::alive;
        played.report = report::readReport(out);
        return played;
    }

    static std::size_t failedCases(const scene::Json& report) {
        std::size_t count = 0;
        for (const scene::Json& each : report["cases"]) count += each["status"] == "failed";
        return count;
    }

    TemporaryFolder folder_;
    std::filesystem::path scene_;
    RunOptions options_;
    RunPlan plan_;
    int runs_ = 0;
};

TEST_F(FailingDevice, FailsOneCaseAndPlaysTheOther) {
    std::optional<Played> whole;
    try {
        whole = play({});
    } catch (const engine::NoDevice& error) {
        return skipWithout(Need::device, error.what());
    }
    ASSERT_EQ(failedCases(whole->report), 0u) << whole->report["cases"].dump(1);
    for (const failing::Call& each : calls()) {
        const std::size_t made = whole->calls[each.name];
        EXPECT_GT(made, 0u) << each.name << " is not called: it can't be seen to fail";
        for (const VkResult result : each.results)
            // The first call sets something up; one in the middle finds frames in flight.
            for (const std::size_t after : {std::size_t{0}, made / 2}) {
                if (!isTried(each, result, after)) continue;
                SCOPED_TRACE(
                    each.name + " number " + std::to_string(after) + ": " +
                    engine::resultName(result));
                const Played played =
                    play({.call = each.name, .result = result, .after = after, .times = 1});
                EXPECT_EQ(played.failures, 1u);
                EXPECT_FALSE(played.finished.interrupted);
                ASSERT_EQ(played.report["cases"].size(), 2u);
                const std::size_t failed = failedCases(played.report);
                if (!mayBeDoneWithout(each.name) || failed > 0) {
                    EXPECT_EQ(failed, isTriedAgain(each.name, result) ? 0u : 1u);
                }
                for (std::size_t i = 0; i < 2; ++i) {
                    const scene::Json& one = played.report["cases"][i];
                    if (one["status"] == "ok") {
                        EXPECT_EQ(one["image_hash"], whole->report["cases"][i]["image_hash"]);
                        continue;
                    }
                    EXPECT_THAT(
                        one["reason"].get<std::string>(), HasSubstr(engine::resultName(result)));
                }
                EXPECT_EQ(played.left, whole->left);
            }
    }
}

// Submits, and counts the submissions whose fence is signalled before they begin.
PFN_vkQueueSubmit2 real_submit = nullptr;
VkDevice submitting_device{};
int signalled_before = 0;

VKAPI_ATTR VkResult VKAPI_CALL submitAndLookAtTheFence(
    VkQueue queue, std::uint32_t count, const VkSubmitInfo2* submissions, VkFence fence) {
    if (fence && vkGetFenceStatus(submitting_device, fence) == VK_SUCCESS) ++signalled_before;
    return real_submit(queue, count, submissions, fence);
}

// A wait for a fence that is still signalled ends at once, and what the device still uses is freed.
TEST_F(FailingDevice, WaitsAfterAFenceWasNotReset) {
    std::optional<engine::Device> device;
    try {
        device.emplace(engine::DeviceOptions{});
    } catch (const engine::NoDevice& error) {
        return skipWithout(Need::device, error.what());
    }
    const std::vector<std::uint32_t> values{3, 1, 4, 1, 5};
    const auto there_and_back = [&] {
        const engine::Buffer buffer = engine::makeBuffer(*device, values, "values", "tests");
        return engine::downloadAs<std::uint32_t>(*device, buffer);
    };
    EXPECT_EQ(there_and_back(), values);
    const failing::Call reset = failing::call<&vkResetFences>("vkResetFences", {kNoMemory});
    reset.install();
    submitting_device = device->get();
    signalled_before = 0;
    real_submit = std::exchange(vkQueueSubmit2, &submitAndLookAtTheFence);
    failing::failures = 0;
    failing::plan = {.call = "vkResetFences", .result = kNoMemory, .after = 0, .times = 1};
    EXPECT_THROW(there_and_back(), engine::Error);
    EXPECT_EQ(there_and_back(), values);
    failing::plan = {};
    vkQueueSubmit2 = real_submit;
    EXPECT_EQ(failing::failures, 1u);
    EXPECT_GE(*reset.calls, 3u);
    EXPECT_EQ(signalled_before, 0);
}

TEST_F(FailingDevice, GivesUpADeviceThatNeverAnswers) {
#if defined(__SANITIZE_ADDRESS__)
    const __lsan::ScopedDisabler what_a_device_that_may_still_write_holds_is_left_to_it;
#endif
    for (const char* const call : {"vkWaitForFences", "vkWaitSemaphores"}) {
        SCOPED_TRACE(call);
        const auto start = std::chrono::steady_clock::now();
        std::optional<Played> played;
        try {
            played = play(
                {.call = call, .result = VK_TIMEOUT, .after = 3, .times = 1'000'000'000},
                {.patience = std::chrono::milliseconds(300)});
        } catch (const engine::NoDevice& error) {
            return skipWithout(Need::device, error.what());
        }
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
        ASSERT_EQ(failedCases(played->report), 1u);
        for (const scene::Json& one : played->report["cases"]) {
            if (one["status"] != "failed") continue;
            EXPECT_THAT(
                one["reason"].get<std::string>(), HasSubstr("the device did not answer for 0.3 s"));
        }
    }
}

TEST_F(FailingDevice, EndsTheRunWhereThereIsNoOther) {
    int made = 0;
    const auto once = [&](engine::DeviceInfo&) {
        if (made++ > 0) throw engine::Error("planted");
    };
    std::optional<Played> played;
    try {
        played = play(
            {.call = "vkQueueSubmit2", .result = kLost, .after = 5, .times = 1}, {.mask = once});
    } catch (const engine::NoDevice& error) {
        return skipWithout(Need::device, error.what());
    }
    EXPECT_EQ(played->finished.no_device, "no other device: planted");
    EXPECT_FALSE(played->finished.interrupted);
    EXPECT_EQ(played->report["interrupted"], true);
    ASSERT_EQ(played->report["cases"].size(), 1u);
    EXPECT_EQ(played->report["cases"][0]["status"], "failed");
}

TEST_F(FailingDevice, FailsACaseWhoseTimeIsOver) {
    options_.scene.sets = {
        "/run/frames=1000000", "/run/case_timeout=0.5", "/render/width=16", "/render/height=16"};
    plan_ = planRun(options_.scene, "", "");
    std::optional<Played> played;
    try {
        played = play({});
    } catch (const engine::NoDevice& error) {
        return skipWithout(Need::device, error.what());
    }
    ASSERT_EQ(failedCases(played->report), 2u);
    for (const scene::Json& one : played->report["cases"])
        EXPECT_EQ(one["reason"], "not finished after 0.5 s (/run/case_timeout)");
    EXPECT_FALSE(played->finished.interrupted);
}

}  // namespace
}  // namespace benchmarks::run
