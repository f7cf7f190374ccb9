#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/forces.h"
#include "hair/simulation/guide_solver.h"
#include "hair/simulation/head_motion.h"

namespace hair::simulation {

// A cubic grid fixed to the head, round the roots and 1.1 times the longest strand's length on
// every side. That region lies at least kVolumeMargin cells inside the grid. A second grid is
// offset by minus half a cell.
struct VolumeGrid {
    glm::dvec3 origin{0.0};  // corner, m, in the groom's frame
    double cell = 1.0;       // m
    std::uint32_t resolution = 0;  // cells per side
};

VolumeGrid volumeGrid(const groom::Groom& groom, std::uint32_t resolution);

// Returns the fraction of the groom's length that each vertex represents: half of its segments. If
// the groom has no length, all fractions are equal. [strand][vertex], sums to 1.
std::vector<double> lengthShares(const groom::Groom& groom);

// Returns the density at rest in shares per cell: the mean over the groom's length and both grids.
double meanRestDensity(const groom::Groom& groom, const VolumeGrid& grid);

// Whether the settings ask for contact or shelter of moving hair.
bool hairActsOnHair(const SimulationSettings& settings);

// A stiffness of hair-hair contact that acts weaker than it is set, because the time step is too
// long for it (see HairHair).
struct StepLimit {
    const char* field;  // JSON pointer
    double set;  // m^2/s^2
    double used;  // m^2/s^2
    double longest_step;  // s, in which it would act in full
};

// Returns repulsion and attraction if the settings' time step limits them for this groom.
std::vector<StepLimit>
limitedBySteps(const groom::Groom& groom, const SimulationSettings& settings);

// Contact of hair with hair as in a fluid, on grids that move with the head (Petrovic, Henne and
// Anderson 2005, Volumetric methods for simulation and rendering of hair).
//
// Vertex p has the share m_p of the groom's length, the velocity v_p and the weight w_pi in cell i
// (quadratic B-spline). Cell i sums the mass m_i = sum_p w_pi m_p and the momentum m_i v_i.
//
// Friction accelerates vertex p by r d_p. Here d_p = sum_i w_pi (v_i - v_p), without pairs of
// vertices on one strand, and exp(-r / 60 s) is 1 minus the setting. A pass that computes d_p once
// in a step dt must predict d_p during the step. If everything else changes d_p by c dt, then
//     d_p(t) = exp(-r t) d_p(0) + (1 - exp(-r t)) / r c,
// and in the step friction removes exactly
//     j_p = s d_p(0) + (1 - s / (r dt)) c dt,    s = 1 - exp(-r dt).
// The change c dt is taken from the step before: the present d_p minus the value that friction left
// there, d_p(0) - j_p. Three things follow, at any dt. Bundles that nothing else acts on lose their
// velocity difference as exp(-r t). In steady sliding s d + (1 - s / (r dt)) j = j, so j = r dt d:
// the force is r d. Forces of a pair are opposite, including the predicted part, because the d_p
// are opposite: momentum is conserved to rounding, and hair that moves as one feels no friction,
// however it accelerates.
//
// An implicit drag toward a velocity of the grid, like air drag, has the first two properties but
// not the third: it can't know how its neighbours will accelerate, and dense hair with the setting
// 1/2 would fall with 0.72 g at 1/60 s. A wrong prediction, for example where hair hits something,
// is corrected in the next steps. Let friction remove the part a in [0, 1] of a mode of d_p. The
// step's matrix then has the determinant f (1 - a) and the trace 1 - a s + f (1 - a), with
// f = 1 - s / (r dt): it is stable for every r and dt. f is limited to 3/4, at r dt = 3.9; beyond
// that, steady sliding feels less friction. An explicit spring of stiffness w^2 / dt^2, such as
// repulsion, stays stable beside friction for w^2 < 2 (2 - s) / (1 + f). With repulsion, f is
// limited to 1 - s, at r dt = 1, so that this bound is never below 2.
//
// With a yield stress, hairs stick to each other like a granular medium with cohesion (Mohr and
// Coulomb; Jiang, Gast and Teran 2017, Anisotropic elastoplasticity for cloth, knit and hair
// frictional contact). The shear stress is at most
//     tau = mu P + c = rho (mu k (1 - crowded / m_i) + c / rho),
// with the pressure P of repulsion, the density rho of hair, `friction_coefficient` mu and
// `cohesion` c / rho. Below it hair rests; above it hair slides, at any speed, against this stress.
// Friction has a potential y_p in place of the velocity, and in a step changes the velocity of
// vertex p by
//     j_p = sum_i phi_i w_pi (y_i - y_p),    y_p = z_p + v_p,
// again without pairs of vertices on one strand. z_p dt is an elastic displacement: z grows by v_p
// in each step, and where hair yields it flows by sum_i (1 - phi_i) w_pi (y_i - y_p). Without yield
// (phi = 1), everything that acts on hair at rest is balanced by friction exactly, since z is an
// integral: a mode of which friction removes the part a has the eigenvalues' product 1 - a and sum
// 2 - 2 a, and comes to rest for each a in (0, 1]. Beside an explicit spring of stiffness w^2 /
// dt^2 it does so for w^2 < 4 - 3 a, so repulsion is used up to a quarter of (cell / dt)^2 only.
// phi_i belongs to a cell and is the same for both vertices of a pair, so momentum is conserved to
// rounding, in yield, too. v_p is relative to the head: hair that turns with it feels nothing.
//
// With a jump Y of y between two half-spaces, cells that hold the part F of one transmit the stress
// sum_i phi_i F_i (1 - F_i) rho cell Y / dt per area, which is phi rho cell Y / dt times half of
// the mean distance of two points in two splines, 239 / 840. A cell knows Y = 2 V / A from the mean
// distance A of y_p from its mean y_i and the mean square V, because a jump has A = 2 F (1 - F) Y
// and V = F (1 - F) Y^2: the same Y, and thus the same phi, for each F. So all cells of a slip
// surface yield at once, and hair that is driven by less rests. phi = Y_c / Y with
//     Y_c = q dt / cell tau / rho
// transmits tau across a jump if q = 840 / 239 = 3.51; across an even slope of y, for which A is 13
// / 32 of the slope and V a quarter of its square, if q = 64 / 13 = 4.92. Hair that slides on hair
// is between the two, and q is their mean. In layers of one vertex to six cells, the stress is then
// 0.90 to 1.05 of tau, at rest and in motion (check `hair_friction`).
//
// Friction resists every relative motion of hairs, also towards and away from each other.
//
// Repulsion is the pressure k (m_i - crowded), if positive, of a gas with the speed of sound
// sqrt(k). Its energy E(m_i) has the slope E' = k ln(m_i / crowded). The part that each strand
// would have alone is subtracted:
//     a_p = -sum_i (E'(m_i) - E'(m_i of p's own strand)) grad w_pi.
// So a strand feels only other strands, whatever the resolution. The force has a potential, so hair
// comes to rest. With central differences of the pressure instead, which conserve momentum exactly,
// hair was seen to run in circles for ever. k is limited to 1/2 (cell / dt)^2, which keeps an
// explicit step stable, and repulsion moves no vertex by more than a cell in a step.
//
// Attraction is that of wet hair, which water joins (Bico, Roman, Moulin and Boudaoud 2004,
// Elastocapillary coalescence in wet hair). With the setting f, two strands of the mass per length
// m that lie on each other have the energy -f m per length. In cells the energy is -1/2 A m_i^2,
// from which the same part of each strand alone is subtracted:
//     a_p = A sum_i (m_i - m_i of p's own strand) grad w_pi,    A = f length / (0.3025 cell),
// with the length of the whole groom, since a strand's shares are one over it per length, and two
// strands on each other along an axis of the grid have sum_i m_i^2 = 2 (1 + 0.3025) of a row of
// cells. Along diagonals it is up to 1.5 % more. The energy of two strands falls with their
// distance as the quintic B-spline does: to 0.39 of its depth a cell apart and 0.015 two cells
// apart. With their place in a cell, the energy varies by 1 % and the force by 12 % of its greatest
// value. In crowded hair water has filled all gaps: m_i counts up to `crowded` only. There a clump
// of hair is like a drop: it coheres by the pressure A crowded^2 / 2, against which repulsion holds
// it, and has a surface tension. A crowded is limited like k.
//
// All quantities are means over two grids half a cell apart. The sum of repulsion's forces is zero
// except for the sampling of E at cells. On one grid it can be a tenth of their size, but the
// errors of the two grids are opposite, and one to two hundredths remain (interlacing; Hockney and
// Eastwood 1988, Computer simulation using particles).
//
// A vertex counts at its position at the end of the step, extrapolated by its velocity: this
// removes energy from pressure waves instead of adding some. All quantities are continuous in the
// vertex positions.
//
// Shelter: hair slows the air of wind mode `drag` that flows through it. Let n be the length of
// hair per volume and f(u) the drag per length of a hair across air of speed u relative to it. The
// momentum that hair takes is missing in the air behind it (Belcher, Jerram and Hunt 2003,
// Adjustment of a turbulent boundary layer to a canopy of roughness elements):
//     rho u u' = -n f(u),   f(u) = rho r (u^2 + b u^(4/3)),   b = 10 (mu / (2 rho r))^(2/3).
// With N, the frontal area 2 r n summed along the way, per area across it, the solution is
//     u^(2/3) = (u0^(2/3) + b) exp(-N / 3) - b,
// or 0 from where that is negative; exp(-N / 2) u0 without viscosity. So the hair behind an area
// never bears more than the air's momentum, 1/2 rho u0^2 for each unit of it. Each guide stands for
// `shelter` hairs, which lie across the flow and move like the vertex that the air reaches. N is
// summed over the cells of the first grid along the straight line upstream of a vertex. Air does
// not flow round hair, and is not mixed again behind it.
//
// Sums are integers, so they don't depend on the order of additions. Their fixed point is set per
// block of 4 x 4 x 4 cells: a unit is at most 2^-31 of the share M of all vertices that reach into
// the block, and for momentum 2^-30 M V, where V is the largest component of their velocities. So
// sums can't overflow, and slow or sparse hair keeps its precision while hair elsewhere is fast or
// dense. With N vertices in a cell, rounding loses at most N / 2 units.
class HairHair {
public:
    HairHair(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    static engine::MemoryRows
    rows(const groom::GroomSize& size, const SimulationSettings& settings);

    // Slows `air`, and adds the accelerations of the next step. `now` and `later` are the head's
    // motions at its start and end.
    void record(
        engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& now,
        const RigidMotion& later, const AirAtGuides& air = {}) const;

    // Makes the next step ignore the previous one, after other code wrote the positions.
    void forget(const engine::Device& device);

    // State kept between steps.
    const engine::Buffer& state() const { return kept_; }

    // gpu::VolumeParameters::sums and blocks.
    const engine::Buffer& sums() const { return sums_; }
    const engine::Buffer& blocks() const { return blocks_; }
    const engine::Buffer& parameters() const { return parameters_; }

private:
    template <class Push>
    void bindForce(engine::Commands& commands, const Push& push) const;
    void recordShelter(
        engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& later,
        const AirAtGuides& air) const;

    std::uint32_t vertex_count_;
    gpu::YieldPush yield_{};  // without addresses of guides and frames
    gpu::VolumeAttraction attraction_;
    double area_per_share_;  // gpu::ShelterPush
    engine::Buffer shares_;
    engine::Buffer samples_;
    engine::Buffer sums_;
    engine::Buffer blocks_;
    std::optional<engine::Buffer> spreads_;  // gpu::YieldPush, if hair yields
    engine::Buffer parameters_;  // gpu::VolumeParameters
    engine::Buffer kept_;  // vec4 [strand][vertex]
    engine::ComputePipeline sample_;
    engine::ComputePipeline splat_;
    std::optional<engine::ComputePipeline> spread_;  // if hair yields
    std::optional<engine::ComputePipeline> shelter_;  // if hair shelters hair
    std::optional<engine::ComputePipeline> force_;  // if hair touches hair
};

}  // namespace hair::simulation
