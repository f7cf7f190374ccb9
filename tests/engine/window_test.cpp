#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>

#include "engine/presenter.h"
#include "engine/ui.h"
#include "tests/required.h"
#include "tests/viewer/virtual_display.h"

namespace engine {
namespace {

TEST(Window, ShowsWidgets) {
    const VirtualDisplay display;
    if (!display.name().empty()) {
        setenv("DISPLAY", display.name().c_str(), 1);
        unsetenv("WAYLAND_DISPLAY");
    }
    std::optional<Window> window;
    try {
        window.emplace(WindowDescription{.title = "test", .width = 640, .height = 360});
    } catch (const NoDisplay& error) {
        return skipWithout(Need::display, error.what());
    }
    const Device device(
        {.validation = Validation::on, .window_extensions = Window::instanceExtensions()});
    {
        Presenter presenter(device, *window);
        Ui ui(device, *window, 1.0f);
        for (int i = 0; i < 6; ++i) {
            window->poll();
            if (i == 3) window->resize(800, 450);
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
    for (const std::string& message : device.messages().take()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace engine
