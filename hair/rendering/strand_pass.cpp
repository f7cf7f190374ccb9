#include "hair/rendering/strand_pass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/render_assets.h"
#include "hair/shader_codes.h"

namespace hair::rendering {
namespace {

using engine::Access;

struct BlendContext {
    const engine::Device& device;
    const Settings& settings;
    const engine::Target& target;
    const StrandView& view;  // for the bounding sphere of the strands
};

// The pipeline of a pass that blends a fragment over every pixel of the target.
engine::GraphicsDescription
compositePipeline(const RenderSettings& render, const char* fragment_shader) {
    return {
        .shaders = {"composite/screen.vert", fragment_shader},
        .push_size = sizeof(gpu::CompositePush),
        .colors = {{colorFormat(render), engine::Blend::over}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = render.msaa,
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .depth_write = false};
}

// ---- Drawn at once ------------------------------------------------------------------------------

// Blends fragments into the target directly, over its contents or over black.
class DirectBlend : public StrandBlend {
public:
    enum class Over { picture, black };

    DirectBlend(const RenderSettings& render, const char* fragment_shader)
        : DirectBlend(
              {.fragment = fragment_shader,
               .colors = {{colorFormat(render)}},
               .samples = render.msaa},
              Over::picture) {}
    DirectBlend(StrandOutput output, Over over) : output_(std::move(output)), over_(over) {}

    StrandOutput output() const override { return output_; }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const override {
        passes.pass("strands", strands.kind, [&](engine::Commands& commands) {
            strands.prepare(commands);
            target.beginRendering(commands, engine::Load::keep, {}, strands.last);
            if (over_ == Over::black) {
                VkClearAttachment black{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT};
                black.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
                const VkClearRect all{{{0, 0}, target.color().extent()}, 0, 1};
                vkCmdClearAttachments(commands.get(), 1, &black, 1, &all);
            }
            strands.draw(commands);
            target.endRendering(commands, strands.last);
        });
    }

    bool drawsAtOnce() const override { return over_ == Over::picture; }

private:
    StrandOutput output_;
    Over over_;
};

// Shows the nearest fragment.
std::unique_ptr<StrandBlend> makeOpaqueBlend(const BlendContext& context) {
    return std::make_unique<DirectBlend>(context.settings.render, "strands/strand.frag");
}

// Shows what /render/show asks for: a colour of the nearest fragment, or a sum of counts.
// `overdraw` counts the fragments that pass the depth test in drawing order; `density` counts all
// fragments in front of the scene.
std::unique_ptr<StrandBlend> makeShownBlend(const BlendContext& context) {
    const Show show = context.settings.render.show;
    if (show == Show::overdraw || show == Show::density)
        return std::make_unique<DirectBlend>(
            StrandOutput{
                .fragment = "strands/strand_show.frag",
                .colors = {{colorFormat(context.settings.render), engine::Blend::add}},
                .depth_write = show == Show::overdraw,
                .samples = context.settings.render.msaa},
            DirectBlend::Over::black);
    return std::make_unique<DirectBlend>(context.settings.render, "strands/strand_show.frag");
}

// Shows the nearest fragment of every sample; a fragment's alpha says how many samples it covers.
std::unique_ptr<StrandBlend> makeSampleBlend(const BlendContext& context) {
    return std::make_unique<DirectBlend>(context.settings.render, "strands/samples.frag");
}

// ---- Discarded ----------------------------------------------------------------------------------

// For strands whose primitives are discarded before rasterisation. They write no attachment, and
// their rendering may only have attachments that their pipeline names. An empty rendering to the
// target comes before, so that its share of the pass is the same as in other pictures.
class DiscardedBlend : public StrandBlend {
public:
    StrandOutput output() const override { return {.depth_format = VK_FORMAT_UNDEFINED}; }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const override {
        passes.pass("strands", strands.kind, [&](engine::Commands& commands) {
            strands.prepare(commands);
            target.beginRendering(commands, engine::Load::keep, {}, strands.last);
            target.endRendering(commands, strands.last);
            const VkRect2D area{{0, 0}, target.color().extent()};
            engine::beginRendering(commands, {}, std::nullopt, area);
            strands.draw(commands);
            engine::endRendering(commands);
        });
    }
};

// Shows nothing: for StrandStages that end before raster.
std::unique_ptr<StrandBlend> makeDiscardedBlend() { return std::make_unique<DiscardedBlend>(); }

// ---- Lists of fragments -------------------------------------------------------------------------

// 4 GiB of nodes, the reach of 32-bit offsets.
constexpr std::uint64_t kMostNodes = (std::uint64_t{1} << 32u) / sizeof(gpu::FragmentNode);

// Counts the rendered pixels.
std::uint64_t pixelCount(const RenderSettings& render) {
    return std::uint64_t{render.width} * render.ssaa * render.height * render.ssaa;
}

// Returns the number of fragments that the lists have room for.
std::uint64_t nodeCount(const RenderSettings& render) {
    return render.list_length * pixelCount(render);
}

std::uint32_t capacity(const BlendContext& context) {
    context.device.require(engine::Feature::fragment_stores, "/render/transparency: fragment_list");
    const std::uint64_t nodes = nodeCount(context.settings.render);
    if (nodes > kMostNodes) {
        throw engine::Unsupported(
            "fragment_list", std::to_string(nodes) + " fragments do not fit 4 GiB");
    }
    return static_cast<std::uint32_t>(nodes);
}

engine::MemoryRows listRows(const RenderSettings& render) {
    return {
        "transparency",
        {{"fragment heads", engine::bytesOf<std::uint32_t>(pixelCount(render))},
         {"fragment nodes", engine::bytesOf<gpu::FragmentNode>(nodeCount(render))},
         {"fragment counter", sizeof(std::uint32_t)},
         {"fragment lists", sizeof(gpu::FragmentLists)}}};
}

class ListBlend : public StrandBlend {
public:
    explicit ListBlend(const BlendContext& context)
        : device_(context.device), samples_(context.settings.render.msaa),
          capacity_(capacity(context)),
          composite_(device_, compositePipeline(context.settings.render, "composite/list.frag")) {
        const engine::MemoryRows rows = listRows(context.settings.render);
        heads_ = {device_, rows["fragment heads"]};
        nodes_ = {device_, rows["fragment nodes"]};
        counter_ = {device_, rows["fragment counter"]};
        lists_ = engine::makeBuffer(
            device_,
            std::array{gpu::FragmentLists{
                .heads = heads_.address(),
                .nodes = nodes_.address(),
                .counters = counter_.address(),
                .capacity = capacity_,
                .width = context.target.color().extent().width,
                .height = context.target.color().extent().height}},
            rows, "fragment lists");
    }

    StrandOutput output() const override {
        return {.fragment = "strands/list.frag", .depth_write = false, .samples = samples_};
    }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const override {
        passes.pass("strands", strands.kind, [&](engine::Commands& commands) {
            list(commands, target, strands);
        });
        passes.pass("composite", engine::PassKind::graphics, [&](engine::Commands& commands) {
            target.beginRendering(commands, engine::Load::keep, {}, strands.last);
            commands.uses({{heads_, Access::fragment_read}, {nodes_, Access::fragment_read}});
            commands.bind(
                composite_, gpu::CompositePush{.fragments = fragments(), .sample_index = 0});
            commands.draw({.vertices = 3});
            target.endRendering(commands, strands.last);
        });
    }

    std::uint64_t fragments() const override { return lists_.address(); }

    std::uint64_t bytes() const override {
        return heads_.size() + nodes_.size() + counter_.size() + lists_.size();
    }

    std::optional<ListedFragments> listed() const override {
        return ListedFragments{
            .capacity = capacity_,
            .wanted = engine::downloadAs<std::uint32_t>(device_, counter_).front()};
    }

private:
    void list(
        engine::Commands& commands, const engine::Target& target,
        const RecordedStrands& strands) const {
        strands.prepare(commands);
        commands.fill(heads_, gpu::kNoFragment);
        commands.fill(counter_, 0);
        engine::beginRendering(commands, {}, engine::Attachment{.image = &target.depth()});
        commands.uses(
            {{heads_, Access::fragment_write},
             {nodes_, Access::fragment_write},
             {counter_, Access::fragment_write}});
        strands.draw(commands);
        engine::endRendering(commands);
    }

    const engine::Device& device_;
    std::uint32_t samples_;
    std::uint32_t capacity_;  // nodes
    engine::Buffer heads_;
    engine::Buffer nodes_;
    engine::Buffer counter_;
    engine::Buffer lists_;  // gpu::FragmentLists
    engine::GraphicsPipeline composite_;
};

// Blends all fragments in order of depth, from a list for each pixel.
std::unique_ptr<StrandBlend> makeListBlend(const BlendContext& context) {
    return std::make_unique<ListBlend>(context);
}

// ---- Weighted mean ------------------------------------------------------------------------------

// Formats that every device can blend.
constexpr VkFormat kSumFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRevealedFormat = VK_FORMAT_R16_SFLOAT;

engine::ImageDescription sumImage(const RenderSettings& render, VkFormat format, const char* name) {
    return {
        .format = format,
        .width = render.width * render.ssaa,
        .height = render.height * render.ssaa,
        .samples = render.msaa,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
        .name = name,
        .purpose = "transparency"};
}
engine::ImageDescription sumOf(const RenderSettings& render) {
    return sumImage(render, kSumFormat, "weighted sum");
}
engine::ImageDescription revealedPartOf(const RenderSettings& render) {
    return sumImage(render, kRevealedFormat, "revealed part");
}

engine::MemoryRows weightedRows(const RenderSettings& render) {
    engine::MemoryRows rows("transparency", {{"blend range", sizeof(gpu::BlendRange)}});
    rows.add(sumOf(render));
    rows.add(revealedPartOf(render));
    return rows;
}

engine::GraphicsDescription composite(const RenderSettings& render) {
    engine::GraphicsDescription description = compositePipeline(
        render,
        render.msaa > 1 ? "composite/weighted.frag+multisample" : "composite/weighted.frag");
    description.sampled_images = 2;
    return description;
}

const engine::Device& checked(const engine::Device& device) {
    device.require(engine::Feature::independent_blend, "/render/transparency: weighted_blended");
    return device;
}

class WeightedBlend : public StrandBlend {
public:
    explicit WeightedBlend(const BlendContext& context)
        : samples_(context.settings.render.msaa),
          bytes_(
              engine::imageBytes(sumOf(context.settings.render)) +
              engine::imageBytes(revealedPartOf(context.settings.render))),
          range_(engine::makeBuffer(
              checked(context.device),
              std::array{gpu::BlendRange{context.view.centre, context.view.radius}},
              weightedRows(context.settings.render), "blend range")),
          sum_(context.device, sumOf(context.settings.render)),
          revealed_(context.device, revealedPartOf(context.settings.render)),
          sampler_(context.device, {.filter = VK_FILTER_NEAREST}),
          composite_(context.device, composite(context.settings.render)) {}

    StrandOutput output() const override {
        return {
            .fragment = "strands/weighted.frag",
            .colors =
                {{kSumFormat, engine::Blend::add}, {kRevealedFormat, engine::Blend::attenuate}},
            .depth_write = false,
            .samples = samples_};
    }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const override {
        passes.pass("strands", strands.kind, [&](engine::Commands& commands) {
            sumUp(commands, target, strands);
        });
        passes.pass("composite", engine::PassKind::graphics, [&](engine::Commands& commands) {
            blend(commands, target, strands.last);
        });
    }

    std::uint64_t fragments() const override { return range_.address(); }

    std::uint64_t bytes() const override { return bytes_; }

private:
    void sumUp(
        engine::Commands& commands, const engine::Target& target,
        const RecordedStrands& strands) const {
        strands.prepare(commands);
        for (const engine::Image* image : {&sum_, &revealed_}) {
            commands.transition(
                *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        }
        const std::array sums{
            engine::Attachment{.image = &sum_, .load = engine::Load::clear, .clear = {}},
            engine::Attachment{.image = &revealed_, .load = engine::Load::clear, .clear = {1}}};
        engine::beginRendering(commands, sums, engine::Attachment{.image = &target.depth()});
        strands.draw(commands);
        engine::endRendering(commands);
    }

    void blend(
        engine::Commands& commands, const engine::Target& target, engine::Target::Last last) const {
        for (const engine::Image* image : {&sum_, &revealed_}) {
            commands.transition(
                *image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
        target.beginRendering(commands, engine::Load::keep, {}, last);
        // One draw per sample, because sample-rate shading is a feature that not every device has.
        for (std::uint32_t i = 0; i < samples_; ++i) {
            commands.bind(composite_, gpu::CompositePush{.fragments = 0, .sample_index = i});
            commands.images(
                composite_, std::array{
                                engine::SampledImage{&sum_, &sampler_},
                                engine::SampledImage{&revealed_, &sampler_}});
            commands.draw({.vertices = 3});
        }
        target.endRendering(commands, last);
    }

    std::uint32_t samples_;
    std::uint64_t bytes_;
    engine::Buffer range_;  // gpu::BlendRange
    engine::Image sum_;
    engine::Image revealed_;
    engine::Sampler sampler_;
    engine::GraphicsPipeline composite_;
};

// Blends a weighted mean of all fragments: McGuire and Bavoil 2013.
std::unique_ptr<StrandBlend> makeWeightedBlend(const BlendContext& context) {
    return std::make_unique<WeightedBlend>(context);
}

// ---- The table ----------------------------------------------------------------------------------

struct BlendRow {
    Transparency transparency;
    std::unique_ptr<StrandBlend> (*make)(const BlendContext&);
    engine::MemoryRows (*rows)(const RenderSettings&);
};

engine::MemoryRows noRows(const RenderSettings&) { return {}; }

// All kinds of transparency, one row each.
constexpr std::array kBlends{
    BlendRow{Transparency::none, makeOpaqueBlend, noRows},
    BlendRow{Transparency::alpha_to_coverage, makeSampleBlend, noRows},
    BlendRow{Transparency::weighted_blended, makeWeightedBlend, weightedRows},
    BlendRow{Transparency::fragment_list, makeListBlend, listRows},
};

const BlendRow& rowOf(Transparency transparency) {
    const auto row = std::ranges::find(kBlends, transparency, &BlendRow::transparency);
    assert(row != kBlends.end());
    return *row;
}

// Throws engine::Unsupported for features that the device lacks.
std::unique_ptr<StrandBlend> makeBlend(const BlendContext& context) {
    if (context.settings.render.show != Show::shading) return makeShownBlend(context);
    return rowOf(context.settings.render.transparency).make(context);
}

// ---- The pass -----------------------------------------------------------------------------------

bool isAnalytic(const RenderSettings& render) {
    return render.coverage == Coverage::analytic && render.show == Show::shading;
}

StrandOutput shaded(StrandOutput output, const Settings& settings) {
    output.shading = shadingConstants(settings);
    output.extensions = shaderExtensions(settings.shading.model_parameters);
    output.sampled_images = kStrandImages;
    if (output.samples > 1 && !output.fragment.empty() && !isAnalytic(settings.render))
        output.fragment += "+centroid";
    return output;
}

// A picture without hair requires no feature of the device.
StrandStages drawnStages(const Settings& settings, const StrandStages& stages) {
    return settings.render.hair ? stages : StrandStages{.last = std::nullopt};
}

std::unique_ptr<StrandBlend> blendOf(const BlendContext& context, const StrandStages& stages) {
    if (!context.settings.render.hair) return makeOpaqueBlend(context);
    return stages.last && discards(stages) ? makeDiscardedBlend() : makeBlend(context);
}

std::uint32_t environmentCode(const Settings& settings) {
    if (settings.render.environment.empty()) return gpu::kEnvironmentNone;
    return settings.shading.environment_lights > 0 ? gpu::kEnvironmentLights
                                                   : gpu::kEnvironmentHarmonics;
}

}  // namespace

engine::MemoryRows transparencyRows(const RenderSettings& render) {
    if (!render.hair || render.show != Show::shading) return {};
    return rowOf(render.transparency).rows(render);
}

engine::Constants shadingConstants(const Settings& settings) {
    const ShadingSettings& shading = settings.shading;
    const RenderSettings& render = settings.render;
    if (shading.model == ShadingModel::extension && !shading.model_parameters.file)
        throw engine::Error("/shading/model", "names a file that was not read");
    engine::Constants constants{
        {gpu::kModelConstant, shaderCode(shading.model)},
        {gpu::kLightCountConstant, static_cast<std::uint32_t>(shading.lights.size())},
        {gpu::kMeshShadowsConstant, shading.shadows.meshes},
        {gpu::kHairShadowsConstant, shaderCode(shading.shadows.hair)},
        {gpu::kEnvironmentConstant, environmentCode(settings)},
        {gpu::kLinearLightConstant, hasLinearLight(render)},
        {gpu::kAnalyticCoverageConstant, isAnalytic(render)},
        {gpu::kStrandTextureConstant, !settings.strands.texture.empty()},
        {gpu::kShowConstant, shaderCode(render.show)},
        {gpu::kLightKindsConstant, lightKinds(settings)},
        {gpu::kFarFieldConstant, shading.far_field}};
    const engine::Constants own = extensionConstants(shading.model_parameters);
    constants.insert(constants.end(), own.begin(), own.end());
    return constants;
}

StrandTexture::StrandTexture(
    const engine::Device& device, const RenderSettings& settings,
    const std::optional<engine::Pixels>& pixels)
    : texture_(
          device, pixels.value_or(engine::Pixels{1, 1, {255, 255, 255, 255}}),
          engine::Texels::display_color,
          hasLinearLight(settings) ? engine::Decoding::linear : engine::Decoding::none,
          "strand texture"),
      sampler_(
          device, {.horizontal = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                   .vertical = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}) {}

StrandPass::StrandPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const engine::Target& target, const StrandView& view, const PointsPass* points,
    const StrandStructure* structure, const StrandStages& stages)
    : blend_(blendOf(
          {.device = device, .settings = settings, .target = target, .view = view}, stages)),
      backend_(makeBackend(
          settings.strands.backend, {.device = device,
                                     .plan = plan,
                                     .strands = settings.strands,
                                     .output = shaded(blend_->output(), settings),
                                     .stages = drawnStages(settings, stages),
                                     .target = &target,
                                     .points = points,
                                     .structure = structure,
                                     .traces_shadows = tracesShadows(settings)})),
      joins_scene_(settings.render.hair && blend_->drawsAtOnce() && !readsSceneDepth(settings)) {}

void StrandPass::record(
    engine::Passes& passes, const engine::Target& target, const StrandPicture& picture,
    engine::Target::Last last) const {
    const auto prepare = [&](engine::Commands& commands) { backend_->prepare(commands, picture); };
    const auto draw = [&](engine::Commands& commands) { backend_->draw(commands, picture); };
    blend_->record(
        passes, target,
        {.kind = backend_->passKind(), .prepare = prepare, .draw = draw, .last = last});
}

}  // namespace hair::rendering
