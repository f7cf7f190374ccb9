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

// What draws strands: back ends, which differ in the pipeline stages that make the same strands.
namespace hair::rendering {

class PointsPass;

// The stages of the tessellation back end that can be left away, in the order in which strands go
// through them. The control stage goes with the evaluation.
enum class StrandStage { vertex, evaluation, geometry, raster, fragment };

// Which stages a picture's strands go through. All of them, but where it is measured what a stage
// costs: then there is less to see of the strands, or nothing.
struct StrandStages {
    // Absent: no strand is drawn. Before raster, primitives are discarded; raster alone has no
    // fragment shader and writes depth.
    std::optional<StrandStage> last = StrandStage::fragment;
    // Vertex, evaluation or geometry: all that it makes goes into something that can be seen, or
    // drivers would leave the work away that nothing comes of.
    std::optional<StrandStage> watched{};
    std::uint64_t watch = 0;  // StageWatch::address(), where a stage is watched

    bool operator==(const StrandStages&) const = default;
};

// Whether primitives end before they are rasterised.
inline bool discards(const StrandStages& stages) { return stages.last < StrandStage::raster; }

// A picture of strands, by the camera or a light.
struct StrandPicture {
    std::uint64_t address = 0;  // of `parameters` on the device
    const gpu::PictureParameters& parameters;
    std::span<const engine::SampledImage> images{};  // as many as StrandOutput says
};

// Draws all strands of a picture into the target that is being rendered to. Every back end draws
// the same strands; they differ in the pipeline stages that make them.
class StrandBackend {
public:
    virtual ~StrandBackend() = default;

    // What draw() draws from.
    virtual engine::PassKind passKind() const { return engine::PassKind::graphics; }

    // Records what draw() needs of the picture, before rendering begins.
    virtual void prepare(engine::Commands&, const StrandPicture&) const {}

    // Records the draws; within rendering, after prepare() of the same picture.
    virtual void draw(engine::Commands& commands, const StrandPicture& picture) const = 0;

    // How it was made for the device, where devices differ; may be empty.
    virtual std::string variant() const { return {}; }

    // What the pipeline statistics of draw() must be; absent where the back end has no such stages.
    virtual std::optional<ExpectedCounts> expected() const = 0;
};

// What strands' quads face, and so what is known at their corners.
enum class QuadKind {
    camera,  // the eye; what strands/fragment.glsl shades
    light,  // a light; at least a texel of its map wide, with the share that the strand covers of
            // it
};

// What becomes of strands' quads: the last stages of the pipeline and what they write to.
struct StrandOutput {
    QuadKind quads = QuadKind::camera;
    std::string fragment;
    std::vector<engine::ColorTarget> colors;
    VkFormat depth_format = engine::Target::kDepthFormat;
    bool depth_write = true;
    std::uint32_t samples = 1;
    engine::Constants shading;  // shadingConstants
    engine::ShaderExtensions extensions{};  // that shade
    std::uint32_t sampled_images = 0;
};

struct BackendContext {
    const engine::Device& device;
    const StrandPlan& plan;
    const StrandSettings& strands;
    StrandOutput output;
    StrandStages stages{};
    const engine::Target* target = nullptr;  // what the camera's picture is drawn to
    const PointsPass* points = nullptr;  // where readsPoints()
};

// Throws engine::Unsupported for stages that the back end or the device doesn't have. Quads that
// face a light are those of mapBackend().
std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context);

// The back end that draws lights' maps for one: itself, or where it draws none another.
Backend mapBackend(Backend backend);

// Throws engine::Unsupported where the device can't draw the case's strands by the back end: it
// lacks stages of it, or the strands are more than its shaders number.
void checkDevice(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan);

// Whether the case's back end draws from points that are evaluated before.
bool readsPoints(const Settings& settings);

// Whether the case's back end reads the depth of what the scene has drawn.
bool readsSceneDepth(const Settings& settings);

// The pipeline state that all back ends share whose quads are rasterised by hardware; without
// shaders.
engine::GraphicsDescription strandPipeline(const BackendContext& context);

// Says that what is drawn next evaluates the picture's strands (Commands::uses).
void declareStrands(engine::Commands& commands, const gpu::PictureParameters& picture);

// The specialization constants of every shader that includes strands/strand.glsl.
engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan);
// What they call of the scene.
engine::ShaderExtensions strandExtensions(const StrandSettings& strands);

// Where watched stages leave a trace: a condition on what an invocation made decides whether it is
// added up. Drivers can't know it, so that they must do the work of all. Sums are atomic, so they
// need no order and are no use that Commands::uses() would have to know of.
class StageWatch {
public:
    // Starts as seeNone() leaves it. Throws engine::Unsupported where stages before the rasteriser
    // can't store.
    explicit StageWatch(const engine::Device& device);

    std::uint64_t address() const { return buffer_.address(); }

    // Adds up every invocation, which costs much. From the next frame on; the device must be done
    // with the last one.
    void seeAll();
    // Adds up next to no invocation, one of 2^32 for outputs without order, which costs a
    // comparison. From the next frame on; the device must be done with the last one.
    void seeNone();

    struct Seen {
        std::uint32_t invocations = 0;
        std::uint32_t sum = 0;  // of the bits of what they made, modulo 2^32
    };
    // What was added up since the last call of seeAll() or seeNone(). Waits for the device.
    Seen seen() const;

private:
    void see(std::uint32_t mask, std::uint32_t wanted);

    const engine::Device& device_;
    engine::Buffer buffer_;
};

}  // namespace hair::rendering
