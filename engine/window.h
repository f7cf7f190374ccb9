#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/instance.h"

struct GLFWwindow;

namespace engine {

// There is nothing to open a window on.
class NoDisplay : public Error {
public:
    using Error::Error;
};

struct WindowDescription {
    std::string title = "hairbench";
    std::uint32_t width = 1280;  // of what is inside, screen coordinates
    std::uint32_t height = 720;
};

// A window of the desktop, for Vulkan. One at a time; all of it from the main thread.
class Window {
public:
    // Throws NoDisplay where there is no desktop.
    explicit Window(const WindowDescription& description);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* get() const { return window_; }

    // What a Vulkan instance must have to show pictures here.
    static std::vector<std::string> instanceExtensions();
    VkSurfaceKHR createSurface(VkInstance instance) const;

    // Handles what happened since the last call; `seconds`: waits so long for something to happen.
    void poll(double seconds = 0.0);
    // Ends a poll() that waits, or the next one. From any thread, while there is a window.
    static void endWait();
    // Whether the mouse, the keyboard or the desktop did anything to it since the last call.
    bool takeActivity() { return std::exchange(active_, false); }

    bool wantsToClose() const;
    VkExtent2D pixels() const;  // of the picture inside; 0 x 0 while it is minimised
    float density() const;  // px per screen coordinate
    // Screen coordinates per point of a usual screen: 2 on a fine one, unless the desktop counts
    // in points itself.
    float contentScale() const;
    VkExtent2D size() const;  // screen coordinates
    void resize(std::uint32_t width, std::uint32_t height);  // screen coordinates
    void setTitle(const std::string& title);
    void close();  // as if the user had

    // Files dropped on it since the last call.
    std::vector<std::filesystem::path> takeDropped();

private:
    // Any of GLFW's callbacks.
    template <class... What>
    static void wake(GLFWwindow* window, What...);

    GLFWwindow* window_ = nullptr;
    std::vector<std::filesystem::path> dropped_;
    bool active_ = true;
};

}  // namespace engine
