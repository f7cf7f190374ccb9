#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/settings.h"

// Shadows: what lights look at, the atlas of their maps, and the passes that draw them.
namespace hair::rendering {

struct Sphere {
    glm::vec3 centre{0.0f};  // m
    float radius = 0.0f;     // m
};

// A sphere that strands can't leave however they hang, but for what solvers stretch them: about
// their roots, as far as they are long.
Sphere strandBounds(const groom::Groom& groom, const StrandSettings& settings);

// The least sphere round both; a sphere of no radius counts as none.
Sphere enclosing(const Sphere& a, const Sphere& b);

// What lights have to see.
struct ShadowBounds {
    Sphere seen;  // a light's map shows all of it: the hair and the head
    Sphere range;  // a light's map reaches from its near to its far end: all that is drawn
};

// Where the bodies and the hair of a picture are.
class ShadowScene {
public:
    ShadowScene(const Settings& settings, const RenderAssets& assets);

    // The bounds with the head and the hair where `view` has them.
    ShadowBounds bounds(const StrandView& view) const;

private:
    Sphere head_;  // before it moved
    Sphere others_;
};

// Square parts of one size in an image: in rows, as many of them as columns or one less.
struct ShadowAtlas {
    std::uint32_t parts = 0;
    std::uint32_t side = 0;  // of a part, px

    std::uint32_t columns() const;
    VkExtent2D extent() const;
    VkRect2D part(std::uint32_t index) const;
};

// A shadow map: the light, and which of the light's points it is seen from.
struct MapOfLight {
    std::uint32_t light = 0;
    std::uint32_t sample = 0;
};

// A light like this one but in one point of its face, or direction of its disc, as it is seen from
// `seen`: the light itself where it has one map. `index`, below shadowMaps(), tells apart those
// that stand for equal parts of its light.
LightSettings lightSample(const LightSettings& light, const glm::vec3& seen, std::uint32_t index);

// Whether there are maps of hair.
bool hasHairMaps(const Settings& settings);

// B of all lights' maps, those of an environment's lights among them.
std::uint64_t shadowMapBytes(const Settings& settings);

// Throws engine::Unsupported where the device has no such images.
void checkAtlas(const engine::Device& device, const ShadowAtlas& atlas);

// What lights see: the depth of meshes, and of hair its depth and opacity in layers (Yuksel and
// Keyser 2008, Deep opacity maps) or what a ray through each texel meets (Lokovic and Veach 2000,
// Deep shadow maps). Each light that throws shadows has a part of an atlas; one with a size that of
// its middle, or several, each of another point of its face (LightSettings::shadow_samples).
class ShadowPass {
public:
    // `points` are there where readsPoints(). Throws engine::Unsupported where the device lacks the
    // images.
    ShadowPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const RenderAssets& assets, const PointsPass* points = nullptr);

    // The passes "mesh_shadow" and "hair_shadow", where asked for. `picture` is what the camera's
    // picture reads: levels of detail are those of its lod_eye.
    void record(
        engine::Passes& passes, const SceneMeshes& meshes, const StrandView& view,
        const gpu::PictureParameters& picture);

    // Address of gpu::ShadowParameters, once recorded.
    std::uint64_t address(std::uint32_t slot) const { return parameters_[slot].address(); }

    // Depth of meshes, depth of hair, opacity of hair, in this order; in SHADER_READ_ONLY_OPTIMAL
    // once recorded. Images of one pixel where there are no such shadows.
    std::span<const engine::SampledImage> images() const { return images_; }

private:
    // What a light sees.
    struct LightPicture {
        std::uint64_t address;  // of `parameters` on the device
        gpu::PictureParameters parameters;
    };
    void
    writeParameters(std::uint32_t slot, const StrandView& view, const gpu::PictureParameters& of);
    void drawMeshes(engine::Commands& commands, const SceneMeshes& meshes) const;
    void drawHair(engine::Commands& commands) const;

    Settings settings_;
    ShadowScene scene_;
    std::vector<MapOfLight> maps_;  // of the atlas's parts
    bool mesh_maps_;
    bool hair_maps_;
    ShadowAtlas atlas_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> parameters_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> pictures_;
    engine::Image mesh_depths_;
    engine::Image hair_depths_;
    engine::Image hair_layers_;
    engine::Sampler sampler_;
    std::vector<engine::SampledImage> images_;
    glm::vec3 mesh_color_;
    // Of the frame that is recorded:
    std::vector<LightPicture> seen_;
    std::vector<std::byte> written_;  // into pictures_
    std::unique_ptr<StrandBackend> depth_;
    std::unique_ptr<StrandBackend> opacity_;
};

}  // namespace hair::rendering
