#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"
#include "hair/simulation/head_motion.h"

namespace hair::simulation {

// A cubic grid on the head, round the roots and 1.1 of the longest strand's length on every side.
// All that lies at least kVolumeMargin cells within. A second grid begins half a cell before it.
struct VolumeGrid {
    glm::dvec3 origin{0.0};  // corner, m, where the groom was made
    double cell = 1.0;       // m
    std::uint32_t resolution = 0;  // cells a side
};

VolumeGrid volumeGrid(const groom::Groom& groom, std::uint32_t resolution);

// The part of the groom's length that each vertex stands for: half of its segments. Parts of a
// groom without length are equal. [strand][vertex], sums to 1.
std::vector<double> lengthShares(const groom::Groom& groom);

// Mean over the groom's length and both grids of the density at rest, shares per cell.
double meanRestDensity(const groom::Groom& groom, const VolumeGrid& grid);

// B of device memory that HairHair takes.
std::uint64_t hairHairBytes(const groom::GroomSize& size, const SimulationSettings& settings);

// Contact of hair with hair as between parts of a fluid, on grids that move with the head
// (Petrovic, Henne and Anderson 2005, Volumetric methods for simulation and rendering of hair).
//
// Vertex p has the share m_p of the groom's length, the velocity v_p and the weight w_pi in cell i
// (quadratic B-spline). Cell i sums up m_i = sum_p w_pi m_p and the momentum m_i v_i.
//
// Friction accelerates vertex p by r d_p, where d_p = sum_i w_pi (v_i - v_p) with pairs of vertices
// on one strand left out, and exp(-r / 60 s) is 1 less the setting. A pass that works d_p out once
// in a step dt has to know what it is during the step. If all else changes d_p by c dt,
//     d_p(t) = exp(-r t) d_p(0) + (1 - exp(-r t)) / r c,
// so that in the step friction takes, exactly,
//     j_p = s d_p(0) + (1 - s / (r dt)) c dt,    s = 1 - exp(-r dt).
// c dt is taken from the step before: it is what d_p has become there less what friction left,
// d_p(0) - j_p. Three things follow, at any dt. Bundles that nothing else acts on lose their
// difference as exp(-r t). Where hair slides steadily s d + (1 - s / (r dt)) j = j, that is j = r
// dt d: the force is r d. And forces of a pair are opposite, the ones foreseen too, since d_p are:
// momentum is kept to rounding, and hair that moves as one feels no friction however it speeds up.
// An implicit brake toward a velocity of the grid's, as that of air, has the first two and not the
// third: it can't know how its neighbours will speed up, and dense hair of the setting 1/2 would
// fall with 0.72 g at 1/60 s. What is foreseen wrongly, where hair hits something, is put right in
// the next steps. With a in [0, 1] that friction takes of a mode of d_p, the step's matrix has the
// determinant f (1 - a) and the trace 1 - a s + f (1 - a), f = 1 - s / (r dt): it is stable for
// every r and dt. f is used up to 3/4, r dt = 3.9; what slides steadily beyond feels less. An
// explicit spring of the stiffness w^2 / dt^2, as repulsion is, stays stable beside it for w^2 < 2
// (2 - s) / (1 + f): where there is repulsion f is used up to 1 - s, r dt = 1, so that this is
// never below 2.
//
// Repulsion: the pressure k (m_i - crowded), where it is positive, of a gas with the speed of sound
// sqrt(k). Its energy E(m_i) has the slope E' = k ln(m_i / crowded); what each strand would have
// alone is taken from it:
//     a_p = -sum_i (E'(m_i) - E'(m_i of p's own strand)) grad w_pi.
// So a strand feels others only, whatever the resolution. The force has a potential, and hair comes
// to rest: with central differences of the pressure instead, which keep momentum exactly, hair was
// seen to run in circles for ever. k is used up to 1/2 (cell / dt)^2, which keeps an explicit step
// stable, and in a step repulsion moves no vertex by more than a cell.
//
// Everything is the mean of two grids half a cell apart. The sum of repulsion's forces is zero but
// for the sampling of E at cells: on one grid it can be a tenth of their size, but errors of the
// two are opposite, and one to two hundredths are left (interlacing; Hockney and Eastwood 1988,
// Computer simulation using particles).
//
// A vertex counts where it will be at the end of the step by its velocity: this takes energy
// from pressure waves instead of adding some. All of it is continuous in the vertices' places.
//
// Sums are integers, so they don't depend on the order of additions. Their fixed point is that of a
// block of 4 x 4 x 4 cells: a unit is at most 2^-31 of the share M of all vertices that reach into
// the block, and of momentum 2^-30 M V, where V is the greatest component of their velocities. So
// sums can't overflow, and hair that is slow or sparse keeps its digits beside hair elsewhere that
// is fast or dense. Of N vertices in a cell at most N / 2 units are lost by rounding.
class HairHair {
public:
    HairHair(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    // Adds to the accelerations what acts over the next step; `later` is the head's place at its
    // end. Orders its work after earlier compute work, but for what wrote the guides' positions;
    // the caller orders what comes after.
    void record(
        engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& later) const;

    // Leaves the step before out of the next one, where someone else wrote the positions.
    void forget(const engine::Device& device);

    // What goes from step to step.
    const engine::Buffer& state() const { return kept_; }

    // gpu::VolumeParameters::sums and blocks.
    const engine::Buffer& sums() const { return sums_; }
    const engine::Buffer& blocks() const { return blocks_; }
    const engine::Buffer& parameters() const { return parameters_; }

private:
    std::uint32_t vertex_count_;
    engine::Buffer shares_;
    engine::Buffer samples_;
    engine::Buffer sums_;
    engine::Buffer blocks_;
    engine::Buffer parameters_;  // gpu::VolumeParameters
    engine::Buffer kept_;  // vec4 [strand][vertex]
    engine::ComputePipeline sample_;
    engine::ComputePipeline splat_;
    engine::ComputePipeline force_;
};

}  // namespace hair::simulation
