#include "engine/window.h"

#include <cstdlib>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace engine {
namespace {

std::string reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason is given";
}

// GLFW 3.4 first looks for a Wayland compositor. Without one, libwayland prints its own message to
// stderr.
void chooseDesktop() {
#if defined(GLFW_PLATFORM) && defined(__unix__) && !defined(__APPLE__)
    if (!std::getenv("WAYLAND_DISPLAY") && !std::getenv("WAYLAND_SOCKET"))
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

// One line that includes GLFW's own reason.
std::string noDisplay() { return "no display to open a window on (" + reason() + ")"; }

}  // namespace

Window::Window(const WindowDescription& description) {
    chooseDesktop();
    if (glfwInit() != GLFW_TRUE) throw NoDisplay(noDisplay());
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(
        static_cast<int>(description.width), static_cast<int>(description.height),
        description.title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string text = noDisplay();
        glfwTerminate();
        throw NoDisplay(text);
    }
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
        for (int i = 0; i < count; ++i) self.dropped_.emplace_back(paths[i]);
        self.active_ = true;
    });
    // Dear ImGui's callbacks, which are set later, call these.
    glfwSetKeyCallback(window_, &wake);
    glfwSetCharCallback(window_, &wake);
    glfwSetMouseButtonCallback(window_, &wake);
    glfwSetCursorPosCallback(window_, &wake);
    glfwSetCursorEnterCallback(window_, &wake);
    glfwSetScrollCallback(window_, &wake);
    glfwSetWindowFocusCallback(window_, &wake);
    glfwSetWindowRefreshCallback(window_, &wake);
    glfwSetWindowIconifyCallback(window_, &wake);
    glfwSetFramebufferSizeCallback(window_, &wake);
    glfwSetWindowContentScaleCallback(window_, &wake);
}

template <class... What>
void Window::wake(GLFWwindow* window, What...) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->active_ = true;
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<std::string> Window::instanceExtensions() {
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) throw NoDisplay("Vulkan can show nothing on this display: " + reason());
    return {names, names + count};
}

VkSurfaceKHR Window::createSurface(VkInstance instance) const {
    VkSurfaceKHR surface{};
    check(
        glfwCreateWindowSurface(instance, window_, nullptr, &surface), "create a window's surface");
    return surface;
}

void Window::poll(double seconds) {
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void Window::endWait() { glfwPostEmptyEvent(); }

bool Window::wantsToClose() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

VkExtent2D Window::pixels() const {
    // Some desktops keep the size of a minimised window.
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return {0, 0};
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

VkExtent2D Window::size() const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

float Window::density() const {
    const std::uint32_t in_pixels = pixels().width, coordinates = size().width;
    return in_pixels == 0 || coordinates == 0
               ? 1.0f
               : static_cast<float>(in_pixels) / static_cast<float>(coordinates);
}

float Window::contentScale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return y / density();
}

void Window::resize(std::uint32_t width, std::uint32_t height) {
    glfwSetWindowSize(window_, static_cast<int>(width), static_cast<int>(height));
}

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

std::vector<std::filesystem::path> Window::takeDropped() { return std::exchange(dropped_, {}); }

}  // namespace engine
