#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <source_location>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/barriers.h"
#include "engine/buffer_image.h"
#include "engine/hazards.h"

namespace engine {

class ComputePipeline;
class GraphicsPipeline;

// A buffer, given by any address in it, or an image, and how a command touches it.
struct Use {
    Use(std::uint64_t buffer, Access touched) : address(buffer), access(touched) {}
    Use(const Buffer& buffer, Access touched)
        : address(buffer.address()), resource(buffer.tracked()), access(touched) {}
    Use(const Image& touched_image, Access touched)
        : image(&touched_image), resource(touched_image.tracked()), access(touched) {}

    std::uint64_t address = 0;
    const Image* image = nullptr;
    std::optional<TrackedResources::Id> resource;  // absent: found by the address
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

// An image in SHADER_READ_ONLY_OPTIMAL, and the sampler to read it with.
struct SampledImage {
    const Image* image;
    const Sampler* sampler;
};

// Descriptor sets of a command buffer on devices without push descriptors; empty elsewhere.
class DescriptorSets {
public:
    explicit DescriptorSets(const Device& device) : device_(device) {}

    // Returns a new set, valid until reset().
    VkDescriptorSet allocate(VkDescriptorSetLayout layout);
    // The device must have finished the command buffer.
    void reset();
    const Device& device() const { return device_; }

private:
    using Pool = Handle<VkDescriptorPool, &vkDestroyDescriptorPool>;

    const Device& device_;
    std::vector<Pool> pools_;
    std::size_t allocated_ = 0;  // sets since reset()
};

// A command buffer being recorded. Borrows the buffer and its sets. Its barriers follow from what
// commands touch (engine/barriers.h): each stands in front of the first command that needs it.
class Commands {
public:
    // `hazards`: log of everything that is recorded; null: none.
    Commands(
        VkCommandBuffer buffer, DescriptorSets& sets, HazardLog* hazards = nullptr,
        QueueKind queue = QueueKind::all)
        : buffer_(buffer), sets_(sets), hazards_(hazards), queue_(queue),
          plan_(sets.device().barriers(queue)) {}
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;
    ~Commands();

    VkCommandBuffer get() const { return buffer_; }
    // The device must have finished the earlier recording.
    void begin();
    // Ends the recording, which must be submitted next.
    void end();

    // Orders everything before against everything after, also what no command declares. For
    // measurements, and for commands that are recorded elsewhere.
    void orderAll(const std::source_location& place = std::source_location::current());

    // Moves an image from one layout to another, in front of the next command. UNDEFINED as `from`
    // discards the contents.
    void transition(
        const Image& image, VkImageLayout from, VkImageLayout to,
        const std::source_location& place = std::source_location::current());

    // Declares what the next dispatch, draws or rendering touch: all buffers that a frame's
    // commands write and that they read or write. Barriers follow from this, so what is not
    // declared is not ordered. Buffers that only the host or set-up writes need no declaration.
    // Images bound by images() or rendered to, and operands of copies and fills, are known. Every
    // dispatch of a pass needs a declaration. Its uses don't depend on one another.
    void uses(
        std::initializer_list<Use> uses,
        const std::source_location& place = std::source_location::current());

    // Declares one use and returns the buffer's address for push constants, so that no address is
    // pushed without its use.
    std::uint64_t
    use(const Use& used, const std::source_location& place = std::source_location::current()) {
        uses({used}, place);
        return used.address;
    }
    // Declares that the next dispatch reads the buffer, or writes it, and returns its address.
    template <class Buffer>
    std::uint64_t reads(
        const Buffer& buffer, const std::source_location& place = std::source_location::current()) {
        return use({buffer, Access::compute_read}, place);
    }
    template <class Buffer>
    std::uint64_t writes(
        const Buffer& buffer, const std::source_location& place = std::source_location::current()) {
        return use({buffer, Access::compute_write}, place);
    }

    // Declares for the next dispatch what the last one touched, because it is another part of it.
    void usesAgain();

    // Records the barrier that the declared uses need. Only for commands that are recorded by the
    // Vulkan function itself.
    void order();

    // Between these a barrier is impossible. So everything that earlier compute, transfers and
    // fragments wrote is made visible in front, with what was declared.
    void beginRendering(const VkRenderingInfo& info);
    void endRendering();

    void copy(
        const Buffer& source, const Buffer& destination, std::size_t bytes,
        const std::source_location& place = std::source_location::current());
    // Copies between images of equal size, from TRANSFER_SRC_OPTIMAL to TRANSFER_DST_OPTIMAL.
    void copy(
        const Image& source, const Image& destination,
        const std::source_location& place = std::source_location::current());
    // Copies an image in TRANSFER_SRC_OPTIMAL into tightly packed pixels.
    void copy(
        const Image& source, const Buffer& destination,
        const std::source_location& place = std::source_location::current());
    // Copies tightly packed pixels into a level of an image in TRANSFER_DST_OPTIMAL.
    void copy(
        const Buffer& source, std::size_t offset, const Image& destination, std::uint32_t level,
        const std::source_location& place = std::source_location::current());
    void fill(
        const Buffer& buffer, std::uint32_t value,
        const std::source_location& place = std::source_location::current());
    // Writes bytes, stored in the command buffer itself, to the start of a buffer; whole 4-byte
    // words.
    void write(
        const Buffer& buffer, std::span<const std::byte> bytes,
        const std::source_location& place = std::source_location::current());

    // Binds a pipeline, with the push constants of its next dispatch or draws.
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

    // Binds images to the bound compute pipeline: sampled ones in SHADER_READ_ONLY_OPTIMAL from
    // binding 0 on, then storage ones in GENERAL.
    void images(
        const ComputePipeline& pipeline, std::span<const Image* const> sampled,
        std::span<const Image* const> storage);

    // Binds images to the bound pipeline from binding 0 on, then texel buffers. The TexelViews must
    // not move until the commands have run: lavapipe keeps pointers to their handles.
    void images(
        const ComputePipeline& pipeline, std::span<const SampledImage> sampled,
        std::span<const TexelView* const> texels = {});
    void images(
        const GraphicsPipeline& pipeline, std::span<const SampledImage> sampled,
        std::span<const TexelView* const> texels = {});

    void dispatch(std::uint32_t groups_x, std::uint32_t groups_y = 1);
    // If `groups` don't fit in one row, shaders count them row by row, and the last row may have
    // surplus work groups.
    void dispatchGroups(std::uint32_t groups);
    // Dispatches enough work groups of `size` invocations for `invocations`; none for 0.
    void dispatchInvocations(std::uint32_t invocations, std::uint32_t size);
    void draw(const Draw& draw);
    void drawIndexed(const Buffer& indices, const IndexedDraw& draw);
    // Indirect draws: `arguments` holds `draws` VkDrawIndexedIndirectCommand structs.
    void drawIndexed(const Buffer& indices, const Buffer& arguments, std::uint32_t draws);
    // Draws task work groups, counted as in dispatchGroups().
    void drawMeshTasks(std::uint32_t groups);

    void beginLabel(const char* name);
    void endLabel();

private:
    void record(const PlannedBarrier& barrier);
    // Forgets the uses of a command that has nothing to do.
    void withdraw();
    void touch(std::initializer_list<Use> operands, const std::source_location& place);
    void declarePushed(const std::vector<ResourceId>& pushed, Access access);
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
    BarrierPlan& plan_;
    struct LayoutChange {
        const Image* image;
        VkImageLayout from;
        VkImageLayout to;
    };
    static constexpr std::size_t kMostChanges = 8;
    std::array<LayoutChange, kMostChanges> changes_{};  // in front of the next command
    std::size_t change_count_ = 0;
    bool is_open_ = false;  // between begin() and end()
    bool is_nested_ = false;  // another recording for the queue was open at begin()
    bool renders_ = false;
    // For the hazard checker:
    std::source_location place_;  // of the last declaration
    std::vector<RecordedUse> declared_uses_;  // of the next command
    std::vector<RecordedUse> last_uses_;  // of the last one
    Recording recording_;
    std::string pass_;
    std::vector<ResourceId> declared_;  // since the last dispatch
    std::vector<ResourceId> pushed_;  // buffers written by the frame that the last push constants
                                      // lead to
};

}  // namespace engine
