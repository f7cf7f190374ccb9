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
#include "engine/texture.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/settings.h"

// The pass that draws strands: kinds of transparency, their texture, and the pass itself.
namespace hair::rendering {

// How many of a picture's fragments the lists have room for, and how many there were.
struct ListedFragments {
    std::uint64_t capacity = 0;
    std::uint64_t wanted = 0;

    std::uint64_t dropped() const { return wanted > capacity ? wanted - capacity : 0; }
};

// What a back end records of a picture's strands.
struct RecordedStrands {
    engine::PassKind kind;  // of the pass that draws them
    engine::FunctionRef<void(engine::Commands&)> prepare;  // before rendering begins
    engine::FunctionRef<void(engine::Commands&)> draw;  // within it
    engine::Target::Last last;  // whether the picture is complete then
};

// What becomes of strands' fragments: one kind of transparency.
class StrandBlend {
public:
    virtual ~StrandBlend() = default;

    // What a back end's pipeline writes, but for how strands are shaded.
    virtual StrandOutput output() const = 0;

    // The pass "strands", which draws them, and "composite", where there is one.
    virtual void record(
        engine::Passes& passes, const engine::Target& target,
        const RecordedStrands& strands) const = 0;

    // Whether record() but draws into the target, so that what has been drawn there may go before
    // in the same rendering.
    virtual bool drawsAtOnce() const { return false; }

    // The value of PictureParameters::fragments.
    virtual std::uint64_t fragments() const { return 0; }

    // Memory that transparency takes beside the target.
    virtual std::uint64_t bytes() const { return 0; }

    // The fragments of the last picture; waits for the device. Absent where they are not listed.
    virtual std::optional<ListedFragments> listed() const { return std::nullopt; }
};

// B of what transparency takes beside a picture's target.
std::uint64_t transparencyBytes(const RenderSettings& render);

// The specialization constants of shaders/shading/options.glsl.
engine::Constants shadingConstants(const Settings& settings);

// What fragment shaders of strands sample, at these bindings: the strands' texture, then
// ShadowPass::images().
inline constexpr std::uint32_t kStrandImages = 4;

// The picture on strands, on the device, for strands/texture.glsl: its colours become working
// colours. One white pixel where there is none.
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

// Draws a picture's strands with the transparency that is asked for: the pass "strands" and, where
// fragments are blended after all are known, "composite".
class StrandPass {
public:
    // `view` has the sphere that the strands can't leave, which weighted_blended goes by; `points`
    // are there where readsPoints(). Throws engine::Unsupported for what the device lacks.
    StrandPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const engine::Target& target, const StrandView& view, const PointsPass* points,
        const StrandStages& stages = {});

    // The picture's images are the kStrandImages that strands/fragment.glsl samples. `last` says
    // whether the picture is complete then.
    void record(
        engine::Passes& passes, const engine::Target& target, const StrandPicture& picture,
        engine::Target::Last last) const;

    // Whether scene and strands may be drawn in one rendering: by prepare() before it and draw() in
    // it, instead of record().
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
