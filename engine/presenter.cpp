#include "engine/presenter.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/buffer_image.h"
#include "engine/process.h"
#include "engine/target.h"
#include "engine/transfer.h"

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

// lavapipe reports about every tenth new surface as lost once. A second query succeeds.
VkSurfaceCapabilitiesKHR capabilitiesOf(VkPhysicalDevice device, VkSurfaceKHR surface) {
    VkSurfaceCapabilitiesKHR capabilities{};
    VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device, surface, &capabilities);
    if (result == VK_ERROR_SURFACE_LOST_KHR)
        result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device, surface, &capabilities);
    check(result, "ask what the window can show");
    return capabilities;
}

// Eight bits per channel and no conversion: drawn colours are already display-referred.
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
    throw Error("the window supports no format of 8 bits per channel");
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

Handle<VkSemaphore, &vkDestroySemaphore> makeSemaphore(VkDevice device) {
    const VkSemaphoreCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = nullptr, .flags = 0};
    VkSemaphore semaphore{};
    check(vkCreateSemaphore(device, &create, nullptr, &semaphore), "create a semaphore");
    return {device, semaphore};
}

VkSemaphoreSubmitInfo semaphoreInfo(VkSemaphore semaphore, VkPipelineStageFlags2 stages) {
    VkSemaphoreSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    info.semaphore = semaphore;
    info.stageMask = stages;
    return info;
}

}  // namespace

// ---- Swapchain ----------------------------------------------------------------------------------

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
    std::vector<VkImage> images(count);
    check(
        vkGetSwapchainImagesKHR(device.get(), swapchain, &count, images.data()),
        "list the swapchain's images");
    for (const VkImage image : images) {
        Slot& slot = slots_.emplace_back();
        slot.image = image;
        slot.drawn = makeSemaphore(device.get());
        if (device.has(Feature::present_fences)) slot.shown = Fence(device.get());
    }
}

std::optional<std::uint32_t> Swapchain::acquire(VkSemaphore acquired) {
    std::uint32_t index = 0;
    VkResult result{};
    // An invisible window may delay its image for as long as it is invisible.
    waitInterruptibly([&](std::uint64_t nanoseconds) {
        result = vkAcquireNextImageKHR(
            device_.get(), swapchain_.get(), nanoseconds, acquired, VK_NULL_HANDLE, &index);
        return result != VK_TIMEOUT && result != VK_NOT_READY;
    });
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    if (result != VK_SUBOPTIMAL_KHR) check(result, "get the window's next picture");
    Slot& slot = slots_[index];
    if (std::exchange(slot.is_presented, false)) {
        came_back_ = true;
        if (const VkFence shown = slot.shown.get()) {
            device_.await("wait for a picture to be shown", [&](std::uint64_t nanoseconds) {
                return vkWaitForFences(device_.get(), 1, &shown, VK_TRUE, nanoseconds);
            });
        }
    }
    return index;
}

std::vector<VkFence> Swapchain::pending() const {
    std::vector<VkFence> fences;
    for (const Slot& slot : slots_)
        if (slot.is_presented && slot.shown.get()) fences.push_back(slot.shown.get());
    return fences;
}

bool Swapchain::isDone() const {
    return std::ranges::all_of(pending(), [this](VkFence shown) {
        return vkGetFenceStatus(device_.get(), shown) == VK_SUCCESS;
    });
}

void Swapchain::finish() const {
    constexpr std::uint64_t kSecond = 1'000'000'000;  // ns
    const std::vector<VkFence> fences = pending();
    if (!fences.empty() && !isGivenUp(device_.get()))
        vkWaitForFences(
            device_.get(), static_cast<std::uint32_t>(fences.size()), fences.data(), VK_TRUE,
            kSecond);
}

void Swapchain::copy(Commands& commands, const Image& picture, std::uint32_t index) const {
    const VkImage image = slots_[index].image;
    commands.uses({{picture, Access::transfer_read}});
    commands.order();
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

bool Swapchain::present(std::uint32_t index) {
    const VkSwapchainKHR swapchain = swapchain_.get();
    const VkSemaphore drawn = slots_[index].drawn.get();
    const VkFence shown = slots_[index].shown.ready();
    VkSwapchainPresentFenceInfoEXT fences{};
    fences.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_PRESENT_FENCE_INFO_EXT;
    fences.swapchainCount = 1;
    fences.pFences = &shown;
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    if (shown) info.pNext = &fences;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &index;
    slots_[index].is_presented = true;
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    check(result, "show a picture");
    return true;
}

// ---- Presenter ----------------------------------------------------------------------------------

Presenter::Presenter(const Device& device, const Window& window, PresentMode mode)
    : device_(device), window_(window), mode_(mode),
      surface_(
          window.createSurface(device.instance()), DestroySurface{device.instance(), device.get()}),
      sets_(device) {
    VkBool32 presents = VK_FALSE;
    check(
        vkGetPhysicalDeviceSurfaceSupportKHR(
            device.info().handle, device.info().queue_family, surface_.get(), &presents),
        "ask whether the device can show pictures in a window");
    if (!presents) throw Error(device.info().name + " can't show pictures in a window");
    const VkCommandPoolCreateInfo pool{
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .pNext = nullptr,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = device.info().queue_family};
    VkCommandPool pool_handle{};
    check(vkCreateCommandPool(device.get(), &pool, nullptr, &pool_handle), "create a command pool");
    pool_ = {device.get(), pool_handle};
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .pNext = nullptr,
        .commandPool = pool_handle,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device.get(), &allocate, &buffer_), "allocate a command buffer");
    done_ = Fence(device.get());
    acquired_ = makeSemaphore(device.get());
    timestamps_.emplace(device, 2);
}

Presenter::~Presenter() { dropSwapchains(); }

void Presenter::DestroySurface::operator()(VkSurfaceKHR surface) const {
    if (!isGivenUp(device)) vkDestroySurfaceKHR(instance, surface, nullptr);
}

void Presenter::dropSwapchains() {
    if (!isGivenUp(device_.get())) vkQueueWaitIdle(device_.queue());
    for (const OldSwapchain& old : old_) old.swapchain->finish();
    if (swapchain_) swapchain_->finish();
    old_.clear();
    swapchain_.reset();
}

// Makes a new surface for the same window.
void Presenter::renewSurface() {
    dropSwapchains();
    surface_.reset();  // a window has only one surface at a time
    surface_.reset(window_.createSurface(device_.instance()));
}

std::uint32_t Presenter::imageCount() const {
    return swapchain_ ? static_cast<std::uint32_t>(swapchain_->imageCount()) : 2;
}

void Presenter::setMode(PresentMode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    retire();
}

std::vector<PresentMode> Presenter::modes() const {
    return Swapchain::modes(device_, surface_.get());
}

void Presenter::wait() {
    if (!pending_) return;
    pending_ = false;
    const VkFence done = done_.get();
    device_.await("wait for the window's picture", [&](std::uint64_t nanoseconds) {
        return vkWaitForFences(device_.get(), 1, &done, VK_TRUE, nanoseconds);
    });
    if (device_.hazards()) device_.hazards()->finish(submission_);
    milliseconds_ = timestamps_->read().back();
}

// Retires the swap chain. The next picture gets a new one.
void Presenter::retire() {
    if (!swapchain_) return;
    old_.push_back({.swapchain = std::move(swapchain_), .frames = frames_});
    // While a window is resized, swap chains change before any image comes back.
    constexpr std::size_t kMostOld = 4;
    if (old_.size() <= kMostOld) return;
    check(vkQueueWaitIdle(device_.queue()), "wait for the device");
    old_.front().swapchain->finish();
    old_.erase(old_.begin());
}

// Drops retired swap chains. Nothing that a present waits for or shows may be destroyed before the
// present is over. A fence tells when. Without fences, an image that came back was shown, and so
// were all earlier presents. A frame submitted after the present must be over too, because an
// observer of the queue, such as a validation layer, may not know the fence.
void Presenter::dropRetired() {
    if (device_.has(Feature::present_fences))
        std::erase_if(old_, [this](const OldSwapchain& old) {
            return old.frames < frames_ && old.swapchain->isDone();
        });
    else if (swapchain_->cameBack())
        old_.clear();
}

// Makes the images for the window's size.
bool Presenter::prepare() {
    const VkExtent2D extent = window_.pixels();
    if (extent.width == 0 || extent.height == 0) return false;
    const bool fits = swapchain_ && swapchain_->extent().width == extent.width &&
                      swapchain_->extent().height == extent.height;
    // The surface may know before the window that the window was minimised.
    if (!fits && Swapchain::isEmpty(device_, surface_.get())) return false;
    if (!fits) {
        retire();
        swapchain_ = std::make_unique<Swapchain>(
            device_, surface_.get(), extent, mode_,
            old_.empty() ? nullptr : old_.back().swapchain.get());
    }
    const VkExtent2D canvas = canvas_ ? canvas_->extent() : VkExtent2D{};
    if (canvas.width != swapchain_->extent().width ||
        canvas.height != swapchain_->extent().height) {
        canvas_.emplace(
            device_,
            ImageDescription{
                .format = kFormat,
                .width = swapchain_->extent().width,
                .height = swapchain_->extent().height,
                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                .name = "window",
                .purpose = "window"});
    }
    return true;
}

bool Presenter::frame(
    const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw) {
    wait();
    try {
        return showFrame(before, draw);
    } catch (const SurfaceLost&) {
        wait();
        renewSurface();
        return showFrame(before, draw);
    }
}

bool Presenter::showFrame(
    const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw) {
    // While a window is resized, it may outgrow its images more than once.
    for (int attempt = 0; attempt < 3; ++attempt) {
        if (!prepare()) return false;
        const std::optional<std::uint32_t> index = swapchain_->acquire(acquired_.get());
        if (!index) {
            retire();
            continue;
        }
        dropRetired();
        record(*index, before, draw);
        submit(*index);
        if (!swapchain_->present(*index)) retire();
        return true;
    }
    return false;
}

void Presenter::record(
    std::uint32_t index, const std::function<void(Commands&)>& before,
    const std::function<void(Commands&)>& draw) {
    timestamps_->reset();
    Commands commands(buffer_, sets_, device_.hazards());
    commands.begin();
    commands.beginLabel("ui");
    timestamps_->write(commands);
    commands.orderAll();
    before(commands);
    commands.transition(
        *canvas_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    const Attachment canvas{.image = &*canvas_, .load = Load::clear, .clear = {0, 0, 0, 1}};
    beginRendering(commands, std::span(&canvas, 1), std::nullopt);
    draw(commands);
    endRendering(commands);
    commands.transition(
        *canvas_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    swapchain_->copy(commands, *canvas_, index);
    commands.orderAll();
    timestamps_->write(commands);
    commands.endLabel();
    commands.end();
    if (device_.hazards()) submission_ = device_.hazards()->submissions();
}

void Presenter::submit(std::uint32_t index) {
    const VkCommandBufferSubmitInfo buffer{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .pNext = nullptr,
        .commandBuffer = buffer_,
        .deviceMask = 0};
    const VkSemaphoreSubmitInfo acquired =
        semaphoreInfo(acquired_.get(), VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    const VkSemaphoreSubmitInfo drawn =
        semaphoreInfo(swapchain_->drawn(index), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.waitSemaphoreInfoCount = 1;
    info.pWaitSemaphoreInfos = &acquired;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    info.signalSemaphoreInfoCount = 1;
    info.pSignalSemaphoreInfos = &drawn;
    check(vkQueueSubmit2(device_.queue(), 1, &info, done_.ready()), "submit the window's picture");
    pending_ = true;
    ++frames_;
}

Presenter::Picture Presenter::picture() const {
    if (!canvas_) return {};
    const Buffer bytes = readImage(device_, *canvas_, 4);
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.mapped().data());
    return {canvas_->extent().width, canvas_->extent().height, {first, first + bytes.size()}};
}

}  // namespace engine
