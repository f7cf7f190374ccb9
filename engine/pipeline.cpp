#include "engine/pipeline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "engine/files.h"
#include "engine/process.h"
#include "engine/run_tool.h"
#include "engine/system/files.h"
#include "engine/shaders.h"

namespace engine {
namespace {

using ShaderModule = Handle<VkShaderModule, &vkDestroyShaderModule>;
using PipelineLayout = Handle<VkPipelineLayout, &vkDestroyPipelineLayout>;

constexpr std::array kStages{
    std::pair{".vert", VK_SHADER_STAGE_VERTEX_BIT},
    std::pair{".tesc", VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT},
    std::pair{".tese", VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT},
    std::pair{".geom", VK_SHADER_STAGE_GEOMETRY_BIT},
    std::pair{".task", VK_SHADER_STAGE_TASK_BIT_EXT},
    std::pair{".mesh", VK_SHADER_STAGE_MESH_BIT_EXT},
    std::pair{".frag", VK_SHADER_STAGE_FRAGMENT_BIT},
    std::pair{".comp", VK_SHADER_STAGE_COMPUTE_BIT},
};

VkShaderStageFlagBits stageOf(const std::string& path) {
    for (const auto& [extension, stage] : kStages) {
        if (shaderFile(path).ends_with(extension)) return stage;
    }
    throw Error("shader '" + path + "'", "its extension names no stage");
}

ShaderModule
loadModule(const Device& device, const std::string& path, const ShaderExtensions& extensions) {
    const std::shared_ptr<const ShaderCode> extended =
        extensions.empty() ? nullptr : device.shaders().extended(path, extensions);
    const std::span<const std::uint32_t> code =
        extended ? std::span(*extended) : device.shaders().code(path);
    const VkShaderModuleCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .codeSize = code.size_bytes(),
        .pCode = code.data()};
    VkShaderModule module{};
    check(vkCreateShaderModule(device.get(), &create, nullptr, &module), "create a shader module");
    return {device.get(), module};
}

// Keeps everything that `info` points to, except the constants themselves.
struct Specialization {
    explicit Specialization(const Constants& constants) {
        for (const Constant& constant : constants) {
            assert(std::ranges::count(constants, constant.id, &Constant::id) == 1);
            const std::size_t offset = entries.size() * sizeof(Constant) + offsetof(Constant, bits);
            entries.push_back(
                {.constantID = constant.id,
                 .offset = static_cast<std::uint32_t>(offset),
                 .size = sizeof(Constant::bits)});
        }
        info = {
            .mapEntryCount = static_cast<std::uint32_t>(entries.size()),
            .pMapEntries = entries.data(),
            .dataSize = sizeof(Constant) * constants.size(),
            .pData = constants.data()};
    }

    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};

VkPipelineShaderStageCreateInfo stageInfo(
    VkShaderStageFlagBits stage, const ShaderModule& module, const Specialization& specialization) {
    return {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .stage = stage,
        .module = module.get(),
        .pName = "main",
        .pSpecializationInfo = &specialization.info};
}

PipelineLayout makeLayout(
    const Device& device, VkShaderStageFlags stages, std::uint32_t push_size,
    VkDescriptorSetLayout images) {
    const VkPushConstantRange range{.stageFlags = stages, .offset = 0, .size = push_size};
    const VkPipelineLayoutCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .setLayoutCount = images ? 1u : 0u,
        .pSetLayouts = &images,
        .pushConstantRangeCount = push_size ? 1u : 0u,
        .pPushConstantRanges = &range};
    VkPipelineLayout layout{};
    check(
        vkCreatePipelineLayout(device.get(), &create, nullptr, &layout),
        "create a pipeline layout");
    return {device.get(), layout};
}

// Throws Unsupported if the device lacks the stage.
void requireStage(const Device& device, const std::string& path) {
    switch (stageOf(path)) {
    case VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT:
    case VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT:
        return device.require(Feature::tessellation, path);
    case VK_SHADER_STAGE_GEOMETRY_BIT:
        return device.require(Feature::geometry, path);
    case VK_SHADER_STAGE_TASK_BIT_EXT:
    case VK_SHADER_STAGE_MESH_BIT_EXT:
        return device.require(Feature::mesh_shader, path);
    default:
        return;
    }
}

// Stages that may have push constants. On a device without mesh stages no layout may name them.
VkShaderStageFlags pushStages(const std::vector<std::string>& shaders) {
    const bool has_mesh = std::ranges::any_of(
        shaders, [](const auto& path) { return stageOf(path) == VK_SHADER_STAGE_MESH_BIT_EXT; });
    if (!has_mesh) return VK_SHADER_STAGE_ALL_GRAPHICS;
    return VK_SHADER_STAGE_TASK_BIT_EXT | VK_SHADER_STAGE_MESH_BIT_EXT |
           VK_SHADER_STAGE_FRAGMENT_BIT;
}

// One image of these types per binding.
VkDescriptorSetLayout makeImageLayout(
    const Device& device, std::span<const VkDescriptorType> types, VkShaderStageFlags stages) {
    std::vector<VkDescriptorSetLayoutBinding> bindings(types.size());
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = types[i];
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = stages;
    }
    constexpr VkDescriptorSetLayoutCreateFlags kPushed =
        VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    const VkDescriptorSetLayoutCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .pNext = nullptr,
        .flags = device.has(Feature::push_descriptors) ? kPushed : 0,
        .bindingCount = static_cast<std::uint32_t>(bindings.size()),
        .pBindings = bindings.data()};
    VkDescriptorSetLayout layout{};
    check(
        vkCreateDescriptorSetLayout(device.get(), &create, nullptr, &layout),
        "create a descriptor set layout");
    return layout;
}

VkPipelineColorBlendAttachmentState blendState(Blend blend) {
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const auto factors = [&](VkBlendFactor source, VkBlendFactor destination) {
        state.blendEnable = VK_TRUE;
        state.srcColorBlendFactor = state.srcAlphaBlendFactor = source;
        state.dstColorBlendFactor = state.dstAlphaBlendFactor = destination;
    };
    switch (blend) {
    case Blend::replace:
        break;
    case Blend::add:
        factors(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE);
        break;
    case Blend::over:
        factors(VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
        state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        break;
    case Blend::attenuate:
        factors(VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR);
        break;
    case Blend::keep:
        state.colorWriteMask = 0;
        break;
    }
    return state;
}

// ---- Figures of compiled shaders ----------------------------------------------------------------

VkPipelineCreateFlags createFlags(const Device& device) {
    return device.tellsShaderFigures() ? VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR : 0;
}

double valueOf(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
        return statistic.value.b32 == VK_TRUE ? 1.0 : 0.0;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
        return static_cast<double>(statistic.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
        return static_cast<double>(statistic.value.u64);
    default:
        return statistic.value.f64;
    }
}

// Returns what the driver tells of a pipeline of these shaders; nothing if it is not asked.
std::vector<ShaderProgram>
programsOf(const Device& device, VkPipeline pipeline, std::span<const std::string> shaders) {
    if (!device.tellsShaderFigures()) return {};
    const VkPipelineInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pNext = nullptr, .pipeline = pipeline};
    constexpr const char* kContext = "read a pipeline's figures";
    std::uint32_t count = 0;
    check(vkGetPipelineExecutablePropertiesKHR(device.get(), &info, &count, nullptr), kContext);
    std::vector<VkPipelineExecutablePropertiesKHR> found(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
    check(
        vkGetPipelineExecutablePropertiesKHR(device.get(), &info, &count, found.data()), kContext);
    std::vector<ShaderProgram> programs;
    for (std::uint32_t i = 0; i < count; ++i) {
        ShaderProgram& program = programs.emplace_back(ShaderProgram{
            .name = found[i].name, .shaders = {}, .subgroup_size = found[i].subgroupSize});
        for (const std::string& path : shaders)
            if (found[i].stages & stageOf(path)) program.shaders.push_back(path);
        const VkPipelineExecutableInfoKHR one{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
            .pNext = nullptr,
            .pipeline = pipeline,
            .executableIndex = i};
        std::uint32_t figures = 0;
        check(
            vkGetPipelineExecutableStatisticsKHR(device.get(), &one, &figures, nullptr), kContext);
        std::vector<VkPipelineExecutableStatisticKHR> statistics(
            figures, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
        check(
            vkGetPipelineExecutableStatisticsKHR(device.get(), &one, &figures, statistics.data()),
            kContext);
        for (const VkPipelineExecutableStatisticKHR& each : statistics)
            program.figures.push_back({each.name, valueOf(each)});
    }
    return programs;
}

PipelineObjects makePipeline(const Device& device, const ComputeDescription& description) {
    assert(
        description.combined_images == 0 ||
        description.sampled_images + description.storage_images == 0);
    PipelineObjects objects;
    std::vector<VkDescriptorType> types(
        description.combined_images, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    types.resize(types.size() + description.sampled_images, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    types.resize(types.size() + description.storage_images, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    types.resize(types.size() + description.texel_buffers, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    if (!types.empty())
        objects.images = {
            device.get(), makeImageLayout(device, types, VK_SHADER_STAGE_COMPUTE_BIT)};
    objects.push_stages = VK_SHADER_STAGE_COMPUTE_BIT;
    objects.layout =
        makeLayout(device, objects.push_stages, description.push_size, objects.images.get());

    const ShaderModule module = loadModule(device, description.shader, description.extensions);
    const Specialization specialization(description.constants);
    VkComputePipelineCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    create.flags = createFlags(device);
    create.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, module, specialization);
    create.layout = objects.layout.get();
    VkPipeline pipeline{};
    check(
        vkCreateComputePipelines(
            device.get(), device.pipelineCache(), 1, &create, nullptr, &pipeline),
        description.shader.c_str());
    objects.pipeline = {device.get(), pipeline};
    objects.programs = programsOf(device, pipeline, std::span(&description.shader, 1));
    device.setName(
        VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), description.shader);
    return objects;
}

PipelineObjects makePipeline(const Device& device, const GraphicsDescription& description) {
    PipelineObjects objects;
    std::vector<VkDescriptorType> types(
        description.sampled_images, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    types.resize(types.size() + description.texel_buffers, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    if (!types.empty())
        objects.images = {
            device.get(), makeImageLayout(device, types, VK_SHADER_STAGE_FRAGMENT_BIT)};
    objects.push_stages = pushStages(description.shaders);
    objects.layout =
        makeLayout(device, objects.push_stages, description.push_size, objects.images.get());
    const Specialization specialization(description.constants);
    std::vector<ShaderModule> modules;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const std::string& path : description.shaders) {
        modules.push_back(loadModule(device, path, description.extensions));
        stages.push_back(stageInfo(stageOf(path), modules.back(), specialization));
    }

    VkPipelineVertexInputStateCreateInfo vertex_input{};
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = description.topology;
    VkPipelineTessellationStateCreateInfo tessellation{};
    tessellation.sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO;
    tessellation.patchControlPoints = description.patch_control_points;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo rasterization{};
    rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    rasterization.rasterizerDiscardEnable = description.discard ? VK_TRUE : VK_FALSE;
    rasterization.polygonMode = VK_POLYGON_MODE_FILL;
    rasterization.cullMode = description.cull;
    rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    rasterization.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(description.samples);
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = description.depth_write ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = description.depth_compare;
    std::vector<VkFormat> formats;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (const ColorTarget& color : description.colors) {
        formats.push_back(color.format);
        blends.push_back(blendState(color.blend));
    }
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    constexpr std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
    rendering.depthAttachmentFormat = description.depth_format;

    VkGraphicsPipelineCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    create.pNext = &rendering;
    create.flags = createFlags(device);
    create.stageCount = static_cast<std::uint32_t>(stages.size());
    create.pStages = stages.data();
    create.pVertexInputState = &vertex_input;
    create.pInputAssemblyState = &assembly;
    create.pTessellationState = description.patch_control_points ? &tessellation : nullptr;
    create.pViewportState = &viewport;
    create.pRasterizationState = &rasterization;
    create.pMultisampleState = &multisample;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
    create.layout = objects.layout.get();
    VkPipeline pipeline{};
    check(
        vkCreateGraphicsPipelines(
            device.get(), device.pipelineCache(), 1, &create, nullptr, &pipeline),
        description.shaders.front().c_str());
    objects.pipeline = {device.get(), pipeline};
    objects.programs = programsOf(device, pipeline, description.shaders);
    device.setName(
        VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline),
        description.shaders.front());
    return objects;
}

// ---- Descriptions as bytes ----------------------------------------------------------------------

// Calls `field` for every field of a description, except its extensions.
template <class Archive>
void eachField(ComputeDescription& description, Archive&& field) {
    field(description.shader);
    field(description.constants);
    field(description.push_size);
    field(description.combined_images);
    field(description.sampled_images);
    field(description.storage_images);
    field(description.texel_buffers);
}

template <class Archive>
void eachField(GraphicsDescription& description, Archive&& field) {
    field(description.shaders);
    field(description.constants);
    field(description.push_size);
    field(description.topology);
    field(description.patch_control_points);
    field(description.colors);
    field(description.depth_format);
    field(description.samples);
    field(description.cull);
    field(description.depth_compare);
    field(description.depth_write);
    field(description.discard);
    field(description.sampled_images);
    field(description.texel_buffers);
}

class DescriptionWriter {
public:
    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(const Value& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class Element>
    void operator()(const std::vector<Element>& elements) {
        (*this)(elements.size());
        for (const Element& element : elements) (*this)(element);
    }
    void operator()(std::string_view text) {
        (*this)(text.size());
        bytes_.append(text);
    }
    void operator()(const std::string& text) { (*this)(std::string_view(text)); }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

constexpr const char* kTruncated = "the description of a pipeline is cut off";

// Reads what a DescriptionWriter of the same build wrote.
class DescriptionReader {
public:
    explicit DescriptionReader(std::string_view bytes) : left_(bytes) {}

    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(Value& value) {
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
    }
    template <class Element>
    void operator()(std::vector<Element>& elements) {
        std::size_t count = 0;
        (*this)(count);
        for (; count > 0; --count) {
            if constexpr (std::is_same_v<Element, Constant>)
                elements.push_back({0, 0u});
            else
                elements.emplace_back();
            (*this)(elements.back());
        }
    }
    void operator()(std::string& text) {
        std::size_t size = 0;
        (*this)(size);
        text = take(size);
    }

private:
    std::string_view take(std::size_t size) {
        if (size > left_.size()) throw Error(kTruncated);
        const std::string_view taken = left_.substr(0, size);
        left_.remove_prefix(size);
        return taken;
    }

    std::string_view left_;
};

std::vector<std::string> shadersOf(const ComputeDescription& description) {
    return {description.shader};
}
std::vector<std::string> shadersOf(const GraphicsDescription& description) {
    return description.shaders;
}

std::string_view bytesOf(std::span<const std::uint32_t> code) {
    return {reinterpret_cast<const char*>(code.data()), code.size_bytes()};
}

// Returns the description, followed by what `use` writes for the code of each of its shaders.
template <class Description, class Use>
std::string described(const Device& device, Description description, Use&& use) {
    std::ranges::sort(description.constants, {}, &Constant::id);
    DescriptionWriter writer;
    eachField(description, writer);
    for (const std::string& shader : shadersOf(description)) {
        const std::shared_ptr<const ShaderCode> extended =
            description.extensions.empty()
                ? nullptr
                : device.shaders().extended(shader, description.extensions);
        use(writer, bytesOf(extended ? std::span(*extended) : device.shaders().code(shader)));
    }
    return writer.bytes();
}

// Returns everything that a pipeline is made of, with a hash instead of the code.
template <class Description>
std::string keyOf(const Device& device, const Description& description) {
    return described(device, description, [](DescriptionWriter& writer, std::string_view code) {
        writer(code.size());
        writer(std::hash<std::string_view>()(code));
    });
}

// ---- Pipelines made by a child first ------------------------------------------------------------

// Lets a child make the pipeline if it contains functions of a scene. Throws Error if that fails.
template <class Description>
void tryApart(const Device& device, const Description& description) {
    if (description.extensions.empty()) return;
    const bool is_compute = std::is_same_v<Description, ComputeDescription>;
    const system::SharedFile file(
        (is_compute ? 'C' : 'G') +
        described(device, description, [](DescriptionWriter& writer, std::string_view code) {
            writer(code);
        }));
    constexpr std::size_t kMostOutput = std::size_t{1} << 16;  // more than drivers print
    const std::string program = helperProgram(kPipelineTrial).string();
    const std::string& name = description.extensions.front()->name;
    try {
        runTool({program, device.info().name, file.name()}, {.output = kMostOutput});
    } catch (const std::system_error&) {
        throw Error(name, "the program that compiles it first is missing: " + program);
    } catch (const Error& error) {
        std::string reason = error.what();
        if (reason.starts_with(program)) reason = "it" + reason.substr(program.size());
        throw Error(name, "the device's compiler fails: " + reason);
    }
}

template <class Description>
PipelineObjects makeTried(const Device& device, const Description& description) {
    tryApart(device, description);
    return makePipeline(device, description);
}

template <class Description>
Description readAs(const Device& device, std::string_view bytes) {
    DescriptionReader reader(bytes);
    Description description;
    eachField(description, reader);
    ShaderLibrary::Replacements code;
    for (const std::string& shader : shadersOf(description)) {
        std::string words;
        reader(words);
        ShaderCode& own = code[shader];
        own.resize(words.size() / sizeof(std::uint32_t));
        std::memcpy(own.data(), words.data(), own.size() * sizeof(std::uint32_t));
    }
    device.shaders().replace(std::move(code));
    return description;
}

}  // namespace

ComputePipeline::ComputePipeline(const Device& device, const ComputeDescription& description)
    : objects_(device.pipelines().get(
          keyOf(device, description), [&] { return makeTried(device, description); })) {
    checkInterrupted();
}

GraphicsPipeline::GraphicsPipeline(const Device& device, const GraphicsDescription& description) {
    for (const std::string& path : description.shaders) requireStage(device, path);
    objects_ = device.pipelines().get(
        keyOf(device, description), [&] { return makeTried(device, description); });
    checkInterrupted();
}

TrialDescription readTrial(const Device& device, std::string_view bytes) {
    if (bytes.empty()) throw Error(kTruncated);
    const bool is_compute = bytes.starts_with('C');
    bytes.remove_prefix(1);
    if (is_compute) return readAs<ComputeDescription>(device, bytes);
    return readAs<GraphicsDescription>(device, bytes);
}

}  // namespace engine
