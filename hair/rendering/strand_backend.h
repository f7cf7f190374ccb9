#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// The interface of back ends, which draw strands, and what they have in common. The list of all
// back ends, which includes them, is backends.h.
namespace hair::rendering {

class PointsPass;
class StrandStructure;

// Whether rays find the shadows of the case's hair.
inline bool tracesShadows(const Settings& settings) {
    return settings.render.hair && settings.shading.shadows.hair == HairShadows::rays;
}

// The stages of the tessellation back end that can be left out, in pipeline order. The control
// stage goes with the evaluation.
enum class StrandStage { vertex, evaluation, geometry, raster, fragment };

// The stages that a picture's strands go through: all of them, except when the cost of a stage is
// measured. Then the picture shows less of the strands, or nothing.
struct StrandStages {
    // The last stage. Absent: no strand is drawn. Before raster, primitives are discarded. With
    // raster, there is no fragment shader, and depth is written.
    std::optional<StrandStage> last = StrandStage::fragment;
    // A vertex, evaluation or geometry stage with all of its outputs watched, so that drivers can't
    // leave out work with unused results.
    std::optional<StrandStage> watched{};
    std::uint64_t watch = 0;  // StageWatch::address(), if a stage is watched

    bool operator==(const StrandStages&) const = default;
};

// Whether primitives are discarded before rasterisation.
inline bool discards(const StrandStages& stages) { return stages.last < StrandStage::raster; }

// A picture of strands, by the camera or a light.
struct StrandPicture {
    std::uint64_t address = 0;  // of `parameters` on the device
    const gpu::PictureParameters& parameters;
    std::span<const engine::SampledImage> images{};  // those of StrandOutput::sampled_images
};

// Draws all strands of a picture into the target that is being rendered to. Every back end draws
// the same strands; they differ in the pipeline stages that make them.
class StrandBackend {
public:
    virtual ~StrandBackend() = default;

    // Memory of its own; back ends that have some hide this.
    static engine::MemoryRows rows(const engine::Device&, const Settings&, const StrandPlan&) {
        return {};
    }

    // The kind of the pass that draw() belongs to.
    virtual engine::PassKind passKind() const { return engine::PassKind::graphics; }

    // Records what draw() needs of the picture, before rendering begins.
    virtual void prepare(engine::Commands&, const StrandPicture&) const {}

    // Records the draws; within rendering, after prepare() of the same picture.
    virtual void draw(engine::Commands& commands, const StrandPicture& picture) const = 0;

    // Says which variant the device has, if devices differ; may be empty.
    virtual std::string variant() const { return {}; }

    // Expected pipeline statistics of draw(); absent if the back end has no such stages.
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
    const PointsPass* points = nullptr;  // if readsPoints()
    const StrandStructure* structure = nullptr;  // if tracedGeometry()
    bool traces_shadows = false;  // in the structure
};

// Addresses of other buffers that shaders read; 0 if they don't.
struct PictureBuffers {
    std::uint64_t guide_normals = 0;  // FramesPass::normals()
    std::uint64_t guide_turns = 0;  // FramesPass::turns()
    std::uint64_t root_corrections = 0;  // SkinnedHead::corrections()
    std::uint64_t cluster_levels = 0;  // LevelsPass::levels()
    std::uint64_t strand_order = 0;  // LevelsPass::order()
    std::uint64_t lights = 0;
    std::uint64_t optics = 0;
    std::uint64_t shadows = 0;
    std::uint64_t environment = 0;
    std::uint64_t fragments = 0;
};

// Bytes from one picture's parameters to the next one's in a buffer: GLSL assumes that a buffer
// reference is aligned to 16 bytes, unless it says otherwise.
inline constexpr std::size_t kPictureStride = (sizeof(gpu::PictureParameters) + 15) / 16 * 16;

// Returns the parameters that every shader of a picture reads. `plan` is planStrands() of the
// settings. The head stands at `offset`, m; the parameters are in its frame.
gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    const PictureBuffers& buffers, const glm::vec3& offset = glm::vec3(0.0f));

// The pipeline state of all back ends that rasterise quads in hardware; without shaders.
engine::GraphicsDescription strandPipeline(const BackendContext& context);

// Declares that the next draw or dispatch evaluates the picture's strands (Commands::uses).
void declareStrands(
    engine::Commands& commands, const gpu::PictureParameters& picture,
    engine::Access access = engine::Access::vertex_read);

// The specialization constants of every shader that includes strands/strand.glsl.
engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan);
// The scene's own code that these shaders call.
engine::ShaderExtensions strandExtensions(const StrandSettings& strands);

}  // namespace hair::rendering
