#include "hair/rendering/scene_meshes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_pass.h"

namespace hair::rendering {
namespace {

constexpr std::uint32_t kShadowImages = 3;  // ShadowPass::images(), bound after a material's

// Returns the corner indices of the triangles, sorted by material.
std::vector<std::uint32_t> sortedIndices(const groom::Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(
        order, {}, [&](std::uint32_t triangle) { return mesh.triangle_materials[triangle]; });
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * order.size());
    for (const std::uint32_t triangle : order)
        indices.insert(
            indices.end(), mesh.triangles[triangle].begin(), mesh.triangles[triangle].end());
    return indices;
}

VkSamplerAddressMode addressMode(groom::Wrap wrap) {
    switch (wrap) {
    case groom::Wrap::repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case groom::Wrap::mirror:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case groom::Wrap::clamp:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

MeshLook lookOf(const groom::Mesh& mesh, const groom::Material& material) {
    const bool is_mapped = !mesh.texture_coordinates.empty();
    return {
        .base_color_texture = is_mapped && material.base_color_texture,
        .metallic_roughness_texture = is_mapped && material.metallic_roughness_texture,
        .normal_texture = is_mapped && material.normal_texture,
        .mask = material.cutoff.has_value(),
        .double_sided = material.double_sided};
}

// How many sources of indirect light there are.
struct IndirectSources {
    std::uint32_t side;  // gpu::IndirectPush
    std::uint32_t count;
};

IndirectSources indirectSources(const Settings& settings) {
    const auto lights = static_cast<std::uint32_t>(settings.shading.lights.size());
    if (lights == 0) return {0, 0};
    const auto side = static_cast<std::uint32_t>(
        std::sqrt(static_cast<double>(gpu::kMostIndirectSources) / (2.0 * lights)));
    return {side, 2 * lights * side * side};
}

bool scatters(const Settings& settings) { return settings.shading.skin_scattering > 0.0f; }

// The specialization constants of shaders/scene/options.glsl and shading/options.glsl.
engine::Constants meshConstants(const MeshLook& look, const Settings& settings) {
    engine::Constants constants{
        {gpu::kBaseColorTextureConstant, look.base_color_texture},
        {gpu::kMetallicRoughnessTextureConstant, look.metallic_roughness_texture},
        {gpu::kNormalTextureConstant, look.normal_texture},
        {gpu::kMaskConstant, look.mask},
        {gpu::kDoubleSidedConstant, look.double_sided}};
    const engine::Constants shading = shadingConstants(settings);
    constants.insert(constants.end(), shading.begin(), shading.end());
    return constants;
}

engine::GraphicsDescription pipeline(const MeshLook& look, const Settings& settings) {
    const std::string indirect = settings.shading.indirect ? "+indirect" : "";
    const std::string scattering = scatters(settings) ? "+scattering" : "";
    const std::string shadows = tracesShadows(settings) ? "+rays" : indirect;
    return {
        .shaders =
            {"scene/mesh.vert" + indirect + scattering, "scene/mesh.frag" + shadows + scattering},
        .constants = meshConstants(look, settings),
        .push_size = sizeof(gpu::MeshPush),
        .colors = {{colorFormat(settings.render)}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = settings.render.msaa,
        .cull = look.double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT,
        .sampled_images = kMaterialImages + kShadowImages};
}

// The properties of a look that affect depth.
MeshLook depthLook(const MeshLook& look) {
    return {.base_color_texture = look.mask && look.base_color_texture, .mask = look.mask};
}

engine::GraphicsDescription depthPipeline(const MeshLook& look, const Settings& settings) {
    engine::GraphicsDescription description{
        .shaders = {"scene/mesh.vert"},
        .constants = meshConstants(look, settings),
        .push_size = sizeof(gpu::MeshPush),
        .depth_format = engine::Target::kDepthFormat};
    if (look.mask) {
        description.shaders.push_back("scene/mesh_depth.frag");
        description.sampled_images = kMaterialImages;
    }
    return description;
}

}  // namespace

// ---- Geometry -----------------------------------------------------------------------------------

groom::Mesh placed(groom::Mesh mesh, const MeshSettings& settings) {
    glm::mat4 turn(1.0f);
    for (int axis = 2; axis >= 0; --axis) {
        glm::vec3 direction(0.0f);
        direction[axis] = 1.0f;
        turn = glm::rotate(turn, glm::radians(settings.rotation[axis]), direction);
    }
    const glm::mat3 rotation(turn);
    for (glm::vec3& position : mesh.positions)
        position = settings.translation + rotation * (settings.scale * position);
    for (glm::vec3& normal : mesh.normals) normal = rotation * normal;
    return mesh;
}

engine::MemoryRows
MeshGeometry::rows(const Settings& settings, const groom::Mesh& mesh, Scattering scattering) {
    const std::size_t positions = engine::bytesOf<glm::vec3>(mesh.positions.size());
    engine::MemoryRows rows(
        "meshes",
        {{"mesh positions", positions},
         {"mesh normals", positions},
         {"mesh texture coordinates", engine::bytesOf<glm::vec2>(mesh.texture_coordinates.size())},
         {"mesh indices", engine::bytesOf<std::uint32_t>(3 * mesh.triangles.size())}});
    if (settings.shading.indirect) rows.add("meshes", {{"indirect light on meshes", positions}});
    if (scatters(settings) && scattering == Scattering::skin)
        rows.add("meshes", {{"mesh curvatures", engine::bytesOf<float>(mesh.positions.size())}});
    return rows;
}

MeshGeometry::MeshGeometry(
    const engine::Device& device, const Settings& settings, const groom::Mesh& mesh,
    Scattering scattering)
    : vertices(static_cast<std::uint32_t>(mesh.positions.size())) {
    const engine::MemoryRows rows = MeshGeometry::rows(settings, mesh, scattering);
    const auto upload = [&]<class Value>(const std::vector<Value>& values, const char* name) {
        return engine::makeBuffer(device, values, rows, name);
    };
    positions = upload(mesh.positions, "mesh positions");
    normals = upload(mesh.normals, "mesh normals");
    if (settings.shading.indirect) indirect = {device, rows["indirect light on meshes"]};
    if (scatters(settings) && scattering == Scattering::skin)
        curvatures = upload(rendering::curvatures(mesh), "mesh curvatures");
    texture_coordinates = upload(mesh.texture_coordinates, "mesh texture coordinates");
    indices = upload(sortedIndices(mesh), "mesh indices");
    std::uint32_t first = 0;
    for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
        const auto triangles =
            static_cast<std::uint32_t>(std::ranges::count(mesh.triangle_materials, material));
        if (triangles > 0) parts.push_back({material, first, 3 * triangles});
        first += 3 * triangles;
    }
}

// ---- Light that scatters in skin ----------------------------------------------------------------

std::vector<float> curvatures(const groom::Mesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> place_of;
    place_of.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
        const auto number = static_cast<std::uint32_t>(places.size());
        place_of.push_back(places.try_emplace({p.x, p.y, p.z}, number).first->second);
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<double> bend(places.size(), 0.0);
    std::vector<std::uint32_t> neighbours(places.size(), 0);
    for (const auto& corners : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = corners[i];
            const std::uint32_t b = corners[(i + 1) % 3];
            const std::pair<std::uint32_t, std::uint32_t> edge =
                std::minmax(place_of[a], place_of[b]);
            const glm::dvec3 along(mesh.positions[b] - mesh.positions[a]);
            const double squared = glm::dot(along, along);
            if (squared == 0.0 || !edges.insert(edge).second) continue;
            const double curvature =
                std::abs(glm::dot(glm::dvec3(mesh.normals[b] - mesh.normals[a]), along) / squared);
            for (const std::uint32_t end : {edge.first, edge.second}) {
                bend[end] += curvature;
                ++neighbours[end];
            }
        }
    }
    for (std::size_t i = 0; i < bend.size(); ++i) bend[i] /= std::max(neighbours[i], 1u);
    constexpr int kAveraged = 3;
    for (int pass = 0; pass < kAveraged; ++pass) {
        std::vector<double> sum = bend;
        for (const auto& [a, b] : edges) {
            sum[a] += bend[b];
            sum[b] += bend[a];
        }
        for (std::size_t i = 0; i < bend.size(); ++i) bend[i] = sum[i] / (neighbours[i] + 1.0);
    }
    std::vector<float> result;
    result.reserve(place_of.size());
    for (const std::uint32_t place : place_of) result.push_back(static_cast<float>(bend[place]));
    return result;
}

namespace {

// A Gaussian of skin's profile: variance, mm^2, and its weights in red, green and blue.
struct ProfileTerm {
    double variance;
    glm::dvec3 weight;
};

constexpr std::array<ProfileTerm, 6> kSkin{
    {{0.0064, {0.233, 0.455, 0.649}},
     {0.0484, {0.100, 0.336, 0.344}},
     {0.187, {0.118, 0.198, 0.0}},
     {0.567, {0.113, 0.007, 0.007}},
     {1.99, {0.358, 0.004, 0.0}},
     {7.41, {0.078, 0.0, 0.0}}}};

constexpr int kLegendreTerms = 1024;

}  // namespace

std::vector<glm::vec3> scatteringResponses() {
    constexpr double kMillimetre = 1e-3;
    // The clamped cosine is the sum of c_l P_l: c_0 = 1/4, c_1 = 1/2, and for even l
    // c_l = -c_(l-2) (2 l + 1) (l - 3) / ((2 l - 3) (l + 2)).
    std::vector<std::pair<int, double>> terms{{0, 0.25}, {1, 0.5}};
    double even = 0.25;
    for (int l = 2; l < kLegendreTerms; l += 2) {
        even *= -(2.0 * l + 1.0) * (l - 3.0) / ((2.0 * l - 3.0) * (l + 2.0));
        terms.emplace_back(l, even);
    }
    // [curvature][term]: what scattering changes a term by
    std::vector<std::vector<glm::dvec3>> changes;
    for (std::uint32_t row = 0; row < gpu::kScatteringCurvatures; ++row) {
        const double curvature = row * double{gpu::kScatteringStep} * kMillimetre;  // 1/mm
        std::vector<glm::dvec3>& change = changes.emplace_back();
        for (const auto& [l, coefficient] : terms) {
            glm::dvec3 kept(0.0);
            for (const ProfileTerm& term : kSkin)
                kept += term.weight *
                        std::exp(-0.5 * l * (l + 1.0) * term.variance * curvature * curvature);
            change.push_back(coefficient * (kept - 1.0));
        }
    }
    std::vector<glm::vec3> table(gpu::kScatteringCurvatures * gpu::kScatteringCosines);
    for (std::uint32_t column = 0; column < gpu::kScatteringCosines; ++column) {
        const double x = 2.0 * column / (gpu::kScatteringCosines - 1.0) - 1.0;
        std::vector<double> legendre{1.0, x};
        for (int l = 2; l < kLegendreTerms; ++l)
            legendre.push_back(
                ((2.0 * l - 1.0) * x * legendre[l - 1] - (l - 1.0) * legendre[l - 2]) / l);
        for (std::uint32_t row = 0; row < gpu::kScatteringCurvatures; ++row) {
            glm::dvec3 sum(std::max(x, 0.0));
            for (std::size_t i = 0; i < terms.size(); ++i)
                sum += changes[row][i] * legendre[terms[i].first];
            table[row * gpu::kScatteringCosines + column] = sum;
        }
    }
    return table;
}

// ---- Materials ----------------------------------------------------------------------------------

engine::MemoryRows MeshMaterials::rows(const groom::Mesh& mesh) {
    engine::MemoryRows rows;
    for (const engine::Pixels& picture : mesh.pictures)
        rows.add(
            "textures", {{.name = "mesh texture",
                          .size = picture.rgba.size() + picture.rgba.size() / 3,  // mip levels
                          .at_most = true}});
    return rows;
}

MeshMaterials::MeshMaterials(
    const engine::Device& device, const RenderSettings& settings, const groom::Mesh& mesh,
    const engine::SampledImage& blank) {
    const engine::Decoding decoding =
        hasLinearLight(settings) ? engine::Decoding::linear : engine::Decoding::none;
    const auto sampled = [&](const groom::MaterialTexture& use, engine::Texels texels) {
        const auto texture = textures_.try_emplace(
            {use.picture, texels}, device, mesh.pictures[use.picture], texels, decoding,
            "mesh texture");
        const auto sampler = samplers_.try_emplace(
            {use.horizontal, use.vertical, use.is_smooth}, device,
            engine::SamplerDescription{
                .filter = use.is_smooth ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                .horizontal = addressMode(use.horizontal),
                .vertical = addressMode(use.vertical)});
        return engine::SampledImage{&texture.first->second.image(), &sampler.first->second};
    };
    for (const groom::Material& source : mesh.materials) {
        MeshMaterial& material = materials_.emplace_back(MeshMaterial{
            .look = lookOf(mesh, source),
            .base_color = workingColor(settings, source.base_color),
            .opacity = source.opacity,
            .metallic = source.metallic,
            .roughness = source.roughness,
            .normal_scale = source.normal_scale,
            .cutoff = source.cutoff.value_or(0.0f),
            .images = {blank, blank, blank}});
        if (material.look.base_color_texture)
            material.images[0] = sampled(*source.base_color_texture, engine::Texels::display_color);
        if (material.look.metallic_roughness_texture)
            material.images[1] = sampled(*source.metallic_roughness_texture, engine::Texels::data);
        if (material.look.normal_texture)
            material.images[2] = sampled(*source.normal_texture, engine::Texels::data);
    }
}

// ---- The meshes of a picture --------------------------------------------------------------------

SceneMeshes::SceneMeshes(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets)
    : scattering_(settings.shading.skin_scattering),
      blank_(
          device, {1, 1, {255, 255, 255, 255}}, engine::Texels::data, engine::Decoding::none,
          "no texture"),
      blank_sampler_(device, {}) {
    if (scatters(settings))
        responses_ = engine::makeBuffer(
            device, scatteringResponses(), rows(settings), "responses of scattering spheres");
    if (assets.head && settings.render.head) add(device, settings, *assets.head, Motion::with_head);
    for (std::size_t i = 0; i < assets.meshes.size(); ++i)
        add(device, settings, placed(assets.meshes[i], settings.render.meshes.at(i)),
            Motion::still);
}

engine::MemoryRows SceneMeshes::rows(const Settings& settings) {
    if (!scatters(settings)) return {};
    return {
        "shading",
        {{"responses of scattering spheres",
          engine::bytesOf<glm::vec3>(gpu::kScatteringCosines * gpu::kScatteringCurvatures)}}};
}

void SceneMeshes::add(
    const engine::Device& device, const Settings& settings, const groom::Mesh& mesh,
    Motion motion) {
    const SceneMesh& added = meshes_.emplace_back(SceneMesh{
        {device, settings, mesh,
         motion == Motion::with_head ? MeshGeometry::Scattering::skin
                                     : MeshGeometry::Scattering::none},
        {device, settings.render, mesh, {&blank_.image(), &blank_sampler_}},
        motion});
    for (const MeshGeometry::Part& part : added.geometry.parts) {
        const MeshLook look = added.materials.materials()[part.material].look;
        if (!pipelines_.contains(look))
            pipelines_.try_emplace(look, device, pipeline(look, settings));
        const MeshLook depth_look = depthLook(look);
        if (!depth_pipelines_.contains(depth_look))
            depth_pipelines_.try_emplace(depth_look, device, depthPipeline(depth_look, settings));
    }
}

void SceneMeshes::deform(const engine::Buffer& positions, const engine::Buffer& normals) {
    deformed_positions_ = positions.address();
    deformed_normals_ = normals.address();
}

SceneMeshes::Vertices SceneMeshes::verticesOf(const SceneMesh& mesh) const {
    const bool moves = mesh.motion == Motion::with_head;
    if (moves && deformed_positions_ != 0) return {deformed_positions_, deformed_normals_, false};
    return {mesh.geometry.positions.address(), mesh.geometry.normals.address(), moves};
}

void SceneMeshes::gatherIndirect(
    engine::Commands& commands, const engine::ComputePipeline& gather,
    const engine::Buffer& sources, gpu::IndirectPush push) const {
    for (const SceneMesh& mesh : meshes_) {
        const Vertices vertices = verticesOf(mesh);
        push.sources = commands.reads(sources);
        push.positions = vertices.positions;
        push.normals = vertices.normals;
        push.light = commands.writes(mesh.geometry.indirect);
        push.vertices = mesh.geometry.vertices;
        push.is_moving = vertices.is_moving ? 1u : 0u;
        commands.bind(gather, push);
        commands.dispatchInvocations(push.vertices, gpu::kIndirectGroupSize);
    }
}

void SceneMeshes::bind(
    engine::Commands& commands, const engine::GraphicsPipeline& pipeline, std::uint64_t picture,
    const SceneMesh& mesh, const MeshMaterial& material) const {
    const Vertices vertices = verticesOf(mesh);
    commands.bind(
        pipeline, gpu::MeshPush{
                      .picture = picture,
                      .positions = vertices.positions,
                      .normals = vertices.normals,
                      .texture_coordinates = mesh.geometry.texture_coordinates.address(),
                      .indirect = mesh.geometry.indirect.address(),
                      .base_color = material.base_color,
                      .opacity = material.opacity,
                      .metallic = material.metallic,
                      .roughness = material.roughness,
                      .normal_scale = material.normal_scale,
                      .cutoff = material.cutoff,
                      .is_moving = vertices.is_moving ? 1u : 0u,
                      .scattering = scattering_,
                      .curvatures = mesh.geometry.curvatures.address(),
                      .responses = responses_.address()});
}

void SceneMeshes::declareDraw(engine::Commands& commands) const {
    for (const SceneMesh& mesh : meshes_)
        if (mesh.geometry.indirect.address() != 0)
            commands.uses({{mesh.geometry.indirect, engine::Access::vertex_read}});
}

void SceneMeshes::draw(
    engine::Commands& commands, std::uint64_t picture,
    std::span<const engine::SampledImage> shadows) const {
    for (const SceneMesh& mesh : meshes_) {
        for (const MeshGeometry::Part& part : mesh.geometry.parts) {
            const MeshMaterial& material = mesh.materials.materials()[part.material];
            const engine::GraphicsPipeline& pipeline = pipelines_.at(material.look);
            bind(commands, pipeline, picture, mesh, material);
            std::array<engine::SampledImage, kMaterialImages + kShadowImages> images;
            assert(shadows.size() == kShadowImages);
            std::ranges::copy(shadows, std::ranges::copy(material.images, images.begin()).out);
            commands.images(pipeline, images);
            commands.drawIndexed(
                mesh.geometry.indices,
                {.indices = part.index_count, .first_index = part.first_index});
        }
    }
}

void SceneMeshes::drawDepth(engine::Commands& commands, std::uint64_t picture) const {
    for (const SceneMesh& mesh : meshes_) {
        for (const MeshGeometry::Part& part : mesh.geometry.parts) {
            const MeshMaterial& material = mesh.materials.materials()[part.material];
            const engine::GraphicsPipeline& pipeline =
                depth_pipelines_.at(depthLook(material.look));
            bind(commands, pipeline, picture, mesh, material);
            if (material.look.mask) commands.images(pipeline, material.images);
            commands.drawIndexed(
                mesh.geometry.indices,
                {.indices = part.index_count, .first_index = part.first_index});
        }
    }
}

// ---- Indirect light -----------------------------------------------------------------------------

bool IndirectLight::isNeeded(const Settings& settings) { return settings.shading.indirect; }

engine::MemoryRows IndirectLight::rows(const Settings& settings) {
    if (!isNeeded(settings)) return {};
    return {
        "shading",
        {{"sources of indirect light",
          engine::bytesOf<gpu::IndirectSource>(std::max(indirectSources(settings).count, 1u))}}};
}

IndirectLight::IndirectLight(const engine::Device& device, const Settings& settings)
    : side_(indirectSources(settings).side), count_(indirectSources(settings).count),
      sources_(device, rows(settings)["sources of indirect light"]),
      make_sources_(
          device, {.shader = "shading/indirect.comp",
                   .constants = shadingConstants(settings),
                   .push_size = sizeof(gpu::IndirectPush),
                   .combined_images = kShadowImages}),
      gather_(
          device,
          {.shader = "shading/indirect.comp+gather", .push_size = sizeof(gpu::IndirectPush)}) {}

void IndirectLight::record(
    engine::Commands& commands, const SceneMeshes& meshes, std::uint64_t picture,
    std::span<const engine::SampledImage> shadows) const {
    const gpu::IndirectPush push{
        .picture = picture,
        .sources = commands.writes(sources_),
        .side = side_,
        .sources_count = count_};
    commands.bind(make_sources_, push);
    commands.images(make_sources_, shadows);
    commands.dispatchInvocations(count_, gpu::kIndirectGroupSize);
    meshes.gatherIndirect(commands, gather_, sources_, push);
}

}  // namespace hair::rendering
