#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <source_location>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/hazards.h"

namespace engine {

class ComputePipeline;
class GraphicsPipeline;

// Who touches memory: a command, or what comes before a barrier and after it.
enum class Access {
    compute_read,
    compute_write,  // read, too
    graphics_read,  // buffers and images read by any graphics stage
    indirect_read,  // a draw's arguments
    vertex_read,  // buffers read by the stages before the rasteriser: vertex to geometry, or task
                  // and mesh
    fragment_read,  // buffers and images read by the fragment stage
    shading_read,  // images read where something is shaded: by the fragment stage or by compute
    fragment_write,  // buffers read and written by the fragment stage
    attachment,  // color and depth attachments, read and written
    transfer_read,
    transfer_write,
    host_read,
    anything,
};

// What happened `before` is made visible to what comes `after`.
struct Dependency {
    Access before;
    Access after;
};

// A buffer, by any address in it, or an image, and how a command touches it.
struct Use {
    Use(std::uint64_t buffer, Access touched) : address(buffer), access(touched) {}
    Use(const Buffer& buffer, Access touched) : Use(buffer.address(), touched) {}
    Use(const Image& touched_image, Access touched) : image(&touched_image), access(touched) {}

    std::uint64_t address = 0;
    const Image* image = nullptr;
    Access access;
};

struct Draw {
    std::uint32_t vertices = 0;
    std::uint32_t instances = 1;
    std::uint32_t first_vertex = 0;
    std::uint32_t first_instance = 0;
};

struct IndexedDraw {
    std::uint32_t indices = 0;
    std::uint32_t instances = 1;
    std::uint32_t first_index = 0;
    std::uint32_t first_instance = 0;
};

// An image in SHADER_READ_ONLY_OPTIMAL, and how it is sampled.
struct SampledImage {
    const Image* image;
    const Sampler* sampler;
};

// The descriptor sets that a command buffer uses on devices without push descriptors; elsewhere it
// stays empty.
class DescriptorSets {
public:
    explicit DescriptorSets(const Device& device) : device_(device) {}

    // A new set, valid until reset().
    VkDescriptorSet allocate(VkDescriptorSetLayout layout);
    // The device must be done with the command buffer.
    void reset();
    const Device& device() const { return device_; }

private:
    using Pool = Handle<VkDescriptorPool, &vkDestroyDescriptorPool>;

    const Device& device_;
    std::vector<Pool> pools_;
    std::size_t allocated_ = 0;  // sets since reset()
};

// Which commands a queue takes.
enum class QueueKind {
    all,
    compute,  // no graphics: barriers leave out its stages, whose commands others order
};

// A command buffer being recorded. Borrows the buffer and its sets; adds no barrier by itself.
class Commands {
public:
    // `hazards`: who is told of all that is recorded; null: nobody.
    Commands(
        VkCommandBuffer buffer, DescriptorSets& sets, HazardLog* hazards = nullptr,
        QueueKind queue = QueueKind::all)
        : buffer_(buffer), sets_(sets), hazards_(hazards), queue_(queue) {}

    VkCommandBuffer get() const { return buffer_; }
    // The device must be done with what was recorded before.
    void begin();
    // What was recorded is submitted next.
    void end();

    // Makes what happened `before` visible to what comes `after`, for all memory.
    void barrier(
        Access before, Access after,
        const std::source_location& place = std::source_location::current()) {
        barrier({{before, after}}, place);
    }
    void barrier(
        std::initializer_list<Dependency> dependencies,
        const std::source_location& place = std::source_location::current());

    // A barrier that moves an image from one layout to another. UNDEFINED as `from` discards what
    // the image holds.
    void transition(
        const Image& image, VkImageLayout from, VkImageLayout to, Access before, Access after,
        const std::source_location& place = std::source_location::current());

    // Says what the dispatch or the draws that are recorded next touch, for those who look for
    // missing barriers (engine/hazards.h): all buffers that a frame's commands write and that these
    // read or write. Buffers that only the host writes need no mention. Images that are bound by
    // images() or rendered to, and what copies and fills touch, are known. Every dispatch of a pass
    // needs it; its uses don't depend on one another.
    void uses(std::initializer_list<Use> uses) {
        if (hazards_) declare(uses);
    }

    void copy(const Buffer& source, const Buffer& destination, std::size_t bytes);
    // Between images of one size, from TRANSFER_SRC_OPTIMAL to TRANSFER_DST_OPTIMAL.
    void copy(const Image& source, const Image& destination);
    // An image in TRANSFER_SRC_OPTIMAL into tightly packed pixels.
    void copy(const Image& source, const Buffer& destination);
    // Tightly packed pixels into a level of an image in TRANSFER_DST_OPTIMAL.
    void
    copy(const Buffer& source, std::size_t offset, const Image& destination, std::uint32_t level);
    void fill(const Buffer& buffer, std::uint32_t value);
    // Bytes that the command buffer itself keeps, to a buffer's start; whole words of 4 bytes.
    void write(const Buffer& buffer, std::span<const std::byte> bytes);

    // Pipelines are bound with the constants that their next dispatch or draws use.
    void bind(const ComputePipeline& pipeline);
    template <class Push>
    void bind(const ComputePipeline& pipeline, const Push& push) {
        static_assert(std::is_trivially_copyable_v<Push> && sizeof(Push) <= 128);
        bindCompute(pipeline, std::as_bytes(std::span(&push, 1)));
    }
    template <class Push>
    void bind(const GraphicsPipeline& pipeline, const Push& push) {
        static_assert(std::is_trivially_copyable_v<Push> && sizeof(Push) <= 128);
        bindGraphics(pipeline, std::as_bytes(std::span(&push, 1)));
    }

    // Gives the bound compute pipeline its images: sampled ones in SHADER_READ_ONLY_OPTIMAL at
    // bindings 0.., then storage ones in GENERAL.
    void images(
        const ComputePipeline& pipeline, std::span<const Image* const> sampled,
        std::span<const Image* const> storage);

    // Gives the bound pipeline its images, at bindings 0 ..., then its texel buffers, which stay
    // where they are until the commands have run: lavapipe keeps the place of their handles.
    void images(
        const ComputePipeline& pipeline, std::span<const SampledImage> sampled,
        std::span<const TexelView* const> texels = {});
    void images(
        const GraphicsPipeline& pipeline, std::span<const SampledImage> sampled,
        std::span<const TexelView* const> texels = {});

    void dispatch(std::uint32_t groups_x, std::uint32_t groups_y = 1);
    // Where more workgroups are needed than fit in a row, shaders count them row by row, and the
    // last row may have some too many.
    void dispatchGroups(std::uint32_t groups);
    // As many workgroups of `size` invocations as `invocations` need; none for 0.
    void dispatchInvocations(std::uint32_t invocations, std::uint32_t size);
    void draw(const Draw& draw);
    void drawIndexed(const Buffer& indices, const IndexedDraw& draw);
    // Draws whose arguments are so many VkDrawIndexedIndirectCommand in a buffer.
    void drawIndexed(const Buffer& indices, const Buffer& arguments, std::uint32_t draws);
    // Task workgroups, counted as dispatchGroups() does.
    void drawMeshTasks(std::uint32_t groups);

    void beginLabel(const char* name);
    void endLabel();

private:
    void touch(std::initializer_list<Use> uses);
    void declare(std::initializer_list<Use> uses);
    void declareHanded(const std::vector<ResourceId>& handed, Access access);
    void checkDeclared();
    void bindCompute(const ComputePipeline& pipeline, std::span<const std::byte> push);
    void bindGraphics(const GraphicsPipeline& pipeline, std::span<const std::byte> push);
    void bindImages(
        VkPipelineBindPoint point, VkPipelineLayout layout, VkDescriptorSetLayout set_layout,
        std::span<VkWriteDescriptorSet> writes);
    void bindSampled(
        VkPipelineBindPoint point, VkPipelineLayout layout, VkDescriptorSetLayout set_layout,
        std::span<const SampledImage> sampled, Access access,
        std::span<const TexelView* const> texels = {});

    VkCommandBuffer buffer_;
    DescriptorSets& sets_;
    HazardLog* hazards_;
    QueueKind queue_;
    // Where hazards are looked for:
    Recording recording_;
    std::string pass_;
    std::vector<ResourceId> declared_;  // since the last dispatch
    std::vector<ResourceId> handed_;  // buffers that frames write, in the last push constants
};

}  // namespace engine
