#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/device.h"

// Compute and graphics pipelines from descriptions.
namespace engine {

// A specialization constant: its id in shaders and the 32 bits of its value. A value of any other
// type is ambiguous and does not compile.
struct Constant {
    constexpr Constant(std::uint32_t constant, std::uint32_t value) : id(constant), bits(value) {}
    constexpr Constant(std::uint32_t constant, bool value) : id(constant), bits(value ? 1 : 0) {}
    constexpr Constant(std::uint32_t constant, float value)
        : id(constant), bits(std::bit_cast<std::uint32_t>(value)) {}

    std::uint32_t id;
    std::uint32_t bits;
};

// Constants with distinct ids, in any order. A constant that the shader does not declare is no
// error. A missing constant keeps the shader's default.
using Constants = std::vector<Constant>;

struct ShaderExtension;
using ShaderExtensions = std::vector<std::shared_ptr<const ShaderExtension>>;

struct ComputeDescription {
    std::string shader;  // engine::shaderCode()
    Constants constants;
    ShaderExtensions extensions{};  // shaders.h: for the entry points that call them
    std::uint32_t push_size = 0;  // B
    // Either combined images with samplers from binding 0 on, or sampled images without samplers
    // followed by storage images.
    std::uint32_t combined_images = 0;
    std::uint32_t sampled_images = 0;
    std::uint32_t storage_images = 0;
    std::uint32_t texel_buffers = 0;  // after the images
};

class ComputePipeline {
public:
    ComputePipeline(const Device& device, const ComputeDescription& description);

    VkPipeline get() const { return objects_->pipeline.get(); }
    VkPipelineLayout layout() const { return objects_->layout.get(); }
    // null if there are no images
    VkDescriptorSetLayout imagesLayout() const { return objects_->images.get(); }

private:
    PipelineStore::Objects objects_;
};

// How a fragment's colour is combined with the attachment's.
enum class Blend {
    replace,
    add,  // all channels
    over,  // colour: blended by the fragment's alpha; alpha: coverage
    attenuate,  // attachment x (1 - fragment), channel by channel
    keep,  // the attachment stays unchanged
};

struct ColorTarget {
    VkFormat format = VK_FORMAT_UNDEFINED;
    Blend blend = Blend::replace;
};

// Direction of depth in every depth image, seen from the eye and from lights: 1 at the near plane,
// 0 at the far plane (reversed depth). A perspective view leaves little depth range for distant
// surfaces, and 32-bit floats are finest near 0, so the two effects cancel. With 0 at the near
// plane they would add up: with planes at 0.01 and 100 m, a step at 20 m would be 2.4 mm instead of
// 2 um. Shaders get the direction from shaders/common/depth.glsl.
constexpr float kNearDepth = 1.0f;
constexpr float kFarDepth = 0.0f;
constexpr VkCompareOp kIsNearer = VK_COMPARE_OP_GREATER;
constexpr VkCompareOp kIsNearerOrEqual = VK_COMPARE_OP_GREATER_OR_EQUAL;

struct GraphicsDescription {
    // One per stage, by extension: .vert .tesc .tese .geom .frag, or .task .mesh .frag.
    std::vector<std::string> shaders;
    Constants constants;  // the same for every stage
    ShaderExtensions extensions{};  // linked into each stage that calls them
    std::uint32_t push_size = 0;  // B
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::uint32_t patch_control_points = 0;  // with PATCH_LIST
    std::vector<ColorTarget> colors;  // different blends need Feature::independent_blend
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkCompareOp depth_compare = kIsNearer;
    bool depth_write = true;
    bool discard = false;  // drops primitives before rasterisation; then there is no .frag
    // Images with samplers, from binding 0 of the fragment stage on.
    std::uint32_t sampled_images = 0;
    std::uint32_t texel_buffers = 0;  // after the images
};

// A graphics pipeline. Viewport and scissor are dynamic; the description holds the rest of the
// state.
class GraphicsPipeline {
public:
    // Throws Unsupported for stages that the device lacks.
    GraphicsPipeline(const Device& device, const GraphicsDescription& description);

    VkPipeline get() const { return objects_->pipeline.get(); }
    VkPipelineLayout layout() const { return objects_->layout.get(); }
    // null if there are no images
    VkDescriptorSetLayout imagesLayout() const { return objects_->images.get(); }
    VkShaderStageFlags pushStages() const { return objects_->push_stages; }

private:
    PipelineStore::Objects objects_;
};

// The helper program (helperProgram()) that makes each pipeline with functions of a scene before
// this program does, in a child with limits (pipeline_trial.cpp): the compiler of a driver may
// never end, exhaust memory or crash on such functions. A driver with a cache then has the pipeline
// ready.
inline constexpr const char* kPipelineTrial = "hairbench_pipeline_trial";

// Reads the description that the helper program gets from its parent. The device uses the code in
// it from then on. Throws Error if the bytes end too early.
using TrialDescription = std::variant<ComputeDescription, GraphicsDescription>;
TrialDescription readTrial(const Device& device, std::string_view bytes);

}  // namespace engine
