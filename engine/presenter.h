#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/commands.h"
#include "engine/queries.h"
#include "engine/window.h"

// Pictures on the screen: the swap chain of a window, and the presenter that draws to it.
namespace engine {

// How pictures are presented to the screen.
enum class PresentMode {
    fifo,       // in step with the screen: no tearing, and no faster
    mailbox,    // the newest picture, in step with the screen
    immediate,  // at once, possibly torn
};

const char* presentModeName(PresentMode mode);

// A window's images and the objects that their presents use. The size is fixed: if the window's
// size changes, another swap chain is made, and this one must live until its presents are done.
class Swapchain {
public:
    // Uses fifo if the surface lacks `mode`. `extent`: the window's size, for surfaces that accept
    // any size. `old`: the replaced swap chain, which presents nothing new from then on. Throws
    // Error if the device can't present to the surface.
    Swapchain(
        const Device& device, VkSurfaceKHR surface, VkExtent2D extent, PresentMode mode,
        const Swapchain* old = nullptr);

    // Returns the index of the next image and signals `acquired` for it; none if the swap chain no
    // longer fits the window. The last present of the image is over by then.
    std::optional<std::uint32_t> acquire(VkSemaphore acquired);

    // Copies a picture in TRANSFER_SRC_OPTIMAL into an acquired image, scaled to its size, and
    // makes it ready to present.
    void copy(Commands& commands, const Image& picture, std::uint32_t index) const;

    // Semaphore that the drawing of an acquired image signals and its present waits for.
    VkSemaphore drawn(std::uint32_t index) const { return slots_[index].drawn.get(); }
    // Presents an acquired image once it is drawn. Returns false if the swap chain no longer fits
    // the window.
    bool present(std::uint32_t index);

    // Whether a presented image came back. Then the presents of earlier swap chains are over.
    bool cameBack() const { return came_back_; }
    // With Feature::present_fences: whether no present uses this swap chain any more.
    bool isDone() const;
    // Waits for isDone(), at most a second. Without the feature it does not wait.
    void finish() const;

    VkExtent2D extent() const { return extent_; }
    PresentMode mode() const { return mode_; }
    std::size_t imageCount() const { return slots_.size(); }

    static std::vector<PresentMode> modes(const Device& device, VkSurfaceKHR surface);
    // Whether the surface has no size at present, for example because its window is minimised.
    static bool isEmpty(const Device& device, VkSurfaceKHR surface);

private:
    struct Slot {
        VkImage image{};
        Handle<VkSemaphore, &vkDestroySemaphore> drawn;
        Fence shown;  // null without Feature::present_fences
        bool is_presented = false;  // since its last acquisition
    };

    // Fences of presents not yet seen to be over.
    std::vector<VkFence> pending() const;

    const Device& device_;
    VkExtent2D extent_{};
    PresentMode mode_ = PresentMode::fifo;
    std::vector<Slot> slots_;  // [image]; destroyed after the swap chain
    bool came_back_ = false;
    Handle<VkSwapchainKHR, &vkDestroySwapchainKHR> swapchain_;
};

// Draws a window's contents. Pictures are drawn into a separate image, which always has the same
// format and can be read back, and are then copied to the window's image. The device time is
// measured for each picture.
class Presenter {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

    // The device must have been made with Window::instanceExtensions().
    Presenter(const Device& device, const Window& window, PresentMode mode = PresentMode::fifo);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Draws and presents one picture. `before` records work outside rendering. `draw` renders into
    // one attachment of kFormat and extent(), cleared to black. Returns false, without calling
    // either, while the window is minimised. After the window's size changes, pictures have the new
    // size.
    bool
    frame(const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw);

    // Size of the next picture, px; 0 x 0 while the window is minimised.
    VkExtent2D extent() const { return window_.pixels(); }
    std::uint32_t imageCount() const;
    // Number of earlier swap chains with presents that may not be over.
    std::size_t oldSwapchains() const { return old_.size(); }

    PresentMode mode() const { return mode_; }
    void setMode(PresentMode mode);
    std::vector<PresentMode> modes() const;

    // Device time of the last finished picture, from `before` to the copy, ms.
    double milliseconds() const { return milliseconds_; }

    struct Picture {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<std::uint8_t> pixels;  // [row][column] RGBA, top row first
    };
    // Returns the last picture. Waits for the device.
    Picture picture() const;

private:
    void wait();
    void retire();
    void dropRetired();
    void dropSwapchains();
    void renewSurface();
    bool showFrame(
        const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw);
    bool prepare();
    void record(
        std::uint32_t index, const std::function<void(Commands&)>& before,
        const std::function<void(Commands&)>& draw);
    void submit(std::uint32_t index);

    const Device& device_;
    const Window& window_;
    PresentMode mode_;
    struct DestroySurface {
        VkInstance instance{};
        VkDevice device{};
        void operator()(VkSurfaceKHR surface) const;
    };
    std::unique_ptr<VkSurfaceKHR_T, DestroySurface> surface_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    VkCommandBuffer buffer_{};
    DescriptorSets sets_;
    Fence done_;
    Handle<VkSemaphore, &vkDestroySemaphore> acquired_;
    struct OldSwapchain {
        std::unique_ptr<Swapchain> swapchain;
        std::uint64_t frames;  // submitted before the swap chain was retired
    };
    std::vector<OldSwapchain> old_;
    std::unique_ptr<Swapchain> swapchain_;
    std::optional<Image> canvas_;
    std::optional<Timestamps> timestamps_;
    bool pending_ = false;
    std::uint64_t frames_ = 0;  // submitted
    std::uint64_t submission_ = 0;  // HazardLog number of the pending submission
    double milliseconds_ = 0.0;
};

}  // namespace engine
