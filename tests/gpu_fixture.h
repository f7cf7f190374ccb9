#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/device.h"

// One validated device for all GPU tests of a program. A test is skipped only where there is no Vulkan
// device, and fails on any validation message that came while it ran.
class GpuTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        if (device_ || !missing_.empty()) return;
        try {
            device_ = std::make_unique<engine::Device>(
                engine::DeviceOptions{.wanted = "", .validation = engine::Validation::on});
        } catch (const engine::NoDevice& error) {
            missing_ = error.what();
        }
    }

    void SetUp() override {
        if (!device_) GTEST_SKIP() << missing_;
        device_->messages().take();
    }

    void TearDown() override {
        if (!device_) return;
        for (const std::string& message : device_->messages().take()) ADD_FAILURE() << message;
    }

    static engine::Device& device() { return *device_; }

private:
    static inline std::unique_ptr<engine::Device> device_;
    static inline std::string missing_;
};
