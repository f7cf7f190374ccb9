#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/commands.h"
#include "engine/queries.h"
#include "engine/window.h"

// Pictures on the screen: the images of a window, and who draws them.
namespace engine {

// How pictures reach the screen.
enum class PresentMode {
    fifo,       // in step with the screen: never torn, and never faster
    mailbox,    // the newest one, in step with the screen
    immediate,  // at once, torn where it comes in between
};

const char* presentModeName(PresentMode mode);

// The images that a window shows, one after another. They have one size: where the window's changes
// another swapchain is made.
class Swapchain {
public:
    // Fifo where the surface has no such mode. `extent` is what the window says, for surfaces that
    // take any. `old` is retired. Throws Error where the device can't show pictures there.
    Swapchain(
        const Device& device, VkSurfaceKHR surface, VkExtent2D extent, PresentMode mode,
        const Swapchain* old = nullptr);

    // The index of the next image, which `acquired` is signalled for; none where the swapchain no
    // longer fits the window.
    std::optional<std::uint32_t> acquire(VkSemaphore acquired) const;

    // Copies a picture in TRANSFER_SRC_OPTIMAL into an acquired image, scaled to its size, and
    // makes it ready to be shown.
    void copy(Commands& commands, const Image& picture, std::uint32_t index) const;

    // Shows an acquired image once `drawn` is signalled. False where the swapchain no longer fits
    // the window.
    bool present(std::uint32_t index, VkSemaphore drawn) const;

    VkExtent2D extent() const { return extent_; }
    PresentMode mode() const { return mode_; }
    std::size_t imageCount() const { return images_.size(); }

    static std::vector<PresentMode> modes(const Device& device, VkSurfaceKHR surface);
    // Whether the surface has no size now, as where its window is minimised.
    static bool isEmpty(const Device& device, VkSurfaceKHR surface);

private:
    const Device& device_;
    VkExtent2D extent_{};
    PresentMode mode_ = PresentMode::fifo;
    Handle<VkSwapchainKHR, &vkDestroySwapchainKHR> swapchain_;
    std::vector<VkImage> images_;
};

// Draws what a window shows. Pictures are drawn into an image of their own, whose format is always
// the same and which can be read back, and then copied to the window's; the cost on the device is
// measured by itself.
class Presenter {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

    // The device must have been made with Window::instanceExtensions().
    Presenter(const Device& device, const Window& window, PresentMode mode = PresentMode::fifo);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Draws one picture and shows it: `before` records what is no rendering, `draw` what renders
    // into one attachment of kFormat and extent(), black at first. False, and nothing is called,
    // while the window is minimised. A window that changed its size gets pictures of the new one.
    bool
    frame(const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw);

    // Size of the next picture, px; 0 x 0 while the window is minimised.
    VkExtent2D extent() const { return window_.pixels(); }
    std::uint32_t imageCount() const;

    PresentMode mode() const { return mode_; }
    void setMode(PresentMode mode);
    std::vector<PresentMode> modes() const;

    // ms on the device that the last finished picture took, from `before` to the copy.
    double milliseconds() const { return milliseconds_; }

    struct Picture {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<std::uint8_t> pixels;  // [row][column] RGBA, top row first
    };
    // The last picture. Waits for the device.
    Picture picture() const;

private:
    void wait();
    void dropSwapchain();
    bool prepare();
    void record(
        std::uint32_t index, const std::function<void(Commands&)>& before,
        const std::function<void(Commands&)>& draw);
    void submit(std::uint32_t index);

    const Device& device_;
    const Window& window_;
    PresentMode mode_;
    VkSurfaceKHR surface_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    VkCommandBuffer buffer_{};
    DescriptorSets sets_;
    Handle<VkFence, &vkDestroyFence> done_;
    Handle<VkSemaphore, &vkDestroySemaphore> acquired_;
    std::vector<Handle<VkSemaphore, &vkDestroySemaphore>> drawn_;  // one for each image
    std::optional<Swapchain> swapchain_;
    std::optional<Image> canvas_;
    std::optional<Timestamps> timestamps_;
    bool pending_ = false;
    std::uint64_t submission_ = 0;  // the pending one, as HazardLog counts
    double milliseconds_ = 0.0;
};

}  // namespace engine
