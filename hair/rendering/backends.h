#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

// Back ends, which draw strands. They differ in the pipeline stages that make the same strands.
namespace hair::rendering {

class PointsPass;

// The stages of the tessellation back end that can be left out, in pipeline order. The control
// stage goes with the evaluation.
enum class StrandStage { vertex, evaluation, geometry, raster, fragment };

// The stages that a picture's strands go through: all of them, except where the cost of a stage is
// measured. Then the picture shows less of the strands, or nothing.
struct StrandStages {
    // The last stage. Absent: no strand is drawn. Before raster, primitives are discarded. With
    // raster, there is no fragment shader, and depth is written.
    std::optional<StrandStage> last = StrandStage::fragment;
    // A vertex, evaluation or geometry stage with all of its outputs watched, so that drivers can't
    // leave out work with unused results.
    std::optional<StrandStage> watched{};
    std::uint64_t watch = 0;  // StageWatch::address(), where a stage is watched

    bool operator==(const StrandStages&) const = default;
};

// Whether primitives are discarded before rasterisation.
inline bool discards(const StrandStages& stages) { return stages.last < StrandStage::raster; }

// A picture of strands, by the camera or a light.
struct StrandPicture {
    std::uint64_t address = 0;  // of `parameters` on the device
    const gpu::PictureParameters& parameters;
    std::span<const engine::SampledImage> images{};  // StrandOutput::sampled_images of them
};

// Draws all strands of a picture into the target that is being rendered to. Every back end draws
// the same strands; they differ in the pipeline stages that make them.
class StrandBackend {
public:
    virtual ~StrandBackend() = default;

    // The kind of the pass that draw() belongs to.
    virtual engine::PassKind passKind() const { return engine::PassKind::graphics; }

    // Records what draw() needs of the picture, before rendering begins.
    virtual void prepare(engine::Commands&, const StrandPicture&) const {}

    // Records the draws; within rendering, after prepare() of the same picture.
    virtual void draw(engine::Commands& commands, const StrandPicture& picture) const = 0;

    // Says which variant the device has, where devices differ; may be empty.
    virtual std::string variant() const { return {}; }

    // Expected pipeline statistics of draw(); absent where the back end has no such stages.
    virtual std::optional<ExpectedCounts> expected() const = 0;
};

// The target that strands' quads face; it decides the values at their corners.
enum class QuadKind {
    camera,  // the eye; shaded by strands/fragment.glsl
    // A light. Quads are at least a texel of its map wide and carry the strand's share of that
    // width.
    light,
};

// The last stages of the pipeline, and the attachments that they write to.
struct StrandOutput {
    QuadKind quads = QuadKind::camera;
    std::string fragment;
    std::vector<engine::ColorTarget> colors;
    VkFormat depth_format = engine::Target::kDepthFormat;
    bool depth_write = true;
    std::uint32_t samples = 1;
    engine::Constants shading;  // shadingConstants
    engine::ShaderExtensions extensions{};  // for shading
    std::uint32_t sampled_images = 0;
};

struct BackendContext {
    const engine::Device& device;
    const StrandPlan& plan;
    const StrandSettings& strands;
    StrandOutput output;
    StrandStages stages{};
    const engine::Target* target = nullptr;  // of the camera's picture
    const PointsPass* points = nullptr;  // where readsPoints()
};

// Throws engine::Unsupported for stages that the back end or the device lacks. Quads that face a
// light are drawn by mapBackend().
std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context);

// Returns the back end that draws shadow maps for this one: itself, or another where it draws none.
Backend mapBackend(Backend backend);

// Throws engine::Unsupported where the device can't draw the case's strands by the back end: the
// device lacks stages, or there are more strands than shaders can number.
void checkDevice(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan);

// Whether the case's back end draws from the points of a PointsPass.
bool readsPoints(const Settings& settings);

// Whether the case's back end reads the depth of the scene.
bool readsSceneDepth(const Settings& settings);

// The pipeline state of all back ends that rasterise quads in hardware; without shaders.
engine::GraphicsDescription strandPipeline(const BackendContext& context);

// Declares that the next draw evaluates the picture's strands (Commands::uses).
void declareStrands(engine::Commands& commands, const gpu::PictureParameters& picture);

// The specialization constants of every shader that includes strands/strand.glsl.
engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan);
// The scene's own code that these shaders call.
engine::ShaderExtensions strandExtensions(const StrandSettings& strands);

// Adds up the outputs of watched stages. A condition on an invocation's outputs decides whether
// they are added. Drivers can't predict it, so they must do the work of all invocations. The
// additions are atomic and need no order, so Commands::uses() need not know of them.
class StageWatch {
public:
    // Starts in the state of seeNone(). Throws engine::Unsupported where stages before the
    // rasteriser can't write to buffers.
    explicit StageWatch(const engine::Device& device);

    std::uint64_t address() const { return buffer_.address(); }

    // Adds up every invocation from the next frame on, which is slow. The device must have finished
    // the last frame.
    void seeAll();
    // Adds up almost no invocation from the next frame on (one of 2^32 for random outputs), at the
    // cost of a comparison. The device must have finished the last frame.
    void seeNone();

    struct Seen {
        std::uint32_t invocations = 0;
        std::uint32_t sum = 0;  // of the bits of their outputs, modulo 2^32
    };
    // Returns the sums since the last call of seeAll() or seeNone(). Waits for the device.
    Seen seen() const;

private:
    void see(std::uint32_t mask, std::uint32_t wanted);

    const engine::Device& device_;
    engine::Buffer buffer_;
};

}  // namespace hair::rendering
