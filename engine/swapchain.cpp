#include "engine/swapchain.h"

#include <algorithm>
#include <array>
#include <limits>

namespace engine {

namespace {

struct Mode {
    PresentMode mode;
    VkPresentModeKHR vulkan;
    const char* name;
};
constexpr std::array kModes{
    Mode{PresentMode::fifo, VK_PRESENT_MODE_FIFO_KHR, "fifo"},
    Mode{PresentMode::mailbox, VK_PRESENT_MODE_MAILBOX_KHR, "mailbox"},
    Mode{PresentMode::immediate, VK_PRESENT_MODE_IMMEDIATE_KHR, "immediate"}};

// lavapipe loses about every tenth new surface once, and finds it when asked again.
VkSurfaceCapabilitiesKHR capabilitiesOf(VkPhysicalDevice device, VkSurfaceKHR surface) {
    VkSurfaceCapabilitiesKHR capabilities{};
    VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device, surface, &capabilities);
    if (result == VK_ERROR_SURFACE_LOST_KHR)
        result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device, surface, &capabilities);
    check(result, "ask what the window can show");
    return capabilities;
}

// Eight bits a channel and no conversion: what is drawn is display-referred already.
VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check(
        vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr),
        "list the window's formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(
        vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()),
        "list the window's formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        const auto found = std::ranges::find(formats, wanted, &VkSurfaceFormatKHR::format);
        if (found != formats.end()) return *found;
    }
    throw Error("the window takes no pictures of eight bits a channel");
}

VkExtent2D chooseExtent(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D wanted) {
    if (capabilities.currentExtent.width != std::numeric_limits<std::uint32_t>::max())
        return capabilities.currentExtent;
    return {
        std::clamp(
            wanted.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
        std::clamp(
            wanted.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR chooseAlpha(const VkSurfaceCapabilitiesKHR& capabilities) {
    for (const VkCompositeAlphaFlagBitsKHR alpha :
         {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
          VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR})
        if (capabilities.supportedCompositeAlpha & alpha) return alpha;
    return VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR;
}

void imageBarrier(
    VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
    VkAccessFlags2 before, VkAccessFlags2 after) {
    const VkImageMemoryBarrier2 barrier{
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .pNext = nullptr,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .srcAccessMask = before,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .dstAccessMask = after,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

const char* presentModeName(PresentMode mode) {
    return std::ranges::find(kModes, mode, &Mode::mode)->name;
}

std::vector<PresentMode> Swapchain::modes(const Device& device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check(
        vkGetPhysicalDeviceSurfacePresentModesKHR(device.info().handle, surface, &count, nullptr),
        "list the window's present modes");
    std::vector<VkPresentModeKHR> available(count);
    check(
        vkGetPhysicalDeviceSurfacePresentModesKHR(
            device.info().handle, surface, &count, available.data()),
        "list the window's present modes");
    std::vector<PresentMode> modes;
    for (const Mode& mode : kModes)
        if (std::ranges::count(available, mode.vulkan)) modes.push_back(mode.mode);
    return modes;
}

bool Swapchain::isEmpty(const Device& device, VkSurfaceKHR surface) {
    const VkExtent2D now = capabilitiesOf(device.info().handle, surface).currentExtent;
    return now.width == 0 || now.height == 0;
}

Swapchain::Swapchain(
    const Device& device, VkSurfaceKHR surface, VkExtent2D extent, PresentMode mode,
    const Swapchain* old)
    : device_(device) {
    const VkPhysicalDevice physical = device.info().handle;
    const VkSurfaceCapabilitiesKHR capabilities = capabilitiesOf(physical, surface);
    const VkSurfaceFormatKHR format = chooseFormat(physical, surface);
    const std::vector<PresentMode> available = modes(device, surface);
    mode_ = std::ranges::count(available, mode) ? mode : PresentMode::fifo;
    extent_ = chooseExtent(capabilities, extent);

    VkSwapchainCreateInfoKHR create{};
    create.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    create.surface = surface;
    create.minImageCount = capabilities.minImageCount + 1;
    if (capabilities.maxImageCount > 0)
        create.minImageCount = std::min(create.minImageCount, capabilities.maxImageCount);
    create.imageFormat = format.format;
    create.imageColorSpace = format.colorSpace;
    create.imageExtent = extent_;
    create.imageArrayLayers = 1;
    create.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    create.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create.preTransform = capabilities.currentTransform;
    create.compositeAlpha = chooseAlpha(capabilities);
    create.presentMode = std::ranges::find(kModes, mode_, &Mode::mode)->vulkan;
    create.clipped = VK_TRUE;
    create.oldSwapchain = old ? old->swapchain_.get() : VK_NULL_HANDLE;
    VkSwapchainKHR swapchain{};
    check(vkCreateSwapchainKHR(device.get(), &create, nullptr, &swapchain), "create a swapchain");
    swapchain_ = {device.get(), swapchain};

    std::uint32_t count = 0;
    check(
        vkGetSwapchainImagesKHR(device.get(), swapchain, &count, nullptr),
        "list the swapchain's images");
    images_.resize(count);
    check(
        vkGetSwapchainImagesKHR(device.get(), swapchain, &count, images_.data()),
        "list the swapchain's images");
}

std::optional<std::uint32_t> Swapchain::acquire(VkSemaphore acquired) const {
    std::uint32_t index = 0;
    const VkResult result = vkAcquireNextImageKHR(
        device_.get(), swapchain_.get(), std::numeric_limits<std::uint64_t>::max(), acquired,
        VK_NULL_HANDLE, &index);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    if (result != VK_SUBOPTIMAL_KHR) check(result, "get the window's next picture");
    return index;
}

void Swapchain::copy(Commands& commands, const Image& picture, std::uint32_t index) const {
    const VkImage image = images_[index];
    imageBarrier(
        commands.get(), image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        VK_ACCESS_2_NONE, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    const auto corner = [](VkExtent2D extent) {
        return VkOffset3D{
            static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
    };
    const VkImageBlit region{
        .srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .srcOffsets = {{0, 0, 0}, corner(picture.extent())},
        .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .dstOffsets = {{0, 0, 0}, corner(extent_)}};
    vkCmdBlitImage(
        commands.get(), picture.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
        VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
    imageBarrier(
        commands.get(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_NONE);
}

bool Swapchain::present(std::uint32_t index, VkSemaphore drawn) const {
    const VkSwapchainKHR swapchain = swapchain_.get();
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &index;
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    check(result, "show a picture");
    return true;
}

}  // namespace engine
