#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "engine/buffer_image.h"

namespace engine {

class ComputePipeline;
class GraphicsPipeline;

// Who touched memory before a barrier and who will after it.
enum class Access {
    compute_read,
    compute_write,
    graphics_read,  // buffers and images read by any graphics stage
    fragment_write,  // buffers read and written by the fragment stage
    attachment,     // color and depth attachments, read and written
    transfer_read,
    transfer_write,
    host_read,
    anything,
};

struct Draw {
    std::uint32_t vertices = 0;
    std::uint32_t instances = 1;
    std::uint32_t first_vertex = 0;
    std::uint32_t first_instance = 0;
};

// An image in SHADER_READ_ONLY_OPTIMAL, and how it is sampled.
struct SampledImage {
    const Image* image;
    const Sampler* sampler;
};

// A command buffer being recorded. Borrows the buffer; adds no barrier by itself.
class Commands {
public:
    explicit Commands(VkCommandBuffer buffer) : buffer_(buffer) {}

    VkCommandBuffer get() const { return buffer_; }
    void begin();
    void end();

    // Makes what happened `before` visible to what comes `after`, for all memory.
    void barrier(Access before, Access after);

    // A barrier that moves an image from one layout to another. UNDEFINED as `from` discards what
    // the image holds.
    void transition(
        const Image& image, VkImageLayout from, VkImageLayout to, Access before, Access after);

    void copy(const Buffer& source, const Buffer& destination, std::size_t bytes);
    // Between images of one size, from TRANSFER_SRC_OPTIMAL to TRANSFER_DST_OPTIMAL.
    void copy(const Image& source, const Image& destination);
    // An image in TRANSFER_SRC_OPTIMAL into tightly packed pixels.
    void copy(const Image& source, const Buffer& destination);
    // Tightly packed pixels into a level of an image in TRANSFER_DST_OPTIMAL.
    void
    copy(const Buffer& source, std::size_t offset, const Image& destination, std::uint32_t level);
    void fill(const Buffer& buffer, std::uint32_t value);

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

    // Gives the bound graphics pipeline its images, at bindings 0 ...
    void images(const GraphicsPipeline& pipeline, std::span<const SampledImage> sampled);

    void dispatch(std::uint32_t groups_x, std::uint32_t groups_y = 1);
    void draw(const Draw& draw);
    void drawIndexed(const Buffer& indices, std::uint32_t first, std::uint32_t count);

    void beginLabel(const char* name);
    void endLabel();

private:
    void bindCompute(const ComputePipeline& pipeline, std::span<const std::byte> push);
    void bindGraphics(const GraphicsPipeline& pipeline, std::span<const std::byte> push);

    VkCommandBuffer buffer_;
};

}  // namespace engine
