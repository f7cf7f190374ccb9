#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/device.h"
#include "tests/required.h"

// One validated device for all GPU tests of a program. The first test creates it. It is destroyed
// before main() returns, because the validation layer's globals are destroyed after that. With
// $HAIRBENCH_GPU_ASSISTED the layer also checks shaders.
class GpuEnvironment : public testing::Environment {
public:
    // Null without a Vulkan device; missing() gives the reason.
    static engine::Device* device() {
        if (!device_ && missing_.empty()) {
            try {
                const bool assisted = std::getenv("HAIRBENCH_GPU_ASSISTED");
                device_ = std::make_unique<engine::Device>(engine::DeviceOptions{
                    .wanted = "",
                    .validation =
                        assisted ? engine::Validation::gpu_assisted : engine::Validation::on});
            } catch (const engine::NoDevice& error) {
                missing_ = error.what();
            }
        }
        return device_.get();
    }

    static const std::string& missing() { return missing_; }

    void TearDown() override { device_.reset(); }

private:
    static inline std::unique_ptr<engine::Device> device_;
    static inline std::string missing_;
};

inline testing::Environment* const gpu_environment =
    testing::AddGlobalTestEnvironment(new GpuEnvironment);

// Skips a test only without a Vulkan device. Fails it on any validation message during the test.
class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (!GpuEnvironment::device()) return skipWithout(Need::device, GpuEnvironment::missing());
        device().messages().take();
    }

    void TearDown() override {
        if (!GpuEnvironment::device()) return;
        for (const std::string& message : device().messages().take()) ADD_FAILURE() << message;
    }

    static engine::Device& device() { return *GpuEnvironment::device(); }
};
