#include "hair/simulation/skinned_roots.h"

#include <cassert>
#include <cstddef>
#include <span>

#include "hair/gpu_structs.h"

namespace hair::simulation {
namespace {

using engine::Access;

static_assert(sizeof(gpu::RigidFrame) == 28 && offsetof(gpu::RigidFrame, translation) == 16);

RigidMotion toMotion(const groom::SurfaceMotion& motion) {
    return {motion.rotation, motion.translation};
}

}  // namespace

RigidMotion operator*(const RigidMotion& after, const RigidMotion& before) {
    return {after.rotation * before.rotation, after(before.translation)};
}

SkinnedRoots::SkinnedRoots(
    const engine::Device& device, const groom::Groom& groom, const groom::DeformingMesh& mesh,
    std::uint32_t substeps)
    : mesh_(&mesh) {
    for (std::uint32_t i = 0; i < groom.strand_count; ++i)
        roots_.push_back(groom.strand(i).front());
    bindings_ = mesh.bind(roots_);
    frames_ = {
        device,
        {.size = (std::size_t{substeps} + 1) * roots_.size() * sizeof(gpu::RigidFrame),
         .name = "guide root frames"}};
}

std::vector<RigidMotion> SkinnedRoots::at(double time) const {
    std::vector<RigidMotion> motions;
    motions.reserve(bindings_.size());
    for (const groom::SurfaceMotion& motion : mesh_->motions(bindings_, time))
        motions.push_back(toMotion(motion));
    return motions;
}

RigidMotion SkinnedRoots::meanAt(double time) const { return meanOf(at(time)); }

RigidMotion SkinnedRoots::meanOf(std::span<const RigidMotion> motions) const {
    std::vector<groom::SurfaceMotion> surface;
    surface.reserve(motions.size());
    for (const RigidMotion& motion : motions)
        surface.push_back({motion.rotation, motion.translation});
    return toMotion(groom::meanMotion(surface, roots_));
}

std::vector<RigidMotion> SkinnedRoots::record(
    engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
    double to) const {
    std::vector<RigidMotion> means;
    std::vector<gpu::RigidFrame> frames;
    frames.reserve((std::size_t{substeps} + 1) * roots_.size());
    for (std::uint32_t i = 0; i <= substeps; ++i) {
        const double time = from + static_cast<double>(i) / substeps * (to - from);
        const RigidMotion carried = head.at(time);
        const std::vector<RigidMotion> motions = at(time);
        for (const RigidMotion& motion : motions) frames.push_back(toGpu(carried * motion));
        means.push_back(carried * meanOf(motions));
    }
    assert(frames.size() * sizeof(gpu::RigidFrame) <= frames_.size());
    commands.barrier(Access::compute_read, Access::transfer_write);
    commands.write(frames_, std::as_bytes(std::span(frames)));
    commands.barrier(Access::transfer_write, Access::compute_read);
    return means;
}

std::uint64_t SkinnedRoots::address(std::uint32_t substep) const {
    return frames_.address() + substep * roots_.size() * sizeof(gpu::RigidFrame);
}

}  // namespace hair::simulation
