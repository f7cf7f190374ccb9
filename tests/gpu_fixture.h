#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/device.h"
#include "tests/required.h"

// One validated device for all GPU tests of a program, made for the first and gone before main()
// returns: later, the validation layer's own globals are gone. With $HAIRBENCH_GPU_ASSISTED shaders
// are checked, too.
class GpuEnvironment : public testing::Environment {
public:
    // Null where there is no Vulkan device; missing() says why.
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

// A test is skipped only where there is no Vulkan device, and fails on any validation message that
// came while it ran.
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
