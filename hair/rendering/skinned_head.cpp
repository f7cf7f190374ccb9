#include "hair/rendering/skinned_head.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_offsets.h"

namespace hair::rendering {
namespace {

using engine::Access;

static_assert(sizeof(gpu::CarriedRoot) == 52 && offsetof(gpu::CarriedRoot, inverse_edges) == 36);
static_assert(sizeof(gpu::SkinPush) == 36);

// The pass computes roots without its own corrections.
engine::ComputeDescription skinStage(const StrandSettings& strands, StrandPlan plan) {
    plan.skinned = false;
    return {
        .shader = "strands/skin.comp",
        .constants = strandConstants(strands, plan),
        .push_size = sizeof(gpu::SkinPush)};
}

// The hair as it is at rest.
StrandView atRest(StrandView view) {
    view.guides = view.rest_guides;
    view.contacts = view.rest_guides;  // w is 0: no contact
    view.head = glm::mat4(1.0f);
    return view;
}

gpu::CarriedRoot carriedRoot(const groom::SurfaceBinding& binding, const glm::vec3& root) {
    const glm::dmat2 inverse = glm::inverse(binding.edges);
    return {
        .corners = {binding.corners[0], binding.corners[1], binding.corners[2]},
        .weights = binding.weights,
        .offset = glm::transpose(binding.frame) * (glm::dvec3(root) - binding.nearest),
        .inverse_edges = glm::dvec4(inverse[0], inverse[1])};
}

}  // namespace

SkinnedHead::SkinnedHead(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const StrandView& view)
    : strand_count_(plan.triangles * plan.density),
      pipeline_(device, skinStage(settings.strands, plan)) {
    const std::size_t bytes = view.deforming->restPositions().size() * sizeof(glm::vec3);
    for (std::uint32_t slot = 0; slot < engine::FrameLoop::kMaxSlots; ++slot) {
        positions_[slot] = {
            device,
            {.size = bytes, .usage = engine::Usage::upload, .name = "mesh positions, deformed"}};
        normals_[slot] = {
            device,
            {.size = bytes, .usage = engine::Usage::upload, .name = "mesh normals, deformed"}};
        write(slot, view);
    }
    const std::size_t strands = std::max(strand_count_, 1u);
    corrections_ = {device, {.size = strands * sizeof(glm::vec4), .name = "root corrections"}};
    if (strand_count_ == 0 || !settings.render.hair) return;

    const StrandView rest = atRest(view);
    std::optional<FramesPass> frames;
    if (FramesPass::isNeeded(rest)) frames.emplace(device, rest);
    const engine::Buffer parameters(
        device, {.size = sizeof(gpu::PictureParameters),
                 .usage = engine::Usage::upload,
                 .name = "picture parameters"});
    parameters.write(pictureParameters(
        settings, plan, rest,
        {.guide_normals = frames ? frames->normals().address() : 0,
         .guide_turns = frames ? frames->turns().address() : 0}));
    runOnce(device, [&](engine::Commands& commands) {
        if (frames) {
            frames->record(commands, rest);
            commands.barrier(Access::compute_write, Access::compute_read);
            commands.uses(
                {{frames->normals().address(), Access::compute_read},
                 {frames->turns().address(), Access::compute_read}});
        }
        commands.uses({{corrections_, Access::compute_write}});
        commands.bind(
            pipeline_, gpu::SkinPush{
                           .picture = parameters.address(),
                           .roots = 0,
                           .mesh = 0,
                           .found = corrections_.address(),
                           .count = strand_count_});
        commands.dispatchInvocations(strand_count_, gpu::kSkinGroupSize);
        commands.barrier(Access::compute_write, Access::anything);
    });
    std::vector<glm::vec3> found;
    for (const glm::vec4& root : engine::downloadAs<glm::vec4>(device, corrections_))
        found.emplace_back(root);
    const std::vector<groom::SurfaceBinding> bindings = view.deforming->bind(found);
    std::vector<gpu::CarriedRoot> roots;
    roots.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        roots.push_back(carriedRoot(bindings[i], found[i]));
    roots_ = engine::makeBuffer(
        device, std::span<const gpu::CarriedRoot>(roots), "root triangles of strands");
}

void SkinnedHead::write(std::uint32_t slot, const StrandView& view) {
    view.deforming->positions(view.time, work_.scratch, work_.positions);
    view.deforming->normals(work_.positions, work_.scratch, work_.turned);
    work_.moved.clear();
    for (const glm::dvec3& position : work_.positions)
        work_.moved.emplace_back(view.carried * glm::dvec4(position, 1.0));
    for (glm::vec3& normal : work_.turned)
        normal = glm::vec3(glm::dmat3(view.carried) * glm::dvec3(normal));
    positions_[slot].write(std::as_bytes(std::span(work_.moved)));
    normals_[slot].write(std::as_bytes(std::span(work_.turned)));
}

void SkinnedHead::record(
    engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
    std::uint32_t slot) const {
    if (!roots_.address()) return;
    // Waits for draws that still read the old corrections, and so, by the chain of barriers, for
    // the frames along guides.
    commands.barrier(Access::vertex_read, Access::compute_write);
    commands.uses(
        {{parameters.guides, Access::compute_read},
         {parameters.contacts, Access::compute_read},
         {parameters.guide_normals, Access::compute_read},
         {parameters.guide_turns, Access::compute_read},
         {corrections_, Access::compute_write}});
    commands.bind(
        pipeline_, gpu::SkinPush{
                       .picture = picture,
                       .roots = roots_.address(),
                       .mesh = positions_[slot].address(),
                       .found = corrections_.address(),
                       .count = strand_count_});
    commands.dispatchInvocations(strand_count_, gpu::kSkinGroupSize);
    commands.barrier(Access::compute_write, Access::vertex_read);
}

}  // namespace hair::rendering
