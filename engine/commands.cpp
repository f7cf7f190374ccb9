#include "engine/commands.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/pipeline.h"

namespace engine {
namespace {

constexpr Scope kColorAttachment{
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

constexpr Scope kDepthAttachment{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

// Stages and accesses of a use. An attachment has only the stages of its own aspect, colour or
// depth.
Scope scopeOf(const Use& use) {
    if (use.access != Access::attachment) return scopeOf(use.access);
    return use.image->aspect() == VK_IMAGE_ASPECT_DEPTH_BIT ? kDepthAttachment : kColorAttachment;
}

std::string textOf(const std::source_location& place) {
    const std::string_view path = place.file_name();
    return std::string(path.substr(path.rfind('/') + 1)) + ":" + std::to_string(place.line());
}

// Work groups in a row of compute and task dispatches: the guaranteed minimum of the limit.
constexpr std::uint32_t kMostGroupsInRow = 65535;

// Sets per pool, and images of each kind per set: more than a set has bindings.
constexpr std::uint32_t kSetsPerPool = 64;
constexpr std::uint32_t kImagesPerSet = 8;

// Descriptor writes of a set, one per binding, in binding order.
class ImageWrites {
public:
    void add(VkDescriptorType type, const VkDescriptorImageInfo& info) {
        assert(count_ < kImagesPerSet);
        infos_[count_] = info;
        add(type).pImageInfo = &infos_[count_];
        ++count_;
    }
    void add(const TexelView& view) {
        assert(count_ < kImagesPerSet);
        add(VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER).pTexelBufferView = view.place();
        ++count_;
    }
    std::span<VkWriteDescriptorSet> all() { return std::span(writes_).first(count_); }

private:
    VkWriteDescriptorSet& add(VkDescriptorType type) {
        return writes_[count_] = {
                   .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                   .pNext = nullptr,
                   .dstSet = VK_NULL_HANDLE,
                   .dstBinding = count_,
                   .dstArrayElement = 0,
                   .descriptorCount = 1,
                   .descriptorType = type,
                   .pImageInfo = nullptr,
                   .pBufferInfo = nullptr,
                   .pTexelBufferView = nullptr};
    }

    std::uint32_t count_ = 0;
    std::array<VkDescriptorImageInfo, kImagesPerSet> infos_;
    std::array<VkWriteDescriptorSet, kImagesPerSet> writes_;
};

}  // namespace

// ---- Descriptor sets ----------------------------------------------------------------------------

VkDescriptorSet DescriptorSets::allocate(VkDescriptorSetLayout layout) {
    if (allocated_ == pools_.size() * kSetsPerPool) {
        constexpr std::uint32_t kImages = kSetsPerPool * kImagesPerSet;
        constexpr std::array sizes{
            VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kImages},
            VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kImages},
            VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kImages},
            VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kImages}};
        const VkDescriptorPoolCreateInfo create{
            .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
            .pNext = nullptr,
            .flags = 0,
            .maxSets = kSetsPerPool,
            .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
            .pPoolSizes = sizes.data()};
        VkDescriptorPool pool{};
        check(
            vkCreateDescriptorPool(device_.get(), &create, nullptr, &pool),
            "create a descriptor pool");
        pools_.emplace_back(device_.get(), pool);
    }
    const VkDescriptorSetAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .pNext = nullptr,
        .descriptorPool = pools_[allocated_ / kSetsPerPool].get(),
        .descriptorSetCount = 1,
        .pSetLayouts = &layout};
    VkDescriptorSet set{};
    check(vkAllocateDescriptorSets(device_.get(), &allocate, &set), "allocate a descriptor set");
    ++allocated_;
    return set;
}

void DescriptorSets::reset() {
    for (const Pool& pool : pools_)
        check(vkResetDescriptorPool(device_.get(), pool.get(), 0), "reset a descriptor pool");
    allocated_ = 0;
}

// ---- Commands -----------------------------------------------------------------------------------

Commands::~Commands() {
    if (!is_open_) return;
    // The recording is not submitted, so its barriers order nothing.
    --plan_.open;
    plan_.forgetOrder();
}

void Commands::begin() {
    sets_.reset();
    const VkCommandBufferBeginInfo info{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .pNext = nullptr,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
        .pInheritanceInfo = nullptr};
    check(vkBeginCommandBuffer(buffer_, &info), "begin a command buffer");
    is_nested_ = plan_.open++ > 0;
    is_open_ = true;
}

void Commands::end() {
    order();
    check(vkEndCommandBuffer(buffer_), "end a command buffer");
    --plan_.open;
    is_open_ = false;
    // Submitted before commands that were recorded earlier.
    if (is_nested_) plan_.forgetOrder();
    if (hazards_) hazards_->submit(std::exchange(recording_, {}), queue_);
}

// ---- Barriers -----------------------------------------------------------------------------------

void Commands::uses(std::initializer_list<Use> uses, const std::source_location& place) {
    place_ = place;
    for (const Use& use : uses) {
        if (!use.image && use.address == 0) continue;
        const std::optional<TrackedResources::Id> id =
            use.resource ? use.resource : sets_.device().resources().bufferAt(use.address);
        if (!id) {
            if (hazards_) hazards_->complain(pass_, "declares an address outside all buffers");
            continue;
        }
        plan_.require(*id, use.access);
        if (!hazards_) continue;
        const Scope touched = scopeOf(use);
        declared_.push_back(*id);
        const auto same = std::ranges::find(declared_uses_, *id, &RecordedUse::resource);
        if (same == declared_uses_.end()) {
            declared_uses_.push_back({*id, touched});
        } else {
            same->scope.stages |= touched.stages;
            same->scope.access |= touched.access;
        }
    }
}

void Commands::usesAgain() {
    plan_.requireAgain();
    declared_uses_ = last_uses_;
    for (const RecordedUse& use : last_uses_) declared_.push_back(use.resource);
}

void Commands::transition(
    const Image& image, VkImageLayout from, VkImageLayout to, const std::source_location& place) {
    place_ = place;
    if (change_count_ == kMostChanges) record(*plan_.take());
    plan_.change(image.tracked(), to);
    changes_[change_count_++] = {&image, from, to};
}

void Commands::order() {
    if (plan_.isNeeded()) {
        if (!renders_)
            record(*plan_.take());
        else if (hazards_)
            hazards_->complain(pass_, "a draw needs a barrier, which a rendering can't hold");
    }
    plan_.commit();
    if (!declared_uses_.empty()) {
        last_uses_ = std::exchange(declared_uses_, {});
        recording_.push_back({.pass = pass_, .uses = last_uses_, .barriers = {}});
    }
}

void Commands::record(const PlannedBarrier& planned) {
    PlannedBarrier barrier = planned;
    if (hazards_) {
        // Layouts change even if the barrier is dropped.
        const std::string place = textOf(place_);
        if (hazards_->isDropped(pass_, place)) barrier = {};
        std::vector<RecordedBarrier> recorded;
        for (const Dependency& each : {barrier.shaders, barrier.drawing})
            if (each.before.stages != 0)
                recorded.push_back(
                    {.before = each.before, .after = each.after, .image = {}, .place = place});
        for (const LayoutChange& change : std::span(changes_).first(change_count_))
            recorded.push_back(
                {.before = barrier.layouts.before,
                 .after = barrier.layouts.after,
                 .image = change.image->tracked(),
                 .transitions_layout = true,
                 .place = place});
        recording_.push_back({.pass = pass_, .uses = {}, .barriers = std::move(recorded)});
    }
    std::array<VkMemoryBarrier2, 2> memory;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.pMemoryBarriers = memory.data();
    for (const Dependency& each : {barrier.shaders, barrier.drawing})
        if (each.before.stages != 0)
            memory[info.memoryBarrierCount++] = {
                .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                .pNext = nullptr,
                .srcStageMask = each.before.stages,
                .srcAccessMask = each.before.access,
                .dstStageMask = each.after.stages,
                .dstAccessMask = each.after.access};
    std::array<VkImageMemoryBarrier2, kMostChanges> images;
    info.pImageMemoryBarriers = images.data();
    for (const LayoutChange& change : std::span(changes_).first(change_count_))
        images[info.imageMemoryBarrierCount++] = {
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .pNext = nullptr,
            .srcStageMask = barrier.layouts.before.stages,
            .srcAccessMask = barrier.layouts.before.access,
            .dstStageMask = barrier.layouts.after.stages,
            .dstAccessMask = barrier.layouts.after.access,
            .oldLayout = change.from,
            .newLayout = change.to,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = change.image->get(),
            .subresourceRange = {change.image->aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, 1}};
    if (info.memoryBarrierCount + info.imageMemoryBarrierCount > 0)
        vkCmdPipelineBarrier2(buffer_, &info);
    change_count_ = 0;
}

void Commands::orderAll(const std::source_location& place) {
    assert(!renders_);
    place_ = place;
    if (change_count_ > 0) order();
    const VkMemoryBarrier2 memory{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .pNext = nullptr,
        .srcStageMask = kEverything.stages,
        .srcAccessMask = kEverything.access,
        .dstStageMask = kEverything.stages,
        .dstAccessMask = kEverything.access};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &memory;
    vkCmdPipelineBarrier2(buffer_, &info);
    plan_.orderedAll();
    if (hazards_)
        recording_.push_back(
            {.pass = pass_,
             .uses = {},
             .barriers = {
                 {.before = kEverything,
                  .after = kEverything,
                  .image = {},
                  .place = textOf(place_)}}});
}

void Commands::beginRendering(const VkRenderingInfo& info) {
    plan_.requireForRendering();
    order();
    renders_ = true;
    vkCmdBeginRendering(buffer_, &info);
}

void Commands::endRendering() {
    order();
    renders_ = false;
    vkCmdEndRendering(buffer_);
}

// ---- Declared uses ------------------------------------------------------------------------------

// Declares the host-written buffers that push constants lead to.
void Commands::declarePushed(const std::vector<ResourceId>& pushed, Access access) {
    if (pushed.empty()) return;
    Recorded& recorded = recording_.emplace_back();
    recorded.pass = pass_;
    for (const ResourceId id : pushed) recorded.uses.push_back({id, scopeOf(access)});
}

void Commands::checkDeclared() {
    if (!pass_.empty()) {
        if (declared_.empty())
            hazards_->complain(pass_, "a dispatch declares no use of a resource");
        for (const ResourceId id : pushed_)
            if (std::ranges::find(declared_, id) == declared_.end())
                hazards_->complain(
                    pass_,
                    "a dispatch gets '" + hazards_->name(id) + "' but declares no use of it");
    }
    declared_.clear();
}

// ---- Copies and fills ---------------------------------------------------------------------------

// Operands of a copy or fill.
void Commands::touch(std::initializer_list<Use> operands, const std::source_location& place) {
    if (!declared_uses_.empty())
        hazards_->complain(pass_, "a copy or fill comes between uses and their command");
    uses(operands, place);
    declared_.clear();
    order();
}

void Commands::copy(
    const Buffer& source, const Buffer& destination, std::size_t bytes,
    const std::source_location& place) {
    touch({{source, Access::transfer_read}, {destination, Access::transfer_write}}, place);
    const VkBufferCopy region{.srcOffset = 0, .dstOffset = 0, .size = bytes};
    vkCmdCopyBuffer(buffer_, source.get(), destination.get(), 1, &region);
}

void Commands::copy(
    const Image& source, const Buffer& destination, const std::source_location& place) {
    touch({{source, Access::transfer_read}, {destination, Access::transfer_write}}, place);
    const VkExtent2D extent = source.extent();
    const VkBufferImageCopy region{
        .bufferOffset = 0,
        .bufferRowLength = 0,
        .bufferImageHeight = 0,
        .imageSubresource = {source.aspect(), 0, 0, 1},
        .imageOffset = {0, 0, 0},
        .imageExtent = {extent.width, extent.height, 1}};
    vkCmdCopyImageToBuffer(
        buffer_, source.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, destination.get(), 1, &region);
}

void Commands::copy(
    const Image& source, const Image& destination, const std::source_location& place) {
    touch({{source, Access::transfer_read}, {destination, Access::transfer_write}}, place);
    const VkExtent2D extent = source.extent();
    const VkImageCopy region{
        .srcSubresource = {source.aspect(), 0, 0, 1},
        .srcOffset = {0, 0, 0},
        .dstSubresource = {destination.aspect(), 0, 0, 1},
        .dstOffset = {0, 0, 0},
        .extent = {extent.width, extent.height, 1}};
    vkCmdCopyImage(
        buffer_, source.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, destination.get(),
        VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::copy(
    const Buffer& source, std::size_t offset, const Image& destination, std::uint32_t level,
    const std::source_location& place) {
    // Levels are written one after the other, each once, so the first stands for all.
    if (level == 0)
        touch({{source, Access::transfer_read}, {destination, Access::transfer_write}}, place);
    const VkExtent2D extent = destination.extent();
    const VkBufferImageCopy region{
        .bufferOffset = offset,
        .bufferRowLength = 0,
        .bufferImageHeight = 0,
        .imageSubresource = {destination.aspect(), level, 0, 1},
        .imageOffset = {0, 0, 0},
        .imageExtent = {
            std::max(extent.width >> level, 1u), std::max(extent.height >> level, 1u), 1}};
    vkCmdCopyBufferToImage(
        buffer_, source.get(), destination.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::fill(const Buffer& buffer, std::uint32_t value, const std::source_location& place) {
    touch({{buffer, Access::transfer_write}}, place);
    vkCmdFillBuffer(buffer_, buffer.get(), 0, VK_WHOLE_SIZE, value);
}

void Commands::write(
    const Buffer& buffer, std::span<const std::byte> bytes, const std::source_location& place) {
    constexpr std::size_t kMost = 65536;  // limit of vkCmdUpdateBuffer
    assert(bytes.size() % 4 == 0 && bytes.size() <= buffer.size());
    touch({{buffer, Access::transfer_write}}, place);
    for (std::size_t first = 0; first < bytes.size(); first += kMost) {
        const auto part = bytes.subspan(first, std::min(kMost, bytes.size() - first));
        vkCmdUpdateBuffer(buffer_, buffer.get(), first, part.size(), part.data());
    }
}

// ---- Dispatches and draws -----------------------------------------------------------------------

void Commands::images(
    const ComputePipeline& pipeline, std::span<const Image* const> sampled,
    std::span<const Image* const> storage) {
    for (const Image* image : sampled) uses({{*image, Access::compute_read}}, place_);
    for (const Image* image : storage) uses({{*image, Access::compute_write}}, place_);
    ImageWrites writes;
    for (const Image* image : sampled)
        writes.add(
            VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
            {VK_NULL_HANDLE, image->view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    for (const Image* image : storage)
        writes.add(
            VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
            {VK_NULL_HANDLE, image->view(), VK_IMAGE_LAYOUT_GENERAL});
    bindImages(
        VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), pipeline.imagesLayout(), writes.all());
}

void Commands::images(
    const ComputePipeline& pipeline, std::span<const SampledImage> sampled,
    std::span<const TexelView* const> texels) {
    bindSampled(
        VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), pipeline.imagesLayout(), sampled,
        Access::compute_read, texels);
}

void Commands::images(
    const GraphicsPipeline& pipeline, std::span<const SampledImage> sampled,
    std::span<const TexelView* const> texels) {
    bindSampled(
        VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout(), pipeline.imagesLayout(), sampled,
        Access::fragment_read, texels);
}

void Commands::bindSampled(
    VkPipelineBindPoint point, VkPipelineLayout layout, VkDescriptorSetLayout set_layout,
    std::span<const SampledImage> sampled, Access access,
    std::span<const TexelView* const> texels) {
    if (sampled.empty() && texels.empty()) return;
    for (const SampledImage& entry : sampled) uses({{*entry.image, access}}, place_);
    ImageWrites writes;
    for (const SampledImage& entry : sampled)
        writes.add(
            VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            {entry.sampler->get(), entry.image->view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    for (const TexelView* view : texels) writes.add(*view);
    bindImages(point, layout, set_layout, writes.all());
}

void Commands::bindImages(
    VkPipelineBindPoint point, VkPipelineLayout layout, VkDescriptorSetLayout set_layout,
    std::span<VkWriteDescriptorSet> writes) {
    const Device& device = sets_.device();
    const auto count = static_cast<std::uint32_t>(writes.size());
    if (device.has(Feature::push_descriptors)) {
        vkCmdPushDescriptorSetKHR(buffer_, point, layout, 0, count, writes.data());
        return;
    }
    const VkDescriptorSet set = sets_.allocate(set_layout);
    for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
    vkUpdateDescriptorSets(device.get(), count, writes.data(), 0, nullptr);
    vkCmdBindDescriptorSets(buffer_, point, layout, 0, 1, &set, 0, nullptr);
}

void Commands::dispatch(std::uint32_t groups_x, std::uint32_t groups_y) {
    if (hazards_) checkDeclared();
    order();
    vkCmdDispatch(buffer_, groups_x, groups_y, 1);
}

void Commands::withdraw() {
    plan_.withdraw();
    declared_uses_.clear();
    declared_.clear();
}

void Commands::dispatchGroups(std::uint32_t groups) {
    if (groups == 0) return withdraw();
    const std::uint32_t columns = std::min(groups, kMostGroupsInRow);
    dispatch(columns, (groups + columns - 1) / columns);
}

void Commands::dispatchInvocations(std::uint32_t invocations, std::uint32_t size) {
    dispatchGroups((invocations + size - 1) / size);
}

void Commands::draw(const Draw& draw) {
    order();
    vkCmdDraw(buffer_, draw.vertices, draw.instances, draw.first_vertex, draw.first_instance);
}

void Commands::drawIndexed(const Buffer& indices, const IndexedDraw& draw) {
    order();
    vkCmdBindIndexBuffer(buffer_, indices.get(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(
        buffer_, draw.indices, draw.instances, draw.first_index, 0, draw.first_instance);
}

void Commands::drawIndexed(const Buffer& indices, const Buffer& arguments, std::uint32_t draws) {
    uses({{arguments, Access::indirect_read}}, place_);
    order();
    vkCmdBindIndexBuffer(buffer_, indices.get(), 0, VK_INDEX_TYPE_UINT32);
    constexpr std::uint32_t kStride = sizeof(VkDrawIndexedIndirectCommand);
    const Device& device = sets_.device();
    const std::uint32_t at_once =
        device.has(Feature::multi_draw) ? device.info().limits.maxDrawIndirectCount : 1;
    for (std::uint32_t first = 0; first < draws; first += at_once)
        vkCmdDrawIndexedIndirect(
            buffer_, arguments.get(), VkDeviceSize{first} * kStride,
            std::min(at_once, draws - first), kStride);
}

void Commands::drawMeshTasks(std::uint32_t groups) {
    if (groups == 0) return withdraw();
    order();
    const std::uint32_t columns = std::min(groups, kMostGroupsInRow);
    vkCmdDrawMeshTasksEXT(buffer_, columns, (groups + columns - 1) / columns, 1);
}

void Commands::beginLabel(const char* name) {
    if (hazards_) {
        pass_ = name;
        declared_.clear();
    }
    if (!vkCmdBeginDebugUtilsLabelEXT) return;
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = name;
    vkCmdBeginDebugUtilsLabelEXT(buffer_, &label);
}

void Commands::endLabel() {
    if (hazards_) pass_.clear();
    if (vkCmdEndDebugUtilsLabelEXT) vkCmdEndDebugUtilsLabelEXT(buffer_);
}

void Commands::bind(const ComputePipeline& pipeline) {
    if (hazards_) pushed_.clear();
    vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
}

void Commands::bindCompute(const ComputePipeline& pipeline, std::span<const std::byte> push) {
    bind(pipeline);
    if (hazards_) {
        declarePushed(hazards_->hostBuffersIn(push), Access::compute_read);
        pushed_ = hazards_->writtenBuffersIn(push);
    }
    vkCmdPushConstants(
        buffer_, pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
        static_cast<std::uint32_t>(push.size()), push.data());
}

void Commands::bindGraphics(const GraphicsPipeline& pipeline, std::span<const std::byte> push) {
    if (hazards_) declarePushed(hazards_->hostBuffersIn(push), Access::graphics_read);
    vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    vkCmdPushConstants(
        buffer_, pipeline.layout(), pipeline.pushStages(), 0,
        static_cast<std::uint32_t>(push.size()), push.data());
}

}  // namespace engine
