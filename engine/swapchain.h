#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/commands.h"

namespace engine {

// How pictures reach the screen.
enum class PresentMode {
    fifo,       // in step with the screen: never torn, and never faster
    mailbox,    // the newest one, in step with the screen
    immediate,  // at once, torn where it comes in between
};

const char* presentModeName(PresentMode mode);

// The images that a window shows, one after another. Of one size: made anew when the window's
// changes.
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

    // Shows it once `drawn` is signalled. False where the swapchain no longer fits the window.
    bool present(std::uint32_t index, VkSemaphore drawn) const;

    VkExtent2D extent() const { return extent_; }
    PresentMode mode() const { return mode_; }
    std::size_t imageCount() const { return images_.size(); }

    static std::vector<PresentMode> modes(const Device& device, VkSurfaceKHR surface);
    // Whether the surface has no size now, as that of a window that is minimised.
    static bool isEmpty(const Device& device, VkSurfaceKHR surface);

private:
    const Device& device_;
    VkExtent2D extent_{};
    PresentMode mode_ = PresentMode::fifo;
    Handle<VkSwapchainKHR, &vkDestroySwapchainKHR> swapchain_;
    std::vector<VkImage> images_;
};

}  // namespace engine
