#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <imgui.h>

#include "engine/presenter.h"
#include "engine/ui.h"
#include "tests/failing_calls.h"
#include "tests/required.h"
#include "tests/viewer/virtual_display.h"

namespace engine {
namespace {

// A window on its own display, and a device that can present to it.
class WindowTest : public testing::Test {
protected:
    void SetUp() override {
        if (!display_.name().empty()) {
            setenv("DISPLAY", display_.name().c_str(), 1);
            unsetenv("WAYLAND_DISPLAY");
        }
        try {
            window_.emplace(WindowDescription{.title = "test", .width = 640, .height = 360});
        } catch (const NoDisplay& error) {
            skipWithout(Need::display, error.what());
        }
    }

    void TearDown() override { expectNoMessage(); }

    Device& make(const std::function<void(DeviceInfo&)>& mask = {}) {
        expectNoMessage();
        device_.reset();
        return device_.emplace(DeviceOptions{
            .wanted = "",
            .validation = Validation::on,
            .window_extensions = Window::instanceExtensions(),
            .mask = mask});
    }

    Window& window() { return *window_; }

private:
    void expectNoMessage() {
        if (!device_) return;
        for (const std::string& message : device_->messages().take()) ADD_FAILURE() << message;
    }

    VirtualDisplay display_;
    std::optional<Window> window_;
    std::optional<Device> device_;
};

TEST_F(WindowTest, ShowsWidgets) {
    const Device& device = make();
    Presenter presenter(device, window());
    Ui ui(device, window(), 1.0f);
    for (int i = 0; i < 6; ++i) {
        window().poll();
        if (i == 3) window().resize(800, 450);
        ui.begin();
        ImGui::SetNextWindowPos({10, 10});
        ImGui::Begin("hair");
        ImGui::Text("Strands: 8,704  \xc2\xb5m \xe2\x89\xa4");
        ImGui::End();
        ui.end();
        EXPECT_TRUE(presenter.frame([](Commands&) {}, [&](Commands& c) { ui.draw(c); }));
    }
    const Presenter::Picture picture = presenter.picture();
    EXPECT_EQ(picture.width, 800u);
    EXPECT_EQ(picture.height, 450u);
    EXPECT_GT(presenter.milliseconds(), 0.0);
}

// The next frame appears on a new surface of the window.
TEST_F(WindowTest, GoesOnWhereTheSurfaceIsLost) {
    const std::vector<failing::Call> calls{
        failing::call<&vkAcquireNextImageKHR>("vkAcquireNextImageKHR", {}),
        failing::call<&vkQueuePresentKHR>("vkQueuePresentKHR", {}),
        failing::maker<&vkCreateSwapchainKHR, &vkDestroySwapchainKHR>("vkCreateSwapchainKHR", {})};
    for (const failing::Call& call : calls)
        for (const std::size_t after : {std::size_t{0}, std::size_t{2}}) {
            const bool resized = call.name == "vkCreateSwapchainKHR";
            SCOPED_TRACE(call.name + " number " + std::to_string(after));
            const Device& device = make();
            call.install();
            failing::plan = {
                .call = call.name,
                .result = VK_ERROR_SURFACE_LOST_KHR,
                .after = resized ? 0 : after};
            failing::failures = 0;
            {
                Presenter presenter(device, window());
                for (int i = 0; i < 6; ++i) {
                    window().poll();
                    EXPECT_TRUE(presenter.frame([](Commands&) {}, [](Commands&) {}));
                }
                EXPECT_EQ(failing::failures, 1u);
                EXPECT_EQ(presenter.picture().width, 640u);
            }
            if (call.alive) {
                EXPECT_EQ(*call.alive, 0);
            }
        }
    failing::plan = {};
}

// A surface that is lost repeatedly is an error, and nothing leaks.
TEST_F(WindowTest, SaysThatTheSurfaceIsLost) {
    const Device& device = make();
    const auto acquire = failing::call<&vkAcquireNextImageKHR>("vkAcquireNextImageKHR", {});
    acquire.install();
    failing::plan = {
        .call = acquire.name, .result = VK_ERROR_SURFACE_LOST_KHR, .after = 0, .times = 1000};
    Presenter presenter(device, window());
    failing::failures = 0;
    EXPECT_THROW(presenter.frame([](Commands&) {}, [](Commands&) {}), SurfaceLost);
    EXPECT_EQ(failing::failures, 2u);
    failing::plan = {};
    EXPECT_TRUE(presenter.frame([](Commands&) {}, [](Commands&) {}));
}

// Resources of a present live until it is over, and no longer: with present fences, and without
// them even if the device has them. The validation layer reports anything destroyed or used too
// early.
TEST_F(WindowTest, DropsSwapchainsOnceTheirPresentsAreOver) {
    for (const bool fences : {true, false}) {
        const Device& device = make([&](DeviceInfo& info) {
            if (!fences) info.features.erase(Feature::present_fences);
        });
        if (fences)
            std::cout << (device.has(Feature::present_fences) ? "with" : "without")
                      << " fences of presents\n";
        Presenter presenter(device, window());
        const auto frame = [&] {
            window().poll();
            EXPECT_TRUE(presenter.frame([](Commands&) {}, [](Commands&) {}));
        };
        // Images return in any order, each at the latest after all others.
        const auto settle = [&] {
            for (int i = 0; i < 60 && (i < 2 || presenter.oldSwapchains() > 0); ++i) frame();
            EXPECT_EQ(presenter.oldSwapchains(), 0u);
        };
        settle();
        for (const std::uint32_t width : {800u, 320u, 640u}) {
            window().resize(width, 360);
            settle();
        }
        for (const PresentMode mode : presenter.modes()) {
            presenter.setMode(mode);
            EXPECT_LE(presenter.oldSwapchains(), 1u);
            settle();
        }
        // Many resizes; the last swap chains are left for destruction.
        for (std::uint32_t i = 0; i < 12; ++i) {
            window().resize(400 + 10 * i, 360);
            frame();
            EXPECT_LE(presenter.oldSwapchains(), 4u);
        }
    }
}

}  // namespace
}  // namespace engine
