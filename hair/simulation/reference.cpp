#include "hair/simulation/reference.h"

#include <cassert>

#include "hair/simulation/reference_constraints.h"
#include "hair/simulation/reference_contact.h"
#include "hair/simulation/reference_pull.h"
#include "hair/simulation/reference_volume.h"
#include "hair/simulation/reference_wind.h"
#include "hair/simulation/solver.h"

namespace hair {

Reference::Reference(const Groom& groom, const SimulationSettings& settings, std::uint32_t seed)
    : settings_(settings), step_(reference::inDouble(stepOf(settings))), seed_(seed),
      motion_(settings.motion), vertices_(groom.vertices_per_strand),
      rest_(groom.points.begin(), groom.points.end()),
      solver_(reference::makeSolver(groom, settings, step_)) {
    std::vector<glm::dvec3> start;
    for (const glm::dvec3& point : rest_) start.push_back(motion_.at(0.0)(point));
    setState(start, start);
}

void Reference::setState(
    std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous) {
    assert(positions.size() == rest_.size() && previous.size() == rest_.size());
    positions_.assign(positions.begin(), positions.end());
    previous_.assign(previous.begin(), previous.end());
    if (!solver_) return;
    for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand)
        solver_->adopt(
            {.strand = strand,
             .positions = ofStrand(positions_, strand),
             .previous = ofStrand(previous_, strand),
             .rest = ofStrand(rest_, strand),
             .accelerations = {},
             .frame = motion_.at(time()),
             .push_out = {}});
}

void Reference::step() {
    advance(airAccelerations(settings_), (steps_ + 1) * step_.whole);
    ++steps_;
}

void Reference::settle() {
    SimulationSettings calm = settings_;
    calm.wind.strength = 0.0f;
    calm.wind.speed = 0.0f;
    advance(airAccelerations(calm), time());
}

std::vector<glm::dvec3> Reference::airAccelerations(const SimulationSettings& settings) const {
    std::vector<glm::dvec3> accelerations;
    for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand) {
        const auto of_strand = reference::airAccelerations(
            ofStrand(positions_, strand), ofStrand(previous_, strand), settings, seed_,
            static_cast<std::uint32_t>(strand), step_, time());
        accelerations.insert(accelerations.end(), of_strand.begin(), of_strand.end());
    }
    return accelerations;
}

void Reference::advance(std::span<const glm::dvec3> wind_accelerations, double then) {
    if (!solver_) return;
    std::vector<glm::dvec3> accelerations(wind_accelerations.begin(), wind_accelerations.end());
    const std::vector<glm::dvec3> contact_accelerations = reference::volumeAccelerations(
        settings_, {.vertices = vertices_,
                    .rest = rest_,
                    .positions = positions_,
                    .previous = previous_,
                    .step = step_,
                    .frame = motion_.at(then)});
    for (std::size_t i = 0; i < accelerations.size(); ++i)
        accelerations[i] += glm::dvec3(settings_.gravity) + contact_accelerations[i];
    // While hair settles time stands still, and no hand pulls.
    if (then > time())
        reference::addPulls(
            settings_.pulls,
            {.vertices = vertices_,
             .rest = rest_,
             .positions = positions_,
             .previous = previous_,
             .substep = step_.sub,
             .from = time(),
             .to = then},
            accelerations);
    const auto frameAfter = [&](std::uint32_t substep) {
        return motion_.at(time() + (then - time()) * substep / step_.count);
    };
    for (std::uint32_t i = 0; i < step_.count; ++i) {
        const reference::Contact contact{
            .settings = settings_, .frame = frameAfter(i + 1), .frame_before = frameAfter(i)};
        for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand)
            solver_->step(
                {.strand = strand,
                 .positions = ofStrand(positions_, strand),
                 .previous = ofStrand(previous_, strand),
                 .rest = ofStrand(rest_, strand),
                 .accelerations = ofStrand(accelerations, strand),
                 .frame = contact.frame,
                 .push_out = contact});
    }
}

}  // namespace hair
