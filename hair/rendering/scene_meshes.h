#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

// The head and other meshes of a picture.
namespace hair::rendering {

// Returns the mesh at the place that the settings give it.
groom::Mesh placed(groom::Mesh mesh, const MeshSettings& settings);

// Returns how much a mesh bends at each vertex, 1/m: the mean over its edges of the magnitude of
// normal curvature, (n_b - n_a) . (p_b - p_a) / |p_b - p_a|^2 for normals n and positions p, which
// is exactly 1 / r on a sphere of radius r. It is then averaged over neighbours three times,
// because skin scatters light farther than its finest folds are wide. Vertices at one place count
// as one.
std::vector<float> curvatures(const groom::Mesh& mesh);

// Returns the table of gpu::MeshPush::responses: for spheres that scatter light, what they show of
// a distant light, as a ratio to the irradiance of a surface that faces it. Skin's profile is a sum
// of Gaussians (d'Eon and Luebke 2007, Efficient Rendering of Human Skin, GPU Gems 3, chapter 14,
// table of the three-layer model). A Gaussian of variance v on a sphere of radius r multiplies the
// Legendre terms of the clamped cosine by exp(-l (l + 1) v / (2 r^2)), as the diffusion of heat
// does. Term 0 stays, so no energy is lost. Penner 2011 integrates over a ring instead, which is
// not exact for a sphere. Errors: below 4e-4, from the 1,024th term on.
std::vector<glm::vec3> scatteringResponses();

// A mesh's triangles on the device, sorted by material.
struct MeshGeometry {
    // The triangles of one material.
    struct Part {
        std::uint32_t material;
        std::uint32_t first_index;
        std::uint32_t index_count;  // above 0
    };

    enum class Scattering { none, skin };  // whether light scatters in it, if at all

    MeshGeometry(
        const engine::Device& device, const Settings& settings, const groom::Mesh& mesh,
        Scattering scattering);

    static engine::MemoryRows
    rows(const Settings& settings, const groom::Mesh& mesh, Scattering scattering);

    std::uint32_t vertices = 0;
    engine::Buffer positions;  // vec3
    engine::Buffer normals;  // vec3
    engine::Buffer indirect;  // vec3, gpu::IndirectPush; empty if there is no indirect light
    engine::Buffer curvatures;  // float; empty if it scatters no light
    engine::Buffer texture_coordinates;  // vec2; empty if the mesh has none
    engine::Buffer indices;
    std::vector<Part> parts;
};

// Number of a material's images that mesh shaders sample, at the first bindings: base colour,
// metallic and roughness, normals.
inline constexpr std::uint32_t kMaterialImages = 3;

// The properties that give a material a pipeline of its own.
struct MeshLook {
    bool base_color_texture = false;
    bool metallic_roughness_texture = false;
    bool normal_texture = false;
    bool mask = false;
    bool double_sided = false;

    auto operator<=>(const MeshLook&) const = default;
};

// A material as shaders read it.
struct MeshMaterial {
    MeshLook look;
    glm::vec3 base_color;  // working colours
    float opacity;
    float metallic;
    float roughness;
    float normal_scale;
    float cutoff;
    std::array<engine::SampledImage, kMaterialImages> images;
};

// A mesh's materials, with their textures on the device. Textures of a mesh without texture
// coordinates are left out.
class MeshMaterials {
public:
    // `blank` is bound if a material has no texture.
    MeshMaterials(
        const engine::Device& device, const RenderSettings& settings, const groom::Mesh& mesh,
        const engine::SampledImage& blank);

    // At most: pictures that no material uses are left out.
    static engine::MemoryRows rows(const groom::Mesh& mesh);

    // The materials in the mesh's order.
    std::span<const MeshMaterial> materials() const { return materials_; }

private:
    // Maps keep their elements in place, because materials_ refers to them.
    std::map<std::pair<std::uint32_t, engine::Texels>, engine::Texture> textures_;
    std::map<std::tuple<groom::Wrap, groom::Wrap, bool>, engine::Sampler> samplers_;
    std::vector<MeshMaterial> materials_;
};

// The meshes of a picture on the device: the head, which moves or deforms, and others, which don't.
// They are drawn material by material.
class SceneMeshes {
public:
    SceneMeshes(const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    bool empty() const { return meshes_.empty(); }

    // Tables that all meshes share.
    static engine::MemoryRows rows(const Settings& settings);

    // Draws the head from these buffers from now on: vec3 [vertex] each, in the world.
    void deform(const engine::Buffer& positions, const engine::Buffer& normals);

    // Records the gathering of indirect light on the vertices of all meshes, with the address of
    // the picture and the sources in `push`.
    void gatherIndirect(
        engine::Commands& commands, const engine::ComputePipeline& gather,
        const engine::Buffer& sources, gpu::IndirectPush push) const;

    // Declares what draw() reads of what frames write, in front of the rendering.
    void declareDraw(engine::Commands& commands) const;

    // Draws the meshes, lit, into the target that is being rendered to. `shadows` are
    // ShadowPass::images().
    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> shadows) const;

    // Draws depth alone, of kDepthFormat and one sample, from both sides of the meshes, which may
    // be open. `picture` is the address of the gpu::PictureParameters with the view of a light or
    // the eye.
    void drawDepth(engine::Commands& commands, std::uint64_t picture) const;

private:
    enum class Motion { still, with_head };

    struct SceneMesh {
        MeshGeometry geometry;
        MeshMaterials materials;
        Motion motion;
    };

    void
    add(const engine::Device& device, const Settings& settings, const groom::Mesh& mesh,
        Motion motion);

    void bind(
        engine::Commands& commands, const engine::GraphicsPipeline& pipeline, std::uint64_t picture,
        const SceneMesh& mesh, const MeshMaterial& material) const;

    // The buffers that hold a mesh's vertices now.
    struct Vertices {
        std::uint64_t positions;
        std::uint64_t normals;
        bool is_moving;
    };
    Vertices verticesOf(const SceneMesh& mesh) const;

    std::uint64_t deformed_positions_ = 0;  // addresses; 0: the head keeps its shape
    std::uint64_t deformed_normals_ = 0;
    float scattering_;  // /shading/skin_scattering
    engine::Buffer responses_;  // scatteringResponses(); empty if no light scatters
    engine::Texture blank_;
    engine::Sampler blank_sampler_;
    std::vector<SceneMesh> meshes_;
    std::map<MeshLook, engine::GraphicsPipeline> pipelines_;
    std::map<MeshLook, engine::GraphicsPipeline> depth_pipelines_;
};

// The light that lit hair and meshes send to meshes (/shading/indirect): parts of the lights'
// shadow maps are small lights (Dachsbacher and Stamminger 2005, Reflective shadow maps), which
// each vertex gathers.
class IndirectLight {
public:
    // `settings` have the lights of an environment. Without lights, vertices get none.
    IndirectLight(const engine::Device& device, const Settings& settings);

    // Whether meshes read it.
    static bool isNeeded(const Settings& settings);
    static engine::MemoryRows rows(const Settings& settings);

    // Records it, after the maps. `shadows` are ShadowPass::images(), and `picture` is the address
    // of gpu::PictureParameters.
    void record(
        engine::Commands& commands, const SceneMeshes& meshes, std::uint64_t picture,
        std::span<const engine::SampledImage> shadows) const;

private:
    std::uint32_t side_;  // gpu::IndirectPush
    std::uint32_t count_;
    engine::Buffer sources_;
    engine::ComputePipeline make_sources_;
    engine::ComputePipeline gather_;
};

}  // namespace hair::rendering
