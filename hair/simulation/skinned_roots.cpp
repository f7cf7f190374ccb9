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
    for (const groom::SurfaceMotion& motion : motionsAt(time)) motions.push_back(toMotion(motion));
    return motions;
}

std::span<const groom::SurfaceMotion> SkinnedRoots::motionsAt(double time) const {
    mesh_->motions(bindings_, time, work_.scratch, work_.motions);
    return work_.motions;
}

RigidMotion SkinnedRoots::meanAt(double time) const {
    return toMotion(groom::meanMotion(motionsAt(time), roots_));
}

std::span<const RigidMotion> SkinnedRoots::record(
    engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
    double to) const {
    work_.means.clear();
    work_.frames.clear();
    for (std::uint32_t i = 0; i <= substeps; ++i) {
        const double time = from + static_cast<double>(i) / substeps * (to - from);
        const RigidMotion carried = head.at(time);
        const auto motions = motionsAt(time);
        for (const groom::SurfaceMotion& motion : motions)
            work_.frames.push_back(toGpu(carried * toMotion(motion)));
        work_.means.push_back(carried * toMotion(groom::meanMotion(motions, roots_)));
    }
    const auto frames = std::as_bytes(std::span(work_.frames));
    assert(frames.size() <= frames_.size());
    commands.barrier(Access::compute_read, Access::transfer_write);
    commands.write(frames_, frames);
    commands.barrier(Access::transfer_write, Access::compute_read);
    return work_.means;
}

std::uint64_t SkinnedRoots::address(std::uint32_t substep) const {
    return frames_.address() + substep * roots_.size() * sizeof(gpu::RigidFrame);
}

}  // namespace hair::simulation
