#include "hair/rendering/software_backend.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>

#include <glm/vec4.hpp>

#include "engine/error.h"
#include "engine/target.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_structure.h"

namespace hair::rendering {
namespace {

using engine::Access;

static_assert(
    offsetof(gpu::SoftwarePush, width) == 88 && offsetof(gpu::SoftwarePush, structure) == 112 &&
    sizeof(gpu::SoftwarePush) == 128);

constexpr const char* kSoftware = "/strands/backend: software";
constexpr std::size_t kSampleBytes = 8;  // two words

// Throws engine::Unsupported for counts and positions of samples that the shaders don't know.
std::uint32_t
checkedSamples(const engine::Device& device, std::uint32_t samples, const std::string& backend) {
    const bool known = samples == 1 || samples == 2 || samples == 4 || samples == 8;
    if (!known)
        throw engine::Unsupported(
            backend, std::to_string(samples) + " samples per pixel; only 1 to 8 are supported");
    if (samples > 1 && !device.info().limits.standardSampleLocations)
        throw engine::Unsupported(
            backend, "the device does not have the standard sample locations");
    return samples;
}

std::size_t sampleCount(const engine::TargetDescription& target) {
    return std::size_t{target.width} * target.ssaa * target.height * target.ssaa * target.msaa;
}

// With 64-bit integers and atomics, one pass over the pieces is enough; otherwise it takes two.
bool isPacked(const engine::Device& device) {
    return readsPairs(device) && device.has(engine::Feature::long_atomics);
}

// A piece takes an iteration to test it, and more to list it.
std::uint32_t
culledBlock(const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan) {
    return strandBlock(device, strands, plan, 3);
}

// Whether each invocation of `shade` takes one pixel. Lavapipe ends an invocation's loops after
// 65,535 iterations in all, and each light adds iterations for each texel of its map, and each ray
// for each of its steps. With few lights and without rays, an invocation takes many pixels and
// reads the picture's parameters once.
bool shadesPixelPerInvocation(const BackendContext& context) {
    constexpr std::uint32_t kFewLights = 2;
    return context.traces_shadows ||
           std::ranges::any_of(context.output.shading, [](const engine::Constant& constant) {
               return constant.id == gpu::kLightCountConstant && constant.bits > kFewLights;
           });
}

// Returns the most pieces per invocation of `raster`, of `pieces` in all. A processor is busy with
// few invocations, and 128 pieces are few enough to be done before lavapipe ends an invocation's
// loops. Other devices get one piece per invocation, until there are enough invocations for any of
// them.
std::uint32_t rasterizedPieces(const engine::Device& device, std::uint32_t pieces) {
    constexpr std::uint32_t kMost = 128;
    constexpr std::uint32_t kEnoughInvocations = 1 << 18;  // more than any GPU keeps resident
    if (device.info().type == engine::DeviceType::cpu) return kMost;
    return std::clamp(pieces / kEnoughInvocations, 1U, kMost);
}

engine::Constants
softwareConstants(const BackendContext& context, std::uint32_t block, std::uint32_t group) {
    engine::Constants constants = pointsConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kStrandBlockConstant, block);
    constants.emplace_back(gpu::kGroupConstant, group);
    constants.emplace_back(gpu::kPixelSamplesConstant, context.output.samples);
    constants.insert(constants.end(), context.output.shading.begin(), context.output.shading.end());
    return constants;
}

// The points as a texel buffer, for the stages that have a variant for it: those with 64-bit
// atomics. Null if the device can't fetch so many points or samples as texels.
const engine::TexelView* texelsOf(const BackendContext& context) {
    const std::size_t samples = sampleCount(context.target->description());
    const bool fits = samples <= context.device.info().limits.maxTexelBufferElements;
    return fits && isPacked(context.device) ? context.points->texels() : nullptr;
}

std::string
shaderOf(const BackendContext& context, const std::string& folder, const std::string& name) {
    return "strands/" + folder + "/" + name + (isPacked(context.device) ? "+packed" : "");
}

engine::ComputeDescription softwareStage(
    const BackendContext& context, const std::string& name, std::uint32_t group,
    std::uint32_t block = 1) {
    return samplesStage(context, "software", name, group, block);
}

// A stage that fetches from `buffers` texel buffers if texelsOf() is set.
engine::ComputeDescription texelStage(
    const BackendContext& context, const std::string& name, std::uint32_t buffers,
    std::uint32_t group, std::uint32_t block = 1) {
    if (!texelsOf(context)) return softwareStage(context, name, group, block);
    engine::ComputeDescription stage = softwareStage(context, name + "+texels", group, block);
    stage.texel_buffers = buffers;
    return stage;
}

engine::ComputeDescription clearStage(const BackendContext& context) {
    engine::ComputeDescription stage = softwareStage(
        context, context.output.samples > 1 ? "clear.comp+multisample" : "clear.comp",
        pixelGroup(context.device));
    stage.sampled_images = 1;
    return stage;
}

engine::ComputeDescription shadeStage(const BackendContext& context) {
    engine::ComputeDescription stage = texelStage(
        context, context.traces_shadows ? "shade.comp+rays" : "shade.comp", 2,
        pixelGroup(context.device));
    stage.combined_images = context.output.sampled_images;
    return stage;
}

engine::GraphicsDescription blitStage(const BackendContext& context) {
    const bool has_texels = texelsOf(context) != nullptr;
    return {
        .shaders =
            {"strands/software/blit.vert",
             shaderOf(context, "software", has_texels ? "blit.frag+texels" : "blit.frag")},
        .constants = softwareConstants(context, 1, 1),
        .push_size = sizeof(gpu::SoftwarePush),
        .colors = context.output.colors,
        .depth_format = context.output.depth_format,
        .samples = context.output.samples,
        .depth_write = context.output.depth_write,
        .texel_buffers = has_texels ? 1U : 0U};
}

}  // namespace

// ---- The visibility buffer ----------------------------------------------------------------------

// Each invocation reads once what all pixels share. On a processor, a work group has as many
// invocations as lavapipe runs at a time.
std::uint32_t pixelGroup(const engine::Device& device) {
    return device.info().type == engine::DeviceType::cpu ? 8 : 32;
}

engine::ComputeDescription samplesStage(
    const BackendContext& context, const std::string& folder, const std::string& name,
    std::uint32_t group, std::uint32_t block) {
    return {
        .shader = shaderOf(context, folder, name),
        .constants = softwareConstants(context, block, group),
        .extensions = context.output.extensions,
        .push_size = sizeof(gpu::SoftwarePush)};
}

engine::MemoryRows VisibilityBuffer::rows(const engine::TargetDescription& target) {
    const std::size_t samples = kSampleBytes * sampleCount(target);
    engine::MemoryRows rows("strands", {{"software visibility buffer", samples}});
    if (target.color_format != engine::Target::kOutputFormat)
        rows.add("strands", {{"software colors", samples}});
    return rows;
}

VisibilityBuffer::VisibilityBuffer(const BackendContext& context, const std::string& backend)
    : target_(*context.target), points_(*context.points),
      structure_(context.traces_shadows ? context.structure : nullptr),
      samples_per_pixel_(checkedSamples(context.device, context.output.samples, backend)),
      points_texels_(texelsOf(context)), clear_(context.device, clearStage(context)),
      shaded_columns_(
          shadesPixelPerInvocation(context)
              ? divideUp(target_.color().extent().width, pixelGroup(context.device))
              : 1),
      shade_(context.device, shadeStage(context)), blit_(context.device, blitStage(context)) {
    const engine::MemoryRows rows = VisibilityBuffer::rows(target_.description());
    samples_ = {context.device, rows["software visibility buffer"]};
    if (target_.hasRadiance()) colors_ = {context.device, rows["software colors"]};
    if (points_texels_) texels_ = {context.device, samples_, VK_FORMAT_R32G32_UINT};
}

void VisibilityBuffer::check(
    const engine::Device& device, const Settings& settings, const std::string& backend) {
    checkedSamples(device, settings.render.msaa, backend);
}

gpu::SoftwarePush VisibilityBuffer::push(const StrandPicture& picture) const {
    const VkExtent2D extent = target_.color().extent();
    return {
        .picture = picture.address,
        .width = extent.width,
        .height = extent.height,
        .strands = points_.strandCount(picture.parameters),
        .part = gpu::kFirstPart};
}

void VisibilityBuffer::clear(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    target_.beginDepthRead(commands);
    constants.visibility = commands.writes(samples_);
    constants.bounds = commands.reads(points_.bounds());
    commands.bind(clear_, constants);
    const engine::Image* const depth = &target_.depth();
    commands.images(clear_, std::span(&depth, 1), {});
    commands.dispatch(constants.height);
}

void VisibilityBuffer::shade(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.points = commands.reads(points_.points());
    constants.pieces = commands.reads(points_.pieces());
    constants.visibility = commands.writes(samples_);
    constants.bounds = commands.reads(points_.bounds());
    if (target_.hasRadiance()) constants.colors = commands.writes(colors_);
    if (structure_) structure_->tracesLight(commands, StrandStructure::Tracer::compute);
    commands.bind(shade_, constants);
    if (points_texels_)
        commands.images(shade_, picture.images, std::array{points_texels_, &texels_});
    else
        commands.images(shade_, picture.images);
    commands.dispatch(constants.height, shaded_columns_);
    // Only the drawing needs the depth again, so its barrier changes the layout, too.
    target_.endDepthRead(commands);
}

void VisibilityBuffer::draw(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = push(picture);
    constants.visibility = commands.use({samples_, Access::fragment_read});
    constants.bounds = commands.use({points_.bounds(), Access::vertex_read});
    if (target_.hasRadiance()) constants.colors = commands.use({colors_, Access::fragment_read});
    // One draw per sample, because sample-rate shading is a feature that not every device has.
    for (constants.choice = 0; constants.choice < samples_per_pixel_; ++constants.choice) {
        commands.bind(blit_, constants);
        if (points_texels_) commands.images(blit_, {}, std::array{&texels_});
        commands.draw({.vertices = 6});
    }
}

// ---- The rasteriser -----------------------------------------------------------------------------

namespace {

engine::MemoryRows softwareRows(
    const engine::Device& device, const engine::TargetDescription& target,
    const StrandSettings& strands, const StrandPlan& plan) {
    const std::size_t tiles = std::size_t{divideUp(target.width * target.ssaa, gpu::kTile)} *
                              divideUp(target.height * target.ssaa, gpu::kTile);
    const std::uint64_t block = culledBlock(device, strands, plan);
    const std::uint64_t whole = (plan.strands() + block - 1) / block * block;  // strands of blocks
    engine::MemoryRows rows = VisibilityBuffer::rows(target);
    rows.add(
        "strands",
        {{"software counts", sizeof(gpu::PieceCounts)},
         {"software list",
          engine::bytesOf<std::uint32_t>(whole * plan.segments * plan.forced_tessellation)},
         {"software large pieces", engine::bytesOf<std::uint32_t>(gpu::kMostLargePieces)},
         {"software depths of tiles", engine::bytesOf<std::uint32_t>(tiles)},
         {"software depth pyramid", kSampleBytes * tiles}});
    return rows;
}

}  // namespace

engine::MemoryRows SoftwareBackend::rows(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    return softwareRows(device, targetDescription(settings.render), settings.strands, plan);
}

SoftwareBackend::SoftwareBackend(const BackendContext& context)
    : points_(*context.points), visibility_(context, kSoftware),
      sample_count_(sampleCount(context.target->description())),
      group_(strandGroup(context.device)),
      block_(culledBlock(context.device, context.strands, context.plan)),
      pieces_per_strand_(context.plan.segments * context.plan.forced_tessellation),
      rasterized_pieces_(rasterizedPieces(
          context.device, static_cast<std::uint32_t>(context.plan.strands()) * pieces_per_strand_)),
      is_packed_(isPacked(context.device)), texels_(texelsOf(context)),
      reduce_tiles_(
          context.device, texelStage(context, "tiles.comp", 1, pixelGroup(context.device))),
      build_pyramid_(
          context.device, texelStage(context, "pyramid.comp", 1, pixelGroup(context.device))),
      cull_(context.device, texelStage(context, "cull.comp", 2, group_, block_)),
      rasterize_(context.device, texelStage(context, "raster.comp", 2, group_)),
      rasterize_large_(context.device, texelStage(context, "raster.comp+large", 2, group_)) {
    const engine::MemoryRows rows =
        softwareRows(context.device, context.target->description(), context.strands, context.plan);
    counts_ = {context.device, rows["software counts"]};
    list_ = {context.device, rows["software list"]};
    large_ = {context.device, rows["software large pieces"]};
    tile_depths_ = {context.device, rows["software depths of tiles"]};
    pyramid_ = {context.device, rows["software depth pyramid"]};
    if (!texels_) return;
    tile_texels_ = {context.device, tile_depths_, VK_FORMAT_R32_UINT};
    pyramid_texels_ = {context.device, pyramid_, VK_FORMAT_R32G32_UINT};
}

void SoftwareBackend::check(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    if (tracesShadows(settings)) StrandStructure::check(device, settings, plan);
    checkPoints(plan);
    VisibilityBuffer::check(device, settings, kSoftware);
}

std::string SoftwareBackend::variant() const {
    return is_packed_ ? "one pass of 64-bit atomics, which the device has"
                      : "two passes of 32-bit atomics, as the device has none of 64 bits";
}

gpu::SoftwarePush SoftwareBackend::ofPart(gpu::SoftwarePush constants, std::uint32_t part) const {
    const std::uint32_t first = divideUp(divideUp(constants.strands, block_), gpu::kFirstStrands);
    constants.part = part;
    constants.list_begin = part == gpu::kFirstPart ? 0 : first * block_ * pieces_per_strand_;
    return constants;
}

void SoftwareBackend::cullPieces(engine::Commands& commands, gpu::SoftwarePush constants) const {
    const std::uint32_t all = divideUp(constants.strands, block_);
    const std::uint32_t first = divideUp(all, gpu::kFirstStrands);
    const std::uint32_t blocks = constants.part == gpu::kFirstPart ? first : all - first;
    if (blocks == 0) return;
    constants.points = commands.reads(points_.points());
    constants.pieces = commands.reads(points_.pieces());
    constants.bounds = commands.reads(points_.bounds());
    constants.pyramid = commands.reads(pyramid_);
    constants.counts = commands.writes(counts_);
    constants.list = commands.writes(list_);
    commands.bind(cull_, constants);
    if (texels_) commands.images(cull_, {}, std::array{texels_, &pyramid_texels_});
    commands.dispatchInvocations(blocks, group_);
}

// Dispatches an invocation for every rasterized_pieces_ pieces of all strands. Only listed pieces
// are covered, so most invocations have fewer.
void SoftwareBackend::rasterizePieces(
    engine::Commands& commands, gpu::SoftwarePush constants) const {
    constants.points = commands.reads(points_.points());
    constants.list = commands.reads(list_);
    constants.pieces = commands.reads(points_.pieces());
    constants.visibility = commands.writes(visibility_.samples());
    constants.counts = commands.writes(counts_);
    constants.large = commands.writes(large_);
    commands.bind(rasterize_, constants);
    if (texels_) commands.images(rasterize_, {}, std::array{texels_, visibility_.texels()});
    const std::uint32_t pieces = constants.strands * pieces_per_strand_;
    commands.dispatchInvocations(divideUp(pieces, rasterized_pieces_), group_);
}

void SoftwareBackend::rasterizeLarge(
    engine::Commands& commands, gpu::SoftwarePush constants) const {
    constants = ofPart(constants, gpu::kOtherPart);
    constants.points = commands.reads(points_.points());
    constants.list = commands.reads(list_);
    constants.pieces = commands.reads(points_.pieces());
    constants.visibility = commands.writes(visibility_.samples());
    constants.counts = commands.reads(counts_);
    constants.large = commands.reads(large_);
    commands.bind(rasterize_large_, constants);
    if (texels_) commands.images(rasterize_large_, {}, std::array{texels_, visibility_.texels()});
    constexpr std::uint32_t kMostGroups = 65535;  // of a dimension, on every device
    const std::size_t parts = sample_count_ / gpu::kLargeGroupSamples + 1;
    commands.dispatch(
        static_cast<std::uint32_t>(std::min<std::size_t>(gpu::kLargeGroups * parts, kMostGroups)));
}

void SoftwareBackend::reduceTiles(engine::Commands& commands, gpu::SoftwarePush constants) const {
    constants.visibility = commands.reads(visibility_.samples());
    constants.bounds = commands.reads(points_.bounds());
    constants.tile_depths = commands.writes(tile_depths_);
    commands.bind(reduce_tiles_, constants);
    if (texels_) commands.images(reduce_tiles_, {}, std::array{visibility_.texels()});
    commands.dispatch(divideUp(constants.height, gpu::kTile));
}

void SoftwareBackend::buildPyramid(engine::Commands& commands, gpu::SoftwarePush constants) const {
    constants.bounds = commands.reads(points_.bounds());
    constants.tile_depths = commands.reads(tile_depths_);
    constants.pyramid = commands.writes(pyramid_);
    commands.bind(build_pyramid_, constants);
    if (texels_) commands.images(build_pyramid_, {}, std::array{&tile_texels_});
    commands.dispatch(divideUp(constants.height, gpu::kTile));
}

// With 64-bit atomics, the depth and the number of a sample's piece are one word. Without them, a
// first pass finds the nearest depth of each sample, and a second pass the first piece at that
// depth.
void SoftwareBackend::rasterize(engine::Commands& commands, const StrandPicture& picture) const {
    gpu::SoftwarePush constants = visibility_.push(picture);
    const gpu::SoftwarePush first = ofPart(constants, gpu::kFirstPart);
    const gpu::SoftwarePush others = ofPart(constants, gpu::kOtherPart);
    cullPieces(commands, first);
    rasterizePieces(commands, first);
    reduceTiles(commands, constants);
    buildPyramid(commands, constants);
    cullPieces(commands, others);
    rasterizePieces(commands, others);
    rasterizeLarge(commands, constants);
    if (is_packed_) return;
    constants.choice = 1;
    for (const std::uint32_t part : {gpu::kFirstPart, gpu::kOtherPart})
        rasterizePieces(commands, ofPart(constants, part));
    rasterizeLarge(commands, constants);
}

void SoftwareBackend::prepare(engine::Commands& commands, const StrandPicture& picture) const {
    commands.fill(counts_, 0);
    visibility_.clear(commands, picture);
    rasterize(commands, picture);
    visibility_.shade(commands, picture);
}

void SoftwareBackend::draw(engine::Commands& commands, const StrandPicture& picture) const {
    visibility_.draw(commands, picture);
}

// ---- Maps of lights -----------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::ShadowRasterPush) == 64 && offsetof(gpu::ShadowRasterPush, width) == 48);

// Returns the segments of a strand that an invocation rasterises. On a processor, an invocation
// reads once what they share. A piece takes at most kLargePieceSamples iterations, and 64 pieces
// are few enough to be done before lavapipe ends an invocation's loops.
std::uint32_t mapRun(const engine::Device& device, const StrandPlan& plan) {
    constexpr std::uint32_t kMostPieces = 64;
    if (device.info().type != engine::DeviceType::cpu) return 1;
    return std::clamp(kMostPieces / plan.forced_tessellation, 1U, plan.segments);
}

// Returns the work groups that share the large pieces, or all pieces if these are too many for
// their list: 256 each, until a dimension has no more groups. With 60,000 iterations, lavapipe's
// limit, each of 32 invocations may then have 230 samples of each piece.
std::uint32_t largeGroups(const StrandPlan& plan) {
    constexpr std::uint64_t kPieces = 256;
    constexpr std::uint64_t kMostGroups = 65535;  // of a dimension, on every device
    const std::uint64_t pieces = plan.strands() * plan.segments * plan.forced_tessellation;
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(pieces / kPieces, gpu::kLargeGroups, kMostGroups));
}

std::string mapVariant(const std::string& file, const engine::Device& device, bool has_texels) {
    return "shadows/" + file + (has_texels ? "+texels" : "") +
           (readsPairs(device) ? "+packed" : "");
}

const engine::TexelView* mapTexels(const BackendContext& context) {
    return readsPairs(context.device) ? context.points->texels() : nullptr;
}

engine::ComputeDescription mapStage(const BackendContext& context, const std::string& file) {
    const bool has_texels = mapTexels(context) != nullptr;
    engine::Constants constants = pointsConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kGroupConstant, strandGroup(context.device));
    constants.emplace_back(gpu::kSegmentRunConstant, mapRun(context.device, context.plan));
    return {
        .shader = mapVariant(file, context.device, has_texels),
        .constants = constants,
        .push_size = sizeof(gpu::ShadowRasterPush),
        .combined_images = 1,
        .texel_buffers = has_texels ? 1U : 0U};
}

engine::ComputeDescription storeStage(const engine::Device& device) {
    return {
        .shader = mapVariant("store.comp", device, false),
        .constants = {{gpu::kGroupConstant, pixelGroup(device)}},
        .push_size = sizeof(gpu::ShadowRasterPush),
        .storage_images = 2};
}

}  // namespace

engine::MemoryRows MapRasterizer::rows(std::uint32_t side) {
    const std::uint64_t texels = std::uint64_t{side} * side;
    return {
        "shadows",
        {{"depth of a map", engine::bytesOf<std::uint32_t>(texels)},
         {"opacity of a map", engine::bytesOf<glm::uvec4>(texels)},
         {"large pieces in a map", engine::bytesOf<std::uint32_t>(1 + gpu::kMostLargePieces)}}};
}

MapRasterizer::MapRasterizer(const BackendContext& context, std::uint32_t side)
    : points_(*context.points), side_(side), group_(strandGroup(context.device)),
      runs_(divideUp(context.plan.segments, mapRun(context.device, context.plan))),
      large_groups_(largeGroups(context.plan)), texels_(mapTexels(context)),
      rasterize_(context.device, mapStage(context, "raster.comp")),
      rasterize_large_(context.device, mapStage(context, "raster.comp+large")),
      store_(context.device, storeStage(context.device)) {
    const engine::MemoryRows rows = MapRasterizer::rows(side);
    depths_ = {context.device, rows["depth of a map"]};
    layers_ = {context.device, rows["opacity of a map"]};
    large_ = {context.device, rows["large pieces in a map"]};
}

void MapRasterizer::record(
    engine::Commands& commands, const StrandPicture& picture, const engine::Image& depths,
    const engine::Image& layers) const {
    const gpu::ShadowRasterPush map{
        .picture = picture.address,
        .width = side_,
        .height = side_,
        .strands = points_.strandCount(picture.parameters)};
    const auto rasterize = [&](const engine::ComputePipeline& pipeline, std::uint32_t choice) {
        gpu::ShadowRasterPush push = map;
        push.points = commands.reads(points_.points());
        push.pieces = commands.reads(points_.pieces());
        push.depths = choice == 0 ? commands.writes(depths_) : commands.reads(depths_);
        if (choice == 1) push.layers = commands.writes(layers_);
        const bool lists = &pipeline == &rasterize_ && choice == 0;
        push.large = lists ? commands.writes(large_) : commands.reads(large_);
        push.choice = choice;
        commands.bind(pipeline, push);
        if (texels_)
            commands.images(pipeline, picture.images, std::array{texels_});
        else
            commands.images(pipeline, picture.images);
    };
    commands.fill(depths_, 0);
    commands.fill(layers_, 0);
    constexpr std::uint32_t kNone = 0;
    commands.write(large_, std::as_bytes(std::span(&kNone, 1)));
    for (const std::uint32_t choice : {0U, 1U}) {
        rasterize(rasterize_, choice);
        commands.dispatchInvocations(map.strands * runs_, group_);
        rasterize(rasterize_large_, choice);
        commands.dispatch(large_groups_);
    }
    gpu::ShadowRasterPush push = map;
    push.depths = commands.reads(depths_);
    push.layers = commands.reads(layers_);
    commands.bind(store_, push);
    commands.images(store_, {}, std::array{&depths, &layers});
    commands.dispatch(side_);
}

}  // namespace hair::rendering
