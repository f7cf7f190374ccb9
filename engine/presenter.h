#pragma once

#include <cstdint>
#include <functional>
#include <memory>
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

// The images that a window shows, one after another, and what their presents use. They have one
// size: where the window's changes another swapchain is made, and this one must live until its
// presents are done with.
class Swapchain {
public:
    // Fifo where the surface has no such mode. `extent` is what the window says, for surfaces that
    // take any. `old` shows nothing new from then on. Throws Error where the device can't show
    // pictures there.
    Swapchain(
        const Device& device, VkSurfaceKHR surface, VkExtent2D extent, PresentMode mode,
        const Swapchain* old = nullptr);

    // The index of the next image, which `acquired` is signalled for; none where the swapchain no
    // longer fits the window. An image that comes back is no longer used by its last present.
    std::optional<std::uint32_t> acquire(VkSemaphore acquired);

    // Copies a picture in TRANSFER_SRC_OPTIMAL into an acquired image, scaled to its size, and
    // makes it ready to be shown.
    void copy(Commands& commands, const Image& picture, std::uint32_t index) const;

    // What whoever draws an acquired image signals, and its present waits for.
    VkSemaphore drawn(std::uint32_t index) const { return slots_[index].drawn.get(); }
    // Shows an acquired image once it is drawn. False where the swapchain no longer fits the
    // window.
    bool present(std::uint32_t index);

    // Whether an image was presented and came back: presents of swapchains before this are over.
    bool cameBack() const { return came_back_; }
    // With Feature::present_fences: whether no present uses anything of it.
    bool isDone() const;
    // Waits for that, a second at most; without the feature not at all.
    void finish() const;

    VkExtent2D extent() const { return extent_; }
    PresentMode mode() const { return mode_; }
    std::size_t imageCount() const { return slots_.size(); }

    static std::vector<PresentMode> modes(const Device& device, VkSurfaceKHR surface);
    // Whether the surface has no size now, as where its window is minimised.
    static bool isEmpty(const Device& device, VkSurfaceKHR surface);

private:
    struct Slot {
        VkImage image{};
        Handle<VkSemaphore, &vkDestroySemaphore> drawn;
        Handle<VkFence, &vkDestroyFence> shown;  // null without Feature::present_fences
        bool is_presented = false;  // since it was acquired last
    };

    // Fences of presents that were not seen to be over.
    std::vector<VkFence> pending() const;

    const Device& device_;
    VkExtent2D extent_{};
    PresentMode mode_ = PresentMode::fifo;
    std::vector<Slot> slots_;  // [image]; goes after the swapchain
    bool came_back_ = false;
    Handle<VkSwapchainKHR, &vkDestroySwapchainKHR> swapchain_;
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
    // Those that the window had before and whose presents may not be over.
    std::size_t oldSwapchains() const { return old_.size(); }

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
    Handle<VkFence, &vkDestroyFence> done_;
    Handle<VkSemaphore, &vkDestroySemaphore> acquired_;
    struct OldSwapchain {
        std::unique_ptr<Swapchain> swapchain;
        std::uint64_t frames;  // that were submitted before it was retired
    };
    std::vector<OldSwapchain> old_;
    std::unique_ptr<Swapchain> swapchain_;
    std::optional<Image> canvas_;
    std::optional<Timestamps> timestamps_;
    bool pending_ = false;
    std::uint64_t frames_ = 0;  // that were submitted
    std::uint64_t submission_ = 0;  // the pending one, as HazardLog counts
    double milliseconds_ = 0.0;
};

}  // namespace engine
