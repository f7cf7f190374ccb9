#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// Shadows: the views of lights, the atlas of their maps, and the passes that draw them.
namespace hair::rendering {

struct Sphere {
    glm::vec3 centre{0.0f};  // m
    float radius = 0.0f;     // m
};

// Returns a sphere that strands can't leave in any pose, except where solvers stretch them: it
// encloses their roots, with room for the length of the strands.
Sphere strandBounds(const groom::Groom& groom, const StrandSettings& settings);

// Returns the smallest sphere round both; a sphere of radius 0 counts as empty.
Sphere enclosing(const Sphere& a, const Sphere& b);

// The regions that shadow maps have to show.
struct ShadowBounds {
    Sphere receivers;  // a light's map shows all of it: the hair and the head
    Sphere range;  // the depth range of a light's map: everything that is drawn
};

// Bounds of the meshes and the hair of a picture.
class ShadowScene {
public:
    ShadowScene(const Settings& settings, const RenderAssets& assets);

    // Returns the bounds with the head and the hair at their places in `view`.
    ShadowBounds bounds(const StrandView& view) const;

private:
    Sphere head_;  // before its motion
    Sphere others_;
};

// Equal square parts of an image, in as many rows as columns or one row less.
struct ShadowAtlas {
    std::uint32_t parts = 0;
    std::uint32_t side = 0;  // of a part, px

    std::uint32_t columns() const;
    VkExtent2D extent() const;
    VkRect2D part(std::uint32_t index) const;
};

// A shadow map: its light, and the number of the point on the light that it is drawn from.
struct MapOfLight {
    std::uint32_t light = 0;
    std::uint32_t sample = 0;
};

// Returns the light moved to one point of its face or, if it is a disc at infinity, turned to one
// direction of its disc, as seen from `receiver`. Returns the light itself if it has one
// map. `index`
// is below shadowMaps(); each index stands for an equal part of the light.
LightSettings
lightSample(const LightSettings& light, const glm::vec3& receiver, std::uint32_t index);

// Whether there are shadow maps of hair. There are none if rays find its shadows.
bool hasHairMaps(const Settings& settings);

// Throws engine::Unsupported if the device has no images of this size.
void checkAtlas(const engine::Device& device, const ShadowAtlas& atlas);

// Draws shadow maps: the depth of meshes and, for hair, its depth and opacity in layers (Yuksel and
// Keyser 2008, Deep opacity maps) or what a ray through each texel meets (Lokovic and Veach 2000,
// Deep shadow maps). Each light that casts shadows has a part of an atlas. A light with a size has
// one part for its middle, or several for different points of its face
// (LightSettings::shadow_samples).
class ShadowPass {
public:
    // `points` must be set if readsPoints(), `structure` if tracesShadows(). Throws
    // engine::Unsupported if the device lacks the images.
    ShadowPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const RenderAssets& assets, const PointsPass* points = nullptr,
        const StrandStructure* structure = nullptr);

    // Without those of the back ends that draw hair in the rasteriser. `settings` have the lights
    // of an environment.
    static engine::MemoryRows rows(const Settings& settings, const StrandPlan& plan);

    // Whether record() draws hair, so that points must be recorded before.
    bool drawsHair() const { return hair_maps_; }

    // Records the passes "mesh_shadow" and "hair_shadow", if asked for. `picture` is the camera's:
    // levels of detail are those of its lod_eye. `motion`: below motions(); which of them `view`
    // shows. The maps are those of the motion recorded last.
    void record(
        engine::Passes& passes, const SceneMeshes& meshes, const StrandView& view,
        const gpu::PictureParameters& picture, std::uint32_t motion = 0);

    // Address of gpu::ShadowParameters, once recorded.
    std::uint64_t address(std::uint32_t slot, std::uint32_t motion = 0) const {
        return parameters_[place(slot, motion)].address();
    }

    // Depth of meshes, depth of hair, opacity of hair, in this order; in SHADER_READ_ONLY_OPTIMAL
    // once recorded. If there are no such shadows, images have one pixel.
    std::span<const engine::SampledImage> images() const { return images_; }

private:
    // The parameters of one map's picture.
    struct LightPicture {
        std::uint64_t address;  // of `parameters` on the device
        gpu::PictureParameters parameters;
    };
    static std::size_t place(std::uint32_t slot, std::uint32_t motion) {
        return std::size_t{motion} * engine::FrameLoop::kMaxSlots + slot;
    }
    void
    writeParameters(std::size_t place, const StrandView& view, const gpu::PictureParameters& of);
    void drawMeshes(engine::Commands& commands, const SceneMeshes& meshes) const;
    void drawHair(engine::Commands& commands) const;
    void rasterizeHair(engine::Commands& commands) const;

    Settings settings_;
    ShadowScene scene_;
    std::vector<MapOfLight> maps_;  // [part of the atlas]
    bool mesh_maps_;
    bool hair_maps_;
    const StrandStructure* structure_;  // null if no rays find the hair's shadows
    ShadowAtlas atlas_;
    std::vector<engine::Buffer> parameters_;  // [place()]
    std::vector<engine::Buffer> pictures_;  // [place()]
    engine::Image mesh_depths_;
    engine::Image hair_depths_;
    engine::Image hair_layers_;
    engine::Sampler sampler_;
    std::vector<engine::SampledImage> images_;
    glm::vec3 mesh_color_;
    glm::vec3 transmittance_;
    // Values of the frame that is recorded:
    std::vector<LightPicture> light_pictures_;
    std::vector<std::byte> written_;  // into pictures_
    std::optional<MapRasterizer> rasterizer_;  // if drawsMapsInCompute()
    std::unique_ptr<StrandBackend> depth_;  // otherwise
    std::unique_ptr<StrandBackend> opacity_;
};

}  // namespace hair::rendering
