#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/device.h"

// Compute and graphics pipelines from descriptions, and what SPIR-V says of itself.
namespace engine {

// A specialization constant: the id that shaders declare it with, and its value's 32 bits. A value
// of a type other than these is ambiguous and does not compile.
struct Constant {
    constexpr Constant(std::uint32_t constant, std::uint32_t value) : id(constant), bits(value) {}
    constexpr Constant(std::uint32_t constant, bool value) : id(constant), bits(value ? 1 : 0) {}
    constexpr Constant(std::uint32_t constant, float value)
        : id(constant), bits(std::bit_cast<std::uint32_t>(value)) {}

    std::uint32_t id;
    std::uint32_t bits;
};

// Constants of different ids, in any order. Those that a shader does not declare are no error;
// those that are missing keep the shader's default.
using Constants = std::vector<Constant>;

struct ShaderExtension;
using ShaderExtensions = std::vector<std::shared_ptr<const ShaderExtension>>;

struct ComputeDescription {
    std::string shader;  // path under shaders/, e.g. "simulation/wind.comp"
    Constants constants;
    ShaderExtensions extensions{};  // shaders.h: of those that the shader calls
    std::uint32_t push_size = 0;  // B
    // Either images with their samplers, at bindings 0 .., or sampled ones without and storage ones
    // after them.
    std::uint32_t combined_images = 0;
    std::uint32_t sampled_images = 0;
    std::uint32_t storage_images = 0;
    std::uint32_t texel_buffers = 0;  // after the images
};

struct PipelineObjects {
    Handle<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout> images;
    Handle<VkPipelineLayout, &vkDestroyPipelineLayout> layout;
    Handle<VkPipeline, &vkDestroyPipeline> pipeline;
    VkShaderStageFlags push_stages = 0;  // that the push constants are of
};

// The pipelines that a device made last, by all that they were made of: the code of their stages,
// constants and state. Equal ones are made once, as a driver would compile each of them anew, some
// at its first draw only. Thread-safe.
class PipelineStore {
public:
    using Objects = std::shared_ptr<const PipelineObjects>;

    Objects get(const std::string& key, const std::function<PipelineObjects()>& make);

private:
    static constexpr std::size_t kMost = 256;

    std::mutex mutex_;
    std::list<std::pair<std::string, Objects>> newest_first_;
};

class ComputePipeline {
public:
    ComputePipeline(const Device& device, const ComputeDescription& description);

    VkPipeline get() const { return objects_->pipeline.get(); }
    VkPipelineLayout layout() const { return objects_->layout.get(); }
    VkDescriptorSetLayout imagesLayout() const { return objects_->images.get(); }  // null: none

private:
    PipelineStore::Objects objects_;
};

// What becomes of a fragment's color and that of the attachment.
enum class Blend {
    replace,
    add,  // all channels
    over,  // color: by the fragment's alpha; alpha: what is covered
    attenuate,  // attachment x (1 - fragment), channel by channel
    keep,  // nothing: the attachment stays as it is
};

struct ColorTarget {
    VkFormat format = VK_FORMAT_UNDEFINED;
    Blend blend = Blend::replace;
};

// Which way depth goes, in every image of depth, from the eye as from lights: from 1 at the near
// plane down to 0 at the far one. A perspective view leaves little depth for what is far away, and
// 32-bit floats are finest near 0, so the two make up for each other; with 0 at the near plane they
// would add up: 2.4 mm a step at 20 m from planes of 0.01 and 100 m, where now it is 2 um. Shaders
// have it from shaders/common/depth.glsl.
constexpr float kNearDepth = 1.0f;
constexpr float kFarDepth = 0.0f;
constexpr VkCompareOp kIsNearer = VK_COMPARE_OP_GREATER;
constexpr VkCompareOp kIsNearerOrEqual = VK_COMPARE_OP_GREATER_OR_EQUAL;

struct GraphicsDescription {
    // One per stage, by extension: .vert .tesc .tese .geom .frag, or .task .mesh .frag.
    std::vector<std::string> shaders;
    Constants constants;  // the same for every stage
    ShaderExtensions extensions{};  // each of the stages that call it
    std::uint32_t push_size = 0;  // B
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::uint32_t patch_control_points = 0;  // with PATCH_LIST
    std::vector<ColorTarget> colors;  // blends that differ need independentBlend
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkCompareOp depth_compare = kIsNearer;
    bool depth_write = true;
    bool discard = false;  // primitives, before they are rasterised: no .frag then
    // With their samplers, at bindings 0 .. of the fragment stage.
    std::uint32_t sampled_images = 0;
    std::uint32_t texel_buffers = 0;  // after the images
};

// A pipeline of graphics stages. Viewport and scissor are dynamic; the rest of the state is in the
// description.
class GraphicsPipeline {
public:
    // Throws Unsupported for stages that the device hasn't.
    GraphicsPipeline(const Device& device, const GraphicsDescription& description);

    VkPipeline get() const { return objects_->pipeline.get(); }
    VkPipelineLayout layout() const { return objects_->layout.get(); }
    VkDescriptorSetLayout imagesLayout() const { return objects_->images.get(); }  // null: none
    VkShaderStageFlags pushStages() const { return objects_->push_stages; }

private:
    PipelineStore::Objects objects_;
};

// A place at which SPIR-V expects a descriptor.
struct ShaderBinding {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;

    auto operator<=>(const ShaderBinding&) const = default;
};

// All descriptors that a shader's code names.
std::set<ShaderBinding> shaderBindings(std::span<const std::uint32_t> code);

// Operations of the SPIR-V specification, 3.42.
namespace spirv {
constexpr std::uint32_t kSourceContinued = 2;
constexpr std::uint32_t kSource = 3;
constexpr std::uint32_t kString = 7;
constexpr std::uint32_t kFunction = 54;
constexpr std::uint32_t kDecorate = 71;
}  // namespace spirv

struct SpirvInstruction {
    std::uint32_t operation = 0;
    std::span<const std::uint32_t> operands;  // words
};

// Calls `use` for every instruction before the first function. Ends early in what is no SPIR-V.
template <class Use>
void forEachDeclaration(std::span<const std::uint32_t> code, Use&& use) {
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t at = kHeaderWords; at < code.size();) {
        const std::size_t count = code[at] >> 16;
        const std::uint32_t operation = code[at] & 0xffff;
        if (operation == spirv::kFunction || count == 0 || count > code.size() - at) return;
        use(SpirvInstruction{operation, code.subspan(at + 1, count - 1)});
        at += count;
    }
}

}  // namespace engine
