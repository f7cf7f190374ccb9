#include "engine/presenter.h"

#include <limits>

#include "engine/rendering.h"
#include "engine/transfer.h"

namespace engine {

namespace {

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

Presenter::Presenter(const Device& device, const Window& window, PresentMode mode)
    : device_(device), window_(window), mode_(mode),
      surface_(window.createSurface(device.instance())) {
    VkBool32 presents = VK_FALSE;
    check(
        vkGetPhysicalDeviceSurfaceSupportKHR(
            device.info().handle, device.info().queue_family, surface_, &presents),
        "ask whether the device can show pictures in a window");
    if (!presents) {
        vkDestroySurfaceKHR(device.instance(), surface_, nullptr);
        throw Error(device.info().name + " can't show pictures in a window");
    }
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
    const VkFenceCreateInfo fence{
        .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .pNext = nullptr, .flags = 0};
    VkFence fence_handle{};
    check(vkCreateFence(device.get(), &fence, nullptr, &fence_handle), "create a fence");
    done_ = {device.get(), fence_handle};
    acquired_ = makeSemaphore(device.get());
    timestamps_.emplace(device, 2);
}

Presenter::~Presenter() {
    vkQueueWaitIdle(device_.queue());
    swapchain_.reset();
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

std::uint32_t Presenter::imageCount() const {
    return swapchain_ ? static_cast<std::uint32_t>(swapchain_->imageCount()) : 2;
}

void Presenter::setMode(PresentMode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    dropSwapchain();
}

std::vector<PresentMode> Presenter::modes() const { return Swapchain::modes(device_, surface_); }

void Presenter::wait() {
    if (!pending_) return;
    pending_ = false;
    const VkFence done = done_.get();
    check(
        vkWaitForFences(
            device_.get(), 1, &done, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
        "wait for the window's picture");
    check(vkResetFences(device_.get(), 1, &done), "reset a fence");
    milliseconds_ = timestamps_->read().back();
}

void Presenter::dropSwapchain() {
    wait();
    check(vkQueueWaitIdle(device_.queue()), "wait for the device");
    swapchain_.reset();
}

// Makes the images that the window's size asks for.
bool Presenter::prepare() {
    const VkExtent2D extent = window_.pixels();
    if (extent.width == 0 || extent.height == 0) return false;
    const bool fits = swapchain_ && swapchain_->extent().width == extent.width &&
                      swapchain_->extent().height == extent.height;
    // The surface may know that it was put away before the window does.
    if (!fits && Swapchain::isEmpty(device_, surface_)) return false;
    if (!fits) {
        check(vkQueueWaitIdle(device_.queue()), "wait for the device");
        std::optional<Swapchain> old = std::exchange(swapchain_, std::nullopt);
        swapchain_.emplace(device_, surface_, extent, mode_, old ? &*old : nullptr);
        old.reset();
        drawn_.clear();
        for (std::size_t i = 0; i < swapchain_->imageCount(); ++i)
            drawn_.push_back(makeSemaphore(device_.get()));
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
                .name = "window"});
    }
    return true;
}

bool Presenter::frame(
    const std::function<void(Commands&)>& before, const std::function<void(Commands&)>& draw) {
    wait();
    // A window that is being resized may outgrow its images more than once.
    for (int attempt = 0; attempt < 3; ++attempt) {
        if (!prepare()) return false;
        const std::optional<std::uint32_t> index = swapchain_->acquire(acquired_.get());
        if (!index) {
            dropSwapchain();
            continue;
        }
        record(*index, before, draw);
        submit(*index);
        if (!swapchain_->present(*index, drawn_[*index].get())) dropSwapchain();
        return true;
    }
    return false;
}

void Presenter::record(
    std::uint32_t index, const std::function<void(Commands&)>& before,
    const std::function<void(Commands&)>& draw) {
    timestamps_->reset();
    Commands commands(buffer_);
    commands.begin();
    commands.beginLabel("ui");
    timestamps_->write(commands);
    commands.barrier(Access::anything, Access::anything);
    before(commands);
    commands.transition(
        *canvas_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        Access::transfer_read, Access::attachment);
    const Attachment canvas{.image = &*canvas_, .load = Load::clear, .clear = {0, 0, 0, 1}};
    beginRendering(commands, std::span(&canvas, 1), std::nullopt);
    draw(commands);
    endRendering(commands);
    commands.transition(
        *canvas_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
        Access::attachment, Access::transfer_read);
    swapchain_->copy(commands, *canvas_, index);
    commands.barrier(Access::anything, Access::anything);
    timestamps_->write(commands);
    commands.endLabel();
    commands.end();
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
        semaphoreInfo(drawn_[index].get(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.waitSemaphoreInfoCount = 1;
    info.pWaitSemaphoreInfos = &acquired;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    info.signalSemaphoreInfoCount = 1;
    info.pSignalSemaphoreInfos = &drawn;
    check(vkQueueSubmit2(device_.queue(), 1, &info, done_.get()), "submit the window's picture");
    pending_ = true;
}

Presenter::Picture Presenter::picture() const {
    if (!canvas_) return {};
    const Buffer bytes = readImage(device_, *canvas_, 4);
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.mapped().data());
    return {canvas_->extent().width, canvas_->extent().height, {first, first + bytes.size()}};
}

}  // namespace engine
