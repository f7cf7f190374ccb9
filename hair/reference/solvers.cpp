#include "hair/reference/solvers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "hair/reference/compared_rods.h"
#include "hair/reference/rod.h"
#include "hair/reference/wind.h"
#include "hair/simulation/solvers.h"

namespace hair::reference {

// ---- Bending ------------------------------------------------------------------------------------

namespace {

// Solves a symmetric positive definite system, stored row by row: Cholesky, then both triangular
// solves.
std::vector<double> solvePositive(std::vector<double> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
    return b;
}

// An unknown angle: along `direction` it turns everything below the vertex `about`.
struct Angle {
    std::size_t segment;
    glm::dvec3 direction;
    glm::dvec3 about;
};

}  // namespace

void bendStrand(Points positions, ConstPoints rest, const BendStep& step) {
    const std::size_t count = positions.size();
    const auto frames = segmentFrames(positions, rest, step.frame);
    std::vector<glm::dvec3> edges(count), tangents(count);
    std::vector<double> lengths(count);
    std::vector<bool> rigid(count);
    const glm::dvec3 first = rest[1] - rest[0];
    tangents[0] = step.frame * (glm::length(first) < kShortest ? glm::dvec3(0.0, 1.0, 0.0)
                                                               : glm::normalize(first));
    std::vector<Angle> angles;
    for (std::size_t i = 1; i < count; ++i) {
        edges[i] = positions[i] - positions[i - 1];
        lengths[i] = glm::distance(rest[i], rest[i - 1]);
        rigid[i] = glm::length(edges[i]) < kShortest || lengths[i] < kShortest;
        tangents[i] = rigid[i] ? tangents[i - 1] : glm::normalize(edges[i]);
        if (rigid[i]) continue;
        const glm::dvec3 sum = tangents[i - 1] + tangents[i];
        const glm::dvec3 axis = glm::length(sum) < 1e-3 ? tangents[i] : glm::normalize(sum);
        const glm::dvec3 side = sideways(axis);
        angles.push_back({i, side, positions[i - 1]});
        angles.push_back({i, glm::cross(axis, side), positions[i - 1]});
    }

    const std::size_t size = angles.size();
    std::vector<double> matrix(size * size), right(size);
    const glm::dvec3 root_moved = step.root - positions[0];
    // Adds |f + sum of angle * g|^2 / 2, in the metric given, to the substep's energy.
    const auto add = [&](std::size_t upTo, const auto& metric, const glm::dvec3& residual,
                         const auto& gradient) {
        std::vector<glm::dvec3> gradients;
        for (const Angle& angle : angles)
            if (angle.segment <= upTo) gradients.push_back(gradient(angle));
        for (std::size_t a = 0; a < gradients.size(); ++a) {
            const glm::dvec3 weighed = metric * gradients[a];
            right[a] += glm::dot(gradients[a], residual);
            for (std::size_t b = 0; b <= a; ++b)
                matrix[a * size + b] += glm::dot(weighed, gradients[b]);
        }
    };
    for (std::size_t i = 1; i < count; ++i) {
        const glm::dvec3 carried = root_moved + glm::cross(step.turn, positions[i] - positions[0]);
        add(i, step.masses[i], step.pushes[i] - step.masses[i] * carried, [&](const Angle& angle) {
            return glm::cross(angle.direction, positions[i] - angle.about);
        });
    }
    glm::dvec3 force{0.0};
    for (std::size_t i = count - 1; i > 0; --i) {
        force += step.pushes[i] + step.turning_pushes[i] - step.masses[i] * root_moved;
        if (rigid[i]) continue;
        const double tension = std::fmax(glm::dot(force, tangents[i]), 0.0);
        const glm::dmat3 across = tension * glm::length(edges[i]) *
                                  (glm::dmat3(1.0) - glm::outerProduct(tangents[i], tangents[i]));
        add(i, across, -(across * step.turn), [](const Angle& angle) { return angle.direction; });
    }
    for (std::size_t a = 0; a < size; ++a) {
        const std::size_t i = angles[a].segment;
        const glm::dvec3 goal = frames[i - 1] * (rest[i] - rest[i - 1]);
        right[a] += step.stiffness * glm::dot(angles[a].direction, glm::cross(edges[i], goal));
        matrix[a * size + a] += step.damping * step.stiffness * glm::dot(edges[i], edges[i]);
    }

    const std::vector<double> turns = solvePositive(std::move(matrix), std::move(right));
    glm::dvec3 turn = step.turn;
    glm::dvec3 place = step.root;
    positions[0] = place;
    for (std::size_t i = 1, a = 0; i < count; ++i) {
        for (; a < size && angles[a].segment == i; ++a) turn += turns[a] * angles[a].direction;
        glm::dvec3 direction(0.0, 1.0, 0.0);
        if (!rigid[i]) {
            const glm::dvec3 bounded = turn / std::fmax(glm::length(turn), 1.0);
            const glm::dvec3 gain = glm::cross(bounded, edges[i]);
            direction = glm::normalize(edges[i] + gain + 0.5 * glm::cross(bounded, gain));
        }
        if (lengths[i] >= kShortest) place += lengths[i] * direction;
        positions[i] = place;
    }
}

// ---- Solvers ------------------------------------------------------------------------------------

namespace {

// ---- Rods ---------------------------------------------------------------------------------------

// Inputs of a rod method's step.
struct RodStep {
    std::span<const glm::dvec3> accelerations;
    RodRoot root;
    const RodAir* air;
    const SimulationSettings& settings;
    const Step& step;
};

// One step of a strand, and the push by collisions after it.
struct RodMethod {
    void (*step)(RodState&, const RodRest&, const RodStep&);
    void (*push)(RodState&, const RodRest&, std::span<const glm::dvec3>, double substep);
};

// A Reference's solver of rods by one of these methods.
class RodSolver : public Solver {
public:
    RodSolver(
        const groom::Groom& groom, const SimulationSettings& settings, const Step& step,
        const RodMethod& method);

    void step(const Substep& substep) override;
    void adopt(const Substep& substep) override;

private:
    SimulationSettings settings_;
    Step step_;
    RodMethod method_;
    std::vector<RodRest> rests_;  // [strand]
    std::vector<RodState> states_;  // [strand]
};

RodRoot rootOf(const simulation::RigidMotion& motion) {
    return {.rotation = motion.rotation, .translation = motion.translation};
}

RodSolver::RodSolver(
    const groom::Groom& groom, const SimulationSettings& settings, const Step& step,
    const RodMethod& method)
    : settings_(settings), step_(step), method_(method) {
    const MaterialSettings& material = settings.material;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        const auto points = groom.strand(i);
        rests_.push_back(makeRodRest(
            std::vector<glm::dvec3>(points.begin(), points.end()),
            {.density = wetDensity(material),
             .radius = material.radius,
             .ellipticity = material.ellipticity,
             .section_angle = double{material.section_angle} * std::numbers::pi / 180.0,
             .twist = material.twist,
             .youngs_modulus = material.youngs_modulus,
             .shear_modulus = material.shear_modulus}));
        states_.push_back(rodAtRest(rests_.back()));
    }
}

void RodSolver::step(const Substep& substep) {
    RodState& state = states_[substep.strand];
    const RodRest& rest = rests_[substep.strand];
    const std::vector<glm::dvec3> before(substep.positions.begin(), substep.positions.end());
    RodAir air{.velocities = substep.air, .rates = {}};
    air.rates = [&](ConstPoints tangents, ConstPoints velocities) {
        return dragRates(tangents, velocities, substep.air, settings_);
    };
    method_.step(
        state, rest,
        {.accelerations = substep.accelerations,
         .root = rootOf(substep.frame),
         .air = substep.air.empty() ? nullptr : &air,
         .settings = settings_,
         .step = step_});
    std::vector<glm::dvec3> positions = state.positions();
    for (std::size_t i = 1; i < positions.size(); ++i)
        positions[i] = substep.push_out(positions[i], before[i]).position;
    method_.push(state, rest, positions, step_.sub);
    std::ranges::copy(before, substep.previous.begin());
    std::ranges::copy(positions, substep.positions.begin());
}

void RodSolver::adopt(const Substep& substep) {
    RodState& state = states_[substep.strand];
    std::vector<glm::dquat> set = std::move(state.set);
    state = rodFrom(
        rests_[substep.strand], substep.positions, substep.previous, step_.sub,
        rootOf(substep.frame));
    state.set = std::move(set);
}

// Inextensible rods, by Newton's method.
void stepInextensibleRod(RodState& state, const RodRest& rest, const RodStep& step) {
    const RodSettings& settings = step.settings.rod;
    const bool alpha = settings.integrator == RodIntegrator::generalized_alpha;
    stepRod(
        state, rest, step.accelerations, step.root, step.step.sub,
        keptFactor(step.settings, step.step),
        {.iterations = settings.iterations,
         .integrator = alpha ? Integrator::generalized_alpha : Integrator::implicit_euler,
         .damping = step.settings.material.damping,
         .set_share = step.settings.material.set_share,
         .set_time = step.settings.material.set_time},
        step.air);
}

constexpr RodMethod kInextensible = {stepInextensibleRod, pushRod};

void stepStableCosseratRod(RodState& state, const RodRest& rest, const RodStep& step) {
    const double radius = step.settings.material.radius;
    const StableCosseratSettings& settings = step.settings.stable_cosserat;
    stepStableCosserat(
        state, rest, step.accelerations, step.root,
        {.method = settings.method,
         .substep = step.step.sub,
         .velocity_kept = keptFactor(step.settings, step.step),
         .stretch_stiffness = double{settings.stretch_modulus} * std::numbers::pi * radius * radius,
         .iterations = settings.iterations},
        step.air);
}

void pushElasticRod(
    RodState& state, const RodRest&, std::span<const glm::dvec3> positions, double substep) {
    pushVertices(state, positions, substep);
}

constexpr RodMethod kStableCosserat = {stepStableCosseratRod, pushElasticRod};

void stepPositionBased(RodState& state, const RodRest& rest, const RodStep& step) {
    const MaterialSettings& material = step.settings.material;
    const double radius = material.radius;
    stepPositionBasedRod(
        state, rest, step.accelerations, step.root,
        {.substep = step.step.sub,
         .velocity_kept = keptFactor(step.settings, step.step),
         .stretch_stiffness = double{material.youngs_modulus} * std::numbers::pi * radius * radius,
         .iterations = step.settings.position_based_rod.iterations},
        step.air);
}

constexpr RodMethod kPositionBased = {stepPositionBased, pushElasticRod};

void stepMassSpring(RodState& state, const RodRest& rest, const RodStep& step) {
    const MaterialSettings& material = step.settings.material;
    const AugmentedMassSpringSettings& settings = step.settings.augmented_mass_spring;
    const double section = std::numbers::pi * double{material.radius} * double{material.radius};
    stepAugmentedMassSpring(
        state, rest, step.accelerations, step.root,
        {.substep = step.step.sub,
         .velocity_kept = keptFactor(step.settings, step.step),
         .spring_stiffness = double{settings.spring_modulus} * section,
         .integrity = settings.integrity,
         .angular_stiffness = double{settings.angular_stiffness} * wetDensity(material) * section,
         .iterations = settings.iterations},
        step.air);
}

constexpr RodMethod kMassSpring = {stepMassSpring, pushElasticRod};

// ---- Solvers without a state of their own -------------------------------------------------------

std::vector<glm::dvec3> moved(ConstPoints points, const simulation::RigidMotion& motion) {
    std::vector<glm::dvec3> result;
    for (const glm::dvec3& point : points) result.push_back(motion(point));
    return result;
}

// Velocities as differences of positions.
std::vector<glm::dvec3> velocitiesOf(const Substep& substep, const Step& step) {
    std::vector<glm::dvec3> velocities;
    for (std::size_t i = 0; i < substep.positions.size(); ++i)
        velocities.push_back((substep.positions[i] - substep.previous[i]) / step.sub);
    return velocities;
}

// Returns the drag at the start of the substep; empty without air.
std::vector<glm::dmat3>
dragOf(const Substep& substep, const SimulationSettings& settings, const Step& step) {
    if (substep.air.empty()) return {};
    return dragRates(
        tangentsAt(substep.positions), velocitiesOf(substep, step), substep.air, settings);
}

// `none`: the head carries every vertex.
void stepRest(const Substep& substep, const SimulationSettings&, const Step&) {
    for (std::size_t i = 0; i < substep.rest.size(); ++i) {
        substep.previous[i] = substep.positions[i];
        substep.positions[i] = substep.frame(substep.rest[i]);
    }
}

// The substep's system of the local constraint with an energy, with everything that acts on
// vertices.
void bendShape(
    const Substep& substep, ConstPoints rest, std::span<const glm::dmat3> drag,
    const SimulationSettings& settings, const Step& step) {
    const std::size_t vertices = rest.size();
    double length = 0.0;
    for (std::size_t i = 1; i < vertices; ++i) length += glm::distance(rest[i], rest[i - 1]);
    const double k = globalFactor(settings, step);
    const double spring = k / std::fmax(1.0 - k, 1e-6);
    BendStep bend{
        .pushes = std::vector(vertices, glm::dvec3(0.0)),
        .masses = std::vector(vertices, glm::dmat3(1.0 + spring)),
        .turning_pushes = std::vector(vertices, glm::dvec3(0.0)),
        .stiffness = bendFactor(settings, step, length / static_cast<double>(vertices - 1)),
        .damping = std::fmax(1.0, 1.0 / (60.0 * step.sub)),
        .frame = glm::mat3_cast(substep.frame_before.rotation),
        .turn = {},
        .root = rest[0]};
    const glm::dquat turn = substep.frame.rotation * glm::conjugate(substep.frame_before.rotation);
    bend.turn = (turn.w < 0.0 ? -2.0 : 2.0) * glm::dvec3(turn.x, turn.y, turn.z);
    const double h = step.sub;
    for (std::size_t i = 1; i < vertices; ++i) {
        const glm::dvec3 moved = substep.positions[i] - substep.previous[i];
        bend.pushes[i] = keptFactor(settings, step) * moved + h * h * substep.accelerations[i] +
                         spring * (rest[i] - substep.positions[i]);
        if (drag.empty()) continue;
        bend.masses[i] += h * drag[i];
        bend.pushes[i] += h * h * (drag[i] * substep.air[i]);
        const glm::dvec3 tangent = tangentsAt(substep.positions)[i];
        const glm::dvec3 wind = h * substep.air[i] - moved;
        bend.turning_pushes[i] = (drag[i][0][0] + drag[i][1][1] + drag[i][2][2]) / 2.0 * h *
                                 glm::dot(tangent, wind) * tangent;
    }
    std::ranges::copy(substep.positions, substep.previous.begin());
    bendStrand(substep.positions, substep.rest, bend);
}

// The order of thesis section 3.2, then collisions.
void stepShape(const Substep& substep, const SimulationSettings& settings, const Step& step) {
    const std::size_t vertices = substep.rest.size();
    const Points positions = substep.positions;
    const auto rest = moved(substep.rest, substep.frame);
    const glm::dmat3 root_frame = glm::mat3_cast(substep.frame.rotation);
    double length = 0.0;
    for (std::size_t i = 1; i < vertices; ++i)
        length += glm::distance(substep.rest[i], substep.rest[i - 1]);
    const double local = localFactor(settings, step, length / static_cast<double>(vertices - 1));

    const std::vector<glm::dvec3> before(positions.begin(), positions.end());
    const std::vector<glm::dmat3> drag = dragOf(substep, settings, step);
    std::vector<double> inverse_masses;
    const bool bends = settings.local.method == LocalMethod::energy &&
                       settings.local.stiffness > 0.0f && settings.local.iterations > 0;
    for (const glm::dmat3& rate : drag) inverse_masses.push_back(inverseMassIn(rate, step.sub));
    if (bends) {
        bendShape(substep, rest, drag, settings, step);
    } else {
        substep.previous[0] = positions[0];
        positions[0] = rest[0];
        integrate(
            positions, substep.previous, substep.accelerations, keptFactor(settings, step),
            step.sub);
        for (std::size_t i = 1; i < drag.size(); ++i)
            positions[i] = before[i] + step.sub * withDrag(
                                                      (positions[i] - before[i]) / step.sub,
                                                      drag[i], substep.air[i], step.sub);
        pullToRest(positions, rest, globalFactor(settings, step), inverse_masses);
        for (std::uint32_t i = 0; i < settings.local.iterations; ++i)
            pullToShape(positions, substep.rest, local, root_frame, inverse_masses);
        if (settings.length.method == LengthMethod::tridiagonal)
            solveLengths(positions, rest, settings.length.iterations, inverse_masses);
        else
            for (std::uint32_t i = 0; i < settings.length.iterations; ++i)
                projectLengths(positions, rest, inverse_masses);
    }

    // Bodies act between two length passes: one more pass if the strand touches a body.
    std::vector<VertexContact> met(vertices);
    for (std::size_t i = 1; i < vertices; ++i) {
        met[i] = substep.push_out(positions[i], before[i]);
        positions[i] = met[i].position;
    }
    if (std::ranges::any_of(met, &VertexContact::touches) &&
        settings.length.method == LengthMethod::tridiagonal && settings.length.iterations > 0)
        solveLengths(positions, rest, 1, inverse_masses, met);
}

void stepFtl(const Substep& substep, const SimulationSettings& settings, const Step& step) {
    const std::vector<glm::dmat3> drag = dragOf(substep, settings, step);
    reference::stepFtl(
        substep.positions, substep.previous, moved(substep.rest, substep.frame),
        {.accelerations = substep.accelerations,
         .drag = drag,
         .air = substep.air,
         .substep = step.sub,
         .velocity_kept = keptFactor(settings, step),
         .global_stiffness = globalFactor(settings, step),
         .velocity_correction = double{settings.ftl.velocity_correction}},
        substep.push_out);
}

using Function = void (*)(const Substep&, const SimulationSettings&, const Step&);

// A solver without a state of its own.
template <Function kFunction>
class Stateless : public Solver {
public:
    Stateless(const groom::Groom&, const SimulationSettings& settings, const Step& step)
        : settings_(settings), step_(step) {}

    void step(const Substep& substep) override { kFunction(substep, settings_, step_); }

private:
    SimulationSettings settings_;
    Step step_;
};

template <class Made>
std::unique_ptr<Solver>
make(const groom::Groom& groom, const SimulationSettings& settings, const Step& step) {
    return std::make_unique<Made>(groom, settings, step);
}

template <const RodMethod& kMethod>
std::unique_ptr<Solver>
makeRods(const groom::Groom& groom, const SimulationSettings& settings, const Step& step) {
    return std::make_unique<RodSolver>(groom, settings, step, kMethod);
}

struct Row {
    hair::Solver solver;
    std::unique_ptr<Solver> (*make)(const groom::Groom&, const SimulationSettings&, const Step&);
};

constexpr Row kSolvers[] = {
    {hair::Solver::none, make<Stateless<stepRest>>},
    {hair::Solver::shape, make<Stateless<stepShape>>},
    {hair::Solver::ftl, make<Stateless<stepFtl>>},
    {hair::Solver::rod, makeRods<kInextensible>},
    {hair::Solver::stable_cosserat, makeRods<kStableCosserat>},
    {hair::Solver::position_based_rod, makeRods<kPositionBased>},
    {hair::Solver::augmented_mass_spring, makeRods<kMassSpring>},
};

}  // namespace

// ---- The simulation -----------------------------------------------------------------------------

Reference::Reference(
    const groom::Groom& groom, const SimulationSettings& settings, std::uint32_t seed)
    : settings_(settings), step_(reference::inDouble(simulation::stepOf(settings))), seed_(seed),
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
    friction_kept_.clear();
    if (!solver_) return;
    for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand)
        solver_->adopt(
            {.strand = strand,
             .positions = ofStrand(positions_, strand),
             .previous = ofStrand(previous_, strand),
             .rest = ofStrand(rest_, strand),
             .accelerations = {},
             .air = {},
             .frame = motion_.at(time()),
             .frame_before = motion_.at(time()),
             .push_out = {}});
}

void Reference::step() {
    advance(airNow(settings_), (steps_ + 1) * step_.whole);
    ++steps_;
}

void Reference::settle() {
    SimulationSettings calm = settings_;
    calm.wind.strength = 0.0f;
    calm.wind.speed = 0.0f;
    advance(airNow(calm), time());
}

Air Reference::airNow(const SimulationSettings& settings) const {
    Air air;
    for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand) {
        const Air of_strand = airAt(
            ofStrand(positions_, strand), settings, seed_, static_cast<std::uint32_t>(strand),
            time());
        std::ranges::copy(of_strand.accelerations, std::back_inserter(air.accelerations));
        std::ranges::copy(of_strand.velocities, std::back_inserter(air.velocities));
    }
    return air;
}

void Reference::advance(Air air, double then) {
    if (!solver_) return;
    const VolumeState volume{
        .vertices = vertices_,
        .rest = rest_,
        .positions = positions_,
        .previous = previous_,
        .step = step_,
        .frame = motion_.at(then),
        .kept = &friction_kept_,
        .frame_before = motion_.at(time())};
    std::vector<glm::dvec3> accelerations = air.accelerations;
    if (!air.velocities.empty()) {
        shelterAir(settings_, volume, air.velocities);
        const std::vector<glm::dvec3> velocities = volume.velocities();
        for (std::size_t strand = 0; strand < rest_.size() / vertices_; ++strand)
            std::ranges::copy(
                alongAccelerations(
                    ofStrand(positions_, strand), ofStrand(velocities, strand),
                    ofStrand(air.velocities, strand), settings_, step_.whole),
                ofStrand(accelerations, strand).begin());
    }
    const std::vector<glm::dvec3> contact_accelerations =
        reference::volumeAccelerations(settings_, volume);
    for (std::size_t i = 0; i < accelerations.size(); ++i)
        accelerations[i] += glm::dvec3(settings_.gravity) + contact_accelerations[i];
    // While hair settles, time stands still and no hand pulls.
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
                 .air = air.velocities.empty() ? ConstPoints{} : ofStrand(air.velocities, strand),
                 .frame = contact.frame,
                 .frame_before = contact.frame_before,
                 .push_out = contact});
    }
}

// ---- The table ----------------------------------------------------------------------------------

std::unique_ptr<Solver>
makeSolver(const groom::Groom& groom, const SimulationSettings& settings, const Step& step) {
    if (settings.solver == hair::Solver::none && settings.motion.keyframes.empty()) return nullptr;
    const Row* row = std::ranges::find(kSolvers, settings.solver, &Row::solver);
    assert(row != std::end(kSolvers));
    return row->make(groom, settings, step);
}

}  // namespace hair::reference
