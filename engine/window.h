#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/instance.h"

struct GLFWwindow;

namespace engine {

// There is no display to open a window on.
class NoDisplay : public Error {
public:
    using Error::Error;
};

struct WindowDescription {
    std::string title = "hairbench";
    std::uint32_t width = 1280;  // of the content, screen coordinates
    std::uint32_t height = 720;
};

// A desktop window for Vulkan. One at a time; use it from the main thread.
class Window {
public:
    // Throws NoDisplay if there is no desktop.
    explicit Window(const WindowDescription& description);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* get() const { return window_; }

    // Returns the instance extensions that presenting to a window needs.
    static std::vector<std::string> instanceExtensions();
    VkSurfaceKHR createSurface(VkInstance instance) const;

    // Handles the events since the last call. `seconds`: longest wait for an event.
    void poll(double seconds = 0.0);
    // Ends a waiting poll(), or the next one. Any thread may call it while a window exists.
    static void endWait();
    // Whether the mouse, the keyboard or the desktop caused an event since the last call.
    bool takeActivity() { return std::exchange(active_, false); }

    bool wantsToClose() const;
    VkExtent2D pixels() const;  // of the content; 0 x 0 while minimised
    float density() const;  // px per screen coordinate
    // Screen coordinates per point of a usual screen: 2 on a high-density screen, unless the
    // desktop's own coordinates are points.
    float contentScale() const;
    VkExtent2D size() const;  // screen coordinates
    void resize(std::uint32_t width, std::uint32_t height);  // screen coordinates
    void setTitle(const std::string& title);
    void close();  // as if the user had closed it

    // Returns the files dropped on the window since the last call.
    std::vector<std::filesystem::path> takeDropped();

private:
    // Callback for any GLFW event: notes activity.
    template <class... What>
    static void wake(GLFWwindow* window, What...);

    GLFWwindow* window_ = nullptr;
    std::vector<std::filesystem::path> dropped_;
    bool active_ = true;
};

}  // namespace engine
