#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// The pass that draws strands: kinds of transparency, their texture, and the pass itself.
namespace hair::rendering {

// Capacity of the lists of fragments, and the number of fragments that a picture had.
struct ListedFragments {
    std::uint64_t capacity = 0;
    std::uint64_t wanted = 0;

    std::uint64_t dropped() const { return wanted > capacity ? wanted - capacity : 0; }
};

// Commands that a back end records for a picture's strands.
struct RecordedStrands {
    engine::PassKind kind;  // of the pass that draws them
    engine::FunctionRef<void(engine::Commands&)> prepare;  // before rendering begins
    engine::FunctionRef<void(engine::Commands&)> draw;  // within it
    engine::Target::Last last;  // whether the picture is complete afterwards
};

// One kind of transparency: how strands' fragments are blended.
class StrandBlend {
public:
    virtual ~StrandBlend() = default;

    // The outputs of a back end's pipeline, without the shading of strands.
    virtual StrandOutput output() const = 0;

    // Records the pass "strands", which draws them, and "composite", if there is one.
    virtual void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const = 0;

    // Whether record() only draws into the target, so that the strands can join a rendering that
    // has already drawn into it.
    virtual bool drawsAtOnce() const { return false; }

    // The value of PictureParameters::fragments.
    virtual std::uint64_t fragments() const { return 0; }

    // Bytes of memory that transparency takes beside the target.
    virtual std::uint64_t bytes() const { return 0; }

    // Counts the fragments of the last picture; waits for the device. Absent if they are not
    // listed.
    virtual std::optional<ListedFragments> listed() const { return std::nullopt; }
};

engine::MemoryRows transparencyRows(const RenderSettings& render);

// The specialization constants of shaders/shading/options.glsl.
engine::Constants shadingConstants(const Settings& settings);

// Number of images that fragment shaders of strands sample, bound in this order: the strands'
// texture, then ShadowPass::images().
inline constexpr std::uint32_t kStrandImages = 4;

// The texture of strands on the device, for strands/texture.glsl. Its colours become working
// colours. If there is none, it is one white pixel.
class StrandTexture {
public:
    StrandTexture(
        const engine::Device& device, const RenderSettings& settings,
        const std::optional<engine::Pixels>& pixels);

    engine::SampledImage image() const { return {&texture_.image(), &sampler_}; }

private:
    engine::Texture texture_;
    engine::Sampler sampler_;
};

// Draws a picture's strands with the transparency of the settings: the pass "strands" and, if
// fragments are blended after all of them are known, "composite".
class StrandPass {
public:
    // weighted_blended uses the bounding sphere of the strands in `view`. `points` must be set if
    // readsPoints(), `structure` if tracedGeometry(). Throws engine::Unsupported for features that
    // the device lacks.
    StrandPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const engine::Target& target, const StrandView& view, const PointsPass* points,
        const StrandStructure* structure = nullptr, const StrandStages& stages = {});

    // The picture's images are the kStrandImages that strands/fragment.glsl samples. `last` says
    // whether the picture is complete afterwards.
    void record(
        engine::Passes& passes, const engine::Target& target, const StrandPicture& picture,
        engine::Target::Last last) const;

    // Whether scene and strands may share one rendering: prepare() before it and draw() in it,
    // instead of record().
    bool joinsScene() const { return joins_scene_; }
    void prepare(engine::Commands& commands, const StrandPicture& picture) const {
        backend_->prepare(commands, picture);
    }
    void draw(engine::Commands& commands, const StrandPicture& picture) const {
        backend_->draw(commands, picture);
    }
    engine::PassKind passKind() const { return backend_->passKind(); }

    // The value of PictureParameters::fragments.
    std::uint64_t fragments() const { return blend_->fragments(); }

    std::string backendVariant() const { return backend_->variant(); }
    std::optional<ExpectedCounts> expected() const { return backend_->expected(); }

    const StrandBlend& blend() const { return *blend_; }

private:
    std::unique_ptr<StrandBlend> blend_;
    std::unique_ptr<StrandBackend> backend_;
    bool joins_scene_;
};

}  // namespace hair::rendering
