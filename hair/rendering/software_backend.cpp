#include "hair/rendering/software_backend.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <string>

#include "engine/error.h"
#include "engine/target.h"

namespace hair::rendering {
namespace {

using engine::Access;

static_assert(sizeof(gpu::HairBounds) == 20);
static_assert(offsetof(gpu::SoftwarePush, width) == 56 && sizeof(gpu::SoftwarePush) == 72);

constexpr const char* kSoftware = "/strands/backend: software";
constexpr std::size_t kSampleBytes = 8;  // two words
constexpr std::size_t kPointBytes = 16;  // strands/software/points.glsl
constexpr std::uint32_t kMostColumns = 65535;  // what every device has

// Shaders number pieces in 32 bits, of which the last stands for none.
std::uint32_t countStrands(const StrandPlan& plan) {
    const std::uint64_t pieces = plan.drawnSegments();
    if (pieces >= std::numeric_limits<std::uint32_t>::max())
        throw engine::Unsupported(
            kSoftware, std::to_string(pieces) + " drawn segments are too many");
    return static_cast<std::uint32_t>(plan.strands());
}

// kPointsPerStrand of strands/software/software.glsl.
std::size_t pointsPerStrand(const BackendContext& context) {
    const StrandPlan& plan = context.plan;
    if (context.strands.taper == Taper::segment)
        return std::size_t{plan.segments} * (plan.forced_tessellation + 1);
    return std::size_t{plan.segments} * plan.forced_tessellation + 1;
}

// Samples are where the device has them.
std::uint32_t checkedSamples(const BackendContext& context) {
    const std::uint32_t samples = context.output.samples;
    const bool known = samples == 1 || samples == 2 || samples == 4 || samples == 8;
    if (!known)
        throw engine::Unsupported(
            kSoftware, std::to_string(samples) + " samples a pixel; it knows the places of 1 to 8");
    if (samples > 1 && !context.device.info().limits.standardSampleLocations)
        throw engine::Unsupported(kSoftware, "the device has samples at places of its own");
    return samples;
}

std::size_t sampleCount(const engine::Target& target) {
    const VkExtent2D extent = target.color().extent();
    return std::size_t{extent.width} * extent.height * target.description().msaa;
}

engine::Buffer
softwareBuffer(const engine::Device& device, std::size_t bytes, const std::string& name) {
    return {
        device,
        {.size = std::max(bytes, kSampleBytes),
         .usage = engine::Usage::storage,
         .name = "software " + name}};
}

// A device that takes one element of one invocation at a time takes 64 bits of it as soon as 32.
bool isPacked(const engine::Device& device) {
    return device.has(engine::Feature::long_integers) && device.has(engine::Feature::long_atomics);
}

// Strands of an invocation, of which each piece takes so many turns of loops. What is read once for
// all of them counts on a processor, that there are many invocations elsewhere. Strands of a groom
// have guides of their own. Mesa's lavapipe ends an invocation's loops after 65,535 turns in all.
std::uint32_t strandBlock(const BackendContext& context, std::uint32_t turns) {
    constexpr std::uint64_t kMostTurns = 60000;
    constexpr std::uint64_t kProcessorBlock = 8;
    if (context.device.info().type != "cpu") return 1;
    if (context.strands.source != StrandSource::root_triangles) return 1;
    const std::uint64_t pieces =
        std::uint64_t{context.plan.segments} * context.plan.forced_tessellation;
    const std::uint64_t most = kMostTurns / (turns * pieces);
    return static_cast<std::uint32_t>(std::clamp(most, std::uint64_t{1}, kProcessorBlock));
}

// A point, and where segments begin some more.
std::uint32_t evaluatedBlock(const BackendContext& context) { return strandBlock(context, 4); }

// A turn for each sample and one for each row of them.
std::uint32_t coveredBlock(const BackendContext& context) {
    return strandBlock(context, 2 * gpu::kManySamples);
}

engine::Constants softwareConstants(const BackendContext& context, std::uint32_t block) {
    engine::Constants constants = strandConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kMostSegmentsConstant, context.plan.segments);
    constants.emplace_back(gpu::kMostPiecesConstant, context.plan.forced_tessellation);
    constants.emplace_back(gpu::kStrandBlockConstant, block);
    constants.emplace_back(gpu::kPixelSamplesConstant, context.output.samples);
    constants.insert(constants.end(), context.output.shading.begin(), context.output.shading.end());
    return constants;
}

std::string shaderOf(const BackendContext& context, const std::string& name, const char* stage) {
    return "strands/software/" + name + (isPacked(context.device) ? "_packed" : "") + stage;
}

engine::ComputeDescription
softwareStage(const BackendContext& context, const std::string& name, std::uint32_t block = 1) {
    return {
        .shader = shaderOf(context, name, ".comp"),
        .constants = softwareConstants(context, block),
        .push_size = sizeof(gpu::SoftwarePush)};
}

engine::ComputeDescription clearStage(const BackendContext& context) {
    engine::ComputeDescription stage =
        softwareStage(context, context.output.samples > 1 ? "clear_multisample" : "clear");
    stage.sampled_images = 1;
    return stage;
}

engine::ComputeDescription shadeStage(const BackendContext& context) {
    engine::ComputeDescription stage = softwareStage(context, "shade");
    stage.combined_images = context.output.sampled_images;
    return stage;
}

engine::GraphicsDescription showStage(const BackendContext& context) {
    return {
        .shaders = {"strands/software/show.vert", shaderOf(context, "show", ".frag")},
        .constants = softwareConstants(context, 1),
        .push_size = sizeof(gpu::SoftwarePush),
        .colors = context.output.colors,
        .depth_format = context.output.depth_format,
        .samples = context.output.samples,
        .depth_write = context.output.depth_write};
}

// As many invocations, in as many rows as the device needs.
void dispatchBlocks(engine::Commands& commands, std::uint32_t blocks) {
    if (blocks == 0) return;
    const std::uint32_t groups =
        (blocks + gpu::kSoftwareStrandGroup - 1) / gpu::kSoftwareStrandGroup;
    const std::uint32_t columns = std::min(groups, kMostColumns);
    commands.dispatch(columns, (groups + columns - 1) / columns);
}

constexpr std::uint32_t blocksOf(std::uint32_t strands, std::uint32_t block) {
    return (strands + block - 1) / block;
}

}  // namespace

SoftwareBackend::SoftwareBackend(const BackendContext& context)
    : target_(*context.target), samples_per_pixel_(checkedSamples(context)),
      strand_count_(countStrands(context.plan)),
      evaluated_blocks_(
          context.plan.triangles * blocksOf(context.plan.forced_density, evaluatedBlock(context))),
      covered_blocks_(blocksOf(strand_count_, coveredBlock(context))),
      is_packed_(isPacked(context.device)),
      points_(softwareBuffer(
          context.device, kPointBytes * strand_count_ * pointsPerStrand(context), "points")),
      pieces_(softwareBuffer(
          context.device, sizeof(std::uint32_t) * strand_count_, "pieces of strands")),
      samples_(softwareBuffer(context.device, kSampleBytes * sampleCount(target_), "samples")),
      bounds_(softwareBuffer(context.device, sizeof(gpu::HairBounds), "bounds")),
      large_(softwareBuffer(
          context.device, sizeof(std::uint32_t) * gpu::kMostLargePieces, "large pieces")),
      evaluate_(context.device, softwareStage(context, "evaluate", evaluatedBlock(context))),
      clear_(context.device, clearStage(context)),
      cover_(context.device, softwareStage(context, "cover", coveredBlock(context))),
      cover_large_(context.device, softwareStage(context, "cover_large")),
      shade_(context.device, shadeStage(context)), show_(context.device, showStage(context)) {
    if (target_.hasRadiance())
        colors_ = softwareBuffer(context.device, kSampleBytes * sampleCount(target_), "colors");
}

gpu::SoftwarePush SoftwareBackend::push(const StrandPicture& picture) const {
    const VkExtent2D extent = target_.color().extent();
    return {
        .picture = picture.address,
        .points = 0,
        .pieces = 0,
        .samples = 0,
        .colors = 0,
        .bounds = 0,
        .large = 0,
        .width = extent.width,
        .height = extent.height,
        .strands = strand_count_,
        .choice = 0};
}

void SoftwareBackend::evaluate(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.points = points_.address();
    constants.pieces = pieces_.address();
    constants.bounds = bounds_.address();
    commands.uses(
        {{picture.parameters.guides, Access::compute_read},
         {picture.parameters.contacts, Access::compute_read},
         {picture.parameters.guide_normals, Access::compute_read},
         {points_, Access::compute_write},
         {pieces_, Access::compute_write},
         {bounds_, Access::compute_write}});
    commands.bind(evaluate_, constants);
    dispatchBlocks(commands, evaluated_blocks_);
}

void SoftwareBackend::clear(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.samples = samples_.address();
    constants.bounds = bounds_.address();
    target_.beginDepthRead(commands);
    commands.uses({{samples_, Access::compute_write}, {bounds_, Access::compute_read}});
    commands.bind(clear_, constants);
    const engine::Image* const depth = &target_.depth();
    commands.images(clear_, std::span(&depth, 1), {});
    commands.dispatch(constants.height);
    target_.endDepthRead(commands);
}

void SoftwareBackend::cover(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.points = points_.address();
    constants.pieces = pieces_.address();
    constants.samples = samples_.address();
    constants.bounds = bounds_.address();
    constants.large = large_.address();
    const std::uint32_t passes = is_packed_ ? 1 : 2;
    for (constants.choice = 0; constants.choice < passes; ++constants.choice) {
        for (const engine::ComputePipeline* pipeline : {&cover_, &cover_large_}) {
            commands.barrier(Access::compute_write, Access::compute_write);
            commands.uses(
                {{points_, Access::compute_read},
                 {pieces_, Access::compute_read},
                 {samples_, Access::compute_write},
                 {bounds_, Access::compute_write},
                 {large_, Access::compute_write}});
            commands.bind(*pipeline, constants);
            if (pipeline == &cover_)
                dispatchBlocks(commands, covered_blocks_);
            else
                commands.dispatch(gpu::kLargeGroups);
        }
    }
}

void SoftwareBackend::shade(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.points = points_.address();
    constants.pieces = pieces_.address();
    constants.samples = samples_.address();
    constants.bounds = bounds_.address();
    if (target_.hasRadiance()) constants.colors = colors_.address();
    // Lights' maps are ready for the fragment stage.
    commands.barrier(
        {{Access::compute_write, Access::compute_write},
         {Access::fragment_read, Access::compute_read}});
    commands.uses(
        {{points_, Access::compute_read},
         {pieces_, Access::compute_read},
         {samples_, Access::compute_write},
         {bounds_, Access::compute_read},
         {constants.colors, Access::compute_write}});
    commands.bind(shade_, constants);
    commands.images(shade_, picture.images);
    commands.dispatch(constants.height);
}

void SoftwareBackend::prepare(engine::Commands& commands, const StrandPicture& picture) const {
    // The last frame's picture may still be shown.
    commands.barrier(Access::vertex_read, Access::transfer_write);
    commands.fill(bounds_, 0);
    commands.barrier(
        {{Access::transfer_write, Access::compute_write},
         {Access::compute_write, Access::compute_read},
         {Access::fragment_read, Access::compute_write}});
    evaluate(commands, picture);
    commands.barrier(Access::compute_write, Access::compute_read);
    clear(commands, picture);
    cover(commands, picture);
    shade(commands, picture);
    commands.barrier(
        {{Access::compute_write, Access::fragment_read},
         {Access::compute_write, Access::vertex_read}});
}

void SoftwareBackend::draw(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.samples = samples_.address();
    constants.bounds = bounds_.address();
    if (target_.hasRadiance()) constants.colors = colors_.address();
    commands.uses(
        {{samples_, Access::fragment_read},
         {constants.colors, Access::fragment_read},
         {bounds_, Access::vertex_read}});
    // One draw for each sample: shading by sample is a feature that not every device has.
    for (constants.choice = 0; constants.choice < samples_per_pixel_; ++constants.choice) {
        commands.bind(show_, constants);
        commands.draw({.vertices = 6});
    }
}

}  // namespace hair::rendering
