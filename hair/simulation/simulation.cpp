#include "hair/simulation/simulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "engine/error.h"
#include "engine/process.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

using engine::Access;
using engine::Commands;

constexpr std::int64_t kPartsPerStep = 720720;  // least common multiple of 1 .. 16

static_assert(sizeof(gpu::Bodies) == 32);
static_assert(sizeof(gpu::GuideParameters) == 96 && offsetof(gpu::GuideParameters, gravity) == 56);
static_assert(offsetof(gpu::GuideParameters, step) == 68);
static_assert(sizeof(gpu::SubstepPush) == 124 && offsetof(gpu::SubstepPush, frame_before) == 68);
static_assert(offsetof(gpu::SubstepPush, drag) == 116);

constexpr std::uint32_t kSettleBatch = 64;  // substeps per submission

std::vector<glm::vec4> withMargin(std::span<const glm::vec3> points, float margin) {
    std::vector<glm::vec4> result;
    result.reserve(points.size());
    for (const glm::vec3& point : points) result.emplace_back(point, margin);
    return result;
}

// Whether segments are kept out of bodies by a separate pass; `rod` does it itself.
bool hasSegmentPass(const SimulationSettings& settings) {
    if (settings.collision.parts == CollisionParts::vertices) return false;
    switch (settings.solver) {
    case Solver::rod:
        if (settings.collision.warm_start)
            throw engine::Error(
                "/simulation/collision/parts",
                "is segments, but warm_start carries only the contact forces of vertices");
        return false;
    case Solver::none:
        return false;
    case Solver::shape:
    case Solver::ftl:
    case Solver::extension:
        return true;
    default:
        throw engine::Error(
            "/simulation/collision/parts",
            "is segments, which only the solvers shape, ftl, rod and files support");
    }
}

}  // namespace

// ---- Fixed steps --------------------------------------------------------------------------------

FixedStep::FixedStep(double step) : step_(step) { assert(step > 0.0); }

std::uint32_t FixedStep::stepsFor(double frame_time) {
    assert(frame_time >= 0.0);
    parts_ += std::llround(frame_time / step_ * double{kPartsPerStep});
    const std::int64_t steps = parts_ / kPartsPerStep;
    parts_ -= steps * kPartsPerStep;
    return static_cast<std::uint32_t>(steps);
}

double FixedStep::remainder() const { return static_cast<double>(parts_) / double{kPartsPerStep}; }

// ---- Guides on the device -----------------------------------------------------------------------

engine::MemoryRows Simulation::rows(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings) {
    const std::size_t vectors = engine::bytesOf<glm::vec4>(size.vertices());
    engine::MemoryRows rows(
        "simulation", {{"guide rest positions", vectors},
                       {"guide positions", vectors, 2},
                       {"guide previous positions", vectors, 2},
                       {"guide accelerations", vectors},
                       {"guide parameters", 2 * sizeof(gpu::GuideParameters)},
                       {"settled state", vectors, 2}});
    rows.add(Bodies::rows(settings));
    rows.add(WindPass::rows(size.vertices(), settings.wind.mode));
    rows.add(solverRows(device, size, settings));
    if (!settings.pulls.empty()) rows.add(PullPass::rows());
    const bool moves_vertices = settings.solver == Solver::shape ||
                                settings.solver == Solver::ftl ||
                                settings.solver == Solver::extension;
    if (moves_vertices && hasSegmentPass(settings)) rows.add(SegmentPass::rows(size.vertices()));
    if (hairActsOnHair(settings)) rows.add(HairHair::rows(size, settings));
    if (hasSkinnedRoots(settings))
        rows.add(SkinnedRoots::rows(size.guides, stepOf(settings).count));
    if (size.cached_points > 0) rows.add(CachePass::rows(size, settings.solver == Solver::shape));
    return rows;
}

Simulation::Simulation(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    std::uint32_t seed, std::span<const groom::Mesh> field_meshes, const MadeBefore& made,
    const groom::DeformingMesh* deforming)
    : device_(&device), settings_(settings), step_(stepOf(settings)),
      strand_count_(groom.strand_count), vertices_per_strand_(groom.vertices_per_strand),
      seed_(seed), pinned_(groom.points.size()), motion_(settings.motion),
      bodies_(device, settings, field_meshes, made.fields),
      wind_(device, strand_count_ * vertices_per_strand_, settings),
      solver_(makeSolver(device, groom, settings_, step_)) {
    assert(strand_count_ > 0 && vertices_per_strand_ > 1);
    assert(groom.points.size() == std::size_t{strand_count_} * vertices_per_strand_);
    checkPulls(settings.pulls, strand_count_, vertices_per_strand_);
    const engine::MemoryRows rows = Simulation::rows(device.info(), sizeOf(groom), settings);
    rest_positions_ = engine::makeBuffer(
        device, withMargin(groom.points, settings.collision.margin), rows, "guide rest positions");
    for (std::size_t copy = 0; copy < 2; ++copy) {
        positions_[copy] = {device, rows["guide positions"]};
        previous_[copy] = {device, rows["guide previous positions"]};
    }
    accelerations_ = {device, rows["guide accelerations"]};
    parameters_ =
        engine::makeBuffer(device, parametersWith(bodies_.parameters()), rows, "guide parameters");
    if (deforming) roots_.emplace(device, groom, *deforming, step_.count);
    if (!settings.animation.clip.empty() && !roots_)
        throw engine::Error("/simulation/animation/clip", "is set, but hair grows on no mesh");
    if (solver_ && !settings.force.empty())
        force_.emplace(device, strand_count_ * vertices_per_strand_, settings);
    if (hasPulls()) pulls_.emplace(pullPassOf(settings));
    if (hasSegmentPass(settings))
        segments_.emplace(device, strand_count_, vertices_per_strand_, settings);
    if (hairActsOnHair(settings)) hair_hair_.emplace(device, groom, settings, step_);
    const std::vector<RigidMotion> placed = rootMotions();
    std::vector<glm::vec3> start;
    start.reserve(groom.points.size());
    for (const glm::vec3& point : groom.points)
        start.emplace_back(placed[start.size() / vertices_per_strand_](point));
    setState(start, start);
    if (balance()) balanceRest(start);
    if (!groom.cache.times.empty()) startCache(groom);
    for (const engine::Buffer* buffer : state()) {
        engine::BufferDescription settled = rows["settled state"];
        settled.size = buffer->size();
        settled_.emplace_back(device, settled);
    }
    const auto fits = [](const std::vector<std::byte>& bytes, const engine::Buffer& buffer) {
        return bytes.size() == buffer.size();
    };
    if (made.settled && std::ranges::equal(made.settled->buffers, settled_, fits)) {
        for (std::size_t i = 0; i < settled_.size(); ++i)
            engine::upload(device, made.settled->buffers[i], settled_[i]);
        reset();
        return;
    }
    settle(settings.settle_steps);
    runOnce(device, [&](engine::Commands& commands) {
        for (std::size_t i = 0; i < settled_.size(); ++i)
            commands.copy(*state()[i], settled_[i], settled_[i].size());
        commands.fill(accelerations_, 0);
    });
}

void Simulation::balanceRest(std::span<const glm::vec3> start) {
    constexpr int kMostCorrections = 64;
    constexpr float kClear = 1e-5f;  // m: no contact, despite rounding
    auto rest = engine::downloadAs<glm::vec4>(*device_, rest_positions_);
    const std::vector<gpu::VertexCondition> vertices = inspect();
    for (std::size_t i = 0; i < rest.size(); ++i)
        rest[i].w = std::min(rest[i].w, vertices[i].gap - kClear);
    engine::upload(*device_, std::as_bytes(std::span(rest)), rest_positions_);

    const auto with_bodies = parametersWith(bodies_.parameters());
    const auto without = parametersWith({});
    engine::upload(*device_, std::as_bytes(std::span(without)), parameters_);
    const std::vector<RigidMotion> placed = rootMotions();
    engine::Step balancing("balances the rest shape, correction", kMostCorrections);
    bool corrects = true;
    for (int i = 0; i < kMostCorrections && corrects; ++i) {
        balancing.advance();
        setState(start, start);
        runOnce(*device_, [&](engine::Commands& commands) {
            wind_.recordCalm(commands, addresses());
            recordSubsteps(commands, 1, current_, 0.0, 0.0);
        });
        std::vector<glm::vec3> moved;
        for (std::size_t vertex = 0; const glm::vec3& now : readPositions()) {
            const glm::dquat& rotation = placed[vertex / vertices_per_strand_].rotation;
            moved.emplace_back(
                glm::conjugate(rotation) * (glm::dvec3(now) - glm::dvec3(start[vertex++])));
        }
        corrects = solver_->correctBalance(*device_, moved);
    }
    engine::upload(*device_, std::as_bytes(std::span(with_bodies)), parameters_);
    setState(start, start);
}

void Simulation::startCache(const groom::Groom& groom) {
    if (roots_)
        throw engine::Error(
            "/groom/cache/mode", "can't be used with an animation that deforms the mesh");
    cache_.emplace(*device_, groom, rest_positions_, solver_ ? solver_->goals() : nullptr);
    runOnce(*device_, [&](engine::Commands& commands) { cache_->recordRest(commands, 0.0); });
    std::vector<glm::vec3> start;
    start.reserve(groom.points.size());
    const RigidMotion head = pose();
    for (const glm::vec3& point : std::span(groom.cache.points).first(groom.points.size()))
        start.emplace_back(head(point));
    setState(start, start);
}

void Simulation::recordFollow(engine::Commands& commands, double from, double to) const {
    if (cache_ && cache_->follows())
        cache_->recordFollow(commands, addresses(), motion_.at(from), motion_.at(to), to);
}

SettledState Simulation::readSettled() const {
    SettledState settled;
    for (const engine::Buffer& buffer : settled_)
        settled.buffers.push_back(engine::download(*device_, buffer));
    return settled;
}

void Simulation::recordWind(engine::Commands& commands) const {
    if (solver_) wind_.record(commands, addresses(), time());
}

void Simulation::recordVolume(engine::Commands& commands) const {
    if (hair_hair_)
        hair_hair_->record(
            commands, addresses(), pose(), poseAt(time() + double{step_.whole}), wind_.air());
}

void Simulation::recordForce(engine::Commands& commands) const {
    if (force_) force_->record(commands, addresses(), time());
}

void Simulation::recordPulls(engine::Commands& commands) const {
    if (solver_ && pulls_) pulls_->record(commands, addresses(), time());
}

// Everything that may throw comes first. The parameters stay at the address that others know.
void Simulation::carryOn(const SimulationSettings& settings) {
    SimulationSettings whole = settings;
    HeadMotion motion(settings.motion);
    Bodies::Capsules capsules = Bodies::makeCapsules(*device_, settings);
    checkWind(settings.wind);
    std::optional<WindPass> other_wind;
    if (settings.wind.mode != settings_.wind.mode)
        other_wind.emplace(*device_, strand_count_ * vertices_per_strand_, settings);
    checkPulls(settings.pulls, strand_count_, vertices_per_strand_);
    std::vector<PullSettings> pulls = settings.pulls;
    std::optional<PullPass> first_pulls;
    if (!pulls_ && !pulls.empty()) first_pulls.emplace(pullPassOf(settings));
    std::unique_ptr<GuideSolver> solver;
    if (solver_) {
        if (capsules.count > 0) solver_->expectBodies(*device_);
    } else {
        // The solver was `none` without keyframes. Its new solver needs no points.
        solver = makeSolver(
            *device_, {.strand_count = strand_count_, .vertices_per_strand = vertices_per_strand_},
            settings, step_);
    }
    const auto parameters = parametersWith(bodies_.parametersWith(capsules));
    engine::upload(*device_, std::as_bytes(std::span(parameters)), parameters_);

    settings_ = std::move(whole);
    motion_ = std::move(motion);
    bodies_.setCapsules(std::move(capsules));
    if (other_wind)
        wind_ = std::move(*other_wind);
    else
        wind_.setWind(settings_.wind);
    if (first_pulls)
        pulls_ = std::move(first_pulls);
    else if (pulls_)
        pulls_->setPulls(std::move(pulls));
    if (solver) solver_ = std::move(solver);
}

void Simulation::recordStep(engine::Commands& commands, Copy into) {
    if (!solver_) return;
    const double start = time();
    const std::uint32_t from = current_;
    recordFollow(commands, start, start + double{step_.whole});
    ++steps_;
    if (into == Copy::other) current_ = 1 - current_;
    has_earlier_ = into == Copy::other;
    drawn_share_.reset();
    recordSubsteps(commands, step_.count, from, start, time());
}

void Simulation::interpolate() {
    if (!interpolation_) interpolation_.emplace(*device_, strand_count_ * vertices_per_strand_);
}

void Simulation::recordInterpolation(engine::Commands& commands, double share) {
    const std::uint32_t from = has_earlier_ ? 1 - current_ : current_;
    interpolation_->record(
        commands, positions_[from].address(), positions_[current_].address(), share);
    drawn_share_ = share;
}

double Simulation::drawnTime() const {
    if (!drawn_share_ || !has_earlier_) return time();
    return time() - (1.0 - *drawn_share_) * double{step_.whole};
}

void Simulation::settle(std::uint32_t steps) {
    if (!solver_) return;
    const std::uint32_t most = std::max(1u, kSettleBatch / step_.count);
    engine::Step settling("settles hair, step", steps);
    while (steps > 0) {
        const std::uint32_t batch = std::min(steps, most);
        runOnce(*device_, [&](engine::Commands& commands) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                wind_.recordCalm(commands, addresses());
                if (hair_hair_)
                    hair_hair_->record(commands, addresses(), pose(), pose(), wind_.air());
                recordFollow(commands, time(), time());
                recordSubsteps(commands, step_.count, current_, time(), time());
            }
        });
        steps -= batch;
        settling.advance(batch);
    }
}

void Simulation::recordReset(engine::Commands& commands) {
    steps_ = 0;
    has_earlier_ = false;
    drawn_share_.reset();
    for (std::size_t i = 0; i < settled_.size(); ++i)
        commands.copy(settled_[i], *state()[i], settled_[i].size());
    commands.fill(accelerations_, 0);
    if (!cache_) return;
    cache_->recordRest(commands, 0.0);
}

void Simulation::reset() {
    runOnce(*device_, [&](engine::Commands& commands) { recordReset(commands); });
}

void Simulation::setState(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> previous) {
    assert(positions.size() == previous.size());
    has_earlier_ = false;
    drawn_share_.reset();
    const auto now = withMasses(positions);
    std::vector<glm::vec4> before;
    for (const glm::vec3& point : previous) before.emplace_back(point, 0.0f);
    engine::upload(*device_, std::as_bytes(std::span(now)), positions_[current_]);
    engine::upload(*device_, std::as_bytes(std::span(before)), previous_[current_]);
    if (hair_hair_) hair_hair_->forget(*device_);
    if (!solver_) return;
    runOnce(*device_, [&](engine::Commands& commands) {
        const gpu::RigidFrame frame = toGpu(pose());
        if (const engine::Buffer* memory = solver_->memory()) commands.fill(*memory, 0);
        if (roots_) roots_->record(commands, motion_, 1, time(), time());
        commands.uses(
            {{positions_[current_], engine::Access::compute_read},
             {previous_[current_], engine::Access::compute_read}});
        solver_->recordAdopt(
            commands, {.guides = addresses().parameters,
                       .frame = frame,
                       .frame_before = frame,
                       .roots = roots_ ? commands.reads(roots_->address(0)) : 0,
                       .roots_before = roots_ ? commands.reads(roots_->address(0)) : 0});
    });
}

void Simulation::pin(std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t vertex : vertices) pinned_[vertex] = true;
    setState(readPositions(), readPrevious());
}

std::vector<glm::vec3> Simulation::readPositions() const {
    const auto points = engine::downloadAs<glm::vec4>(*device_, positions_[current_]);
    return {points.begin(), points.end()};
}

std::vector<glm::vec3> Simulation::readDrawn() const {
    if (!drawn_share_) return readPositions();
    const auto points = engine::downloadAs<glm::vec4>(*device_, interpolation_->positions());
    return {points.begin(), points.end()};
}

std::vector<glm::vec3> Simulation::readPrevious() const {
    const auto points = engine::downloadAs<glm::vec4>(*device_, previous_[current_]);
    return {points.begin(), points.end()};
}

std::vector<bool> Simulation::readContacts() const {
    std::vector<bool> contacts;
    for (const glm::vec4& point : engine::downloadAs<glm::vec4>(*device_, previous_[current_]))
        contacts.push_back(point.w > 0.0f);
    return contacts;
}

std::vector<gpu::VertexCondition> Simulation::inspect() const {
    return inspectVertices(
        *device_, addresses().parameters, toGpu(pose()), strand_count_ * vertices_per_strand_);
}

GuideCondition Simulation::condition() const {
    return worstOf(inspect(), vertices_per_strand_, double{step_.sub});
}

GuideView Simulation::guides() const {
    return {
        .positions =
            drawn_share_ ? interpolation_->positions().address() : positions_[current_].address(),
        .contacts = previous_[current_].address(),
        .bodies = parameters_.address() + offsetof(gpu::GuideParameters, bodies),
        .strand_count = strand_count_,
        .vertices_per_strand = vertices_per_strand_};
}

ProbedGuides Simulation::recordProbed(engine::Commands& commands) const {
    if (roots_) roots_->record(commands, motion_, 1, time(), time());
    const GuideAddresses now = addresses();
    return {
        .parameters = now.parameters,
        .positions = now.positions,
        .previous = now.previous,
        .frame = toGpu(pose()),
        .roots = roots_ ? roots_->address(0) : 0,
        .rods = solver_ ? solver_->elasticRods() : ElasticRods()};
}

// Records the first `count` substeps of a step. The head's frames divide the step's time evenly.
// The first substep takes the guides from one copy to the current one; later substeps stay there.
void Simulation::recordSubsteps(
    engine::Commands& commands, std::uint32_t count, std::uint32_t from_copy, double from,
    double to) const {
    std::span<const RigidMotion> means;
    if (roots_) means = roots_->record(commands, motion_, count, from, to);
    const auto frameAfter = [&](std::uint32_t substep) {
        if (roots_) return toGpu(means[substep]);
        const double part = static_cast<double>(substep) / step_.count;
        return toGpu(motion_.at(from + part * (to - from)));
    };
    const GuideAddresses guides = addresses();
    const AirAtGuides air = wind_.air();
    GuideAddresses before = addresses(from_copy);
    const bool segments = segments_ && bodies_.count() > 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (segments) segments_->recordStart(commands, positions_[i == 0 ? from_copy : current_]);
        if (cache_) {
            const double part = static_cast<double>(i + 1) / count;
            cache_->recordRest(commands, from + part * (to - from));
        }
        commands.uses(
            {{before.positions, Access::compute_read},
             {before.previous, Access::compute_read},
             {guides.positions, Access::compute_write},
             {guides.previous, Access::compute_write}});
        if (cache_) commands.uses({{rest_positions_, Access::compute_read}});
        solver_->record(
            commands, {.guides = guides.parameters,
                       .from = before.parameters,
                       .accelerations = commands.reads(guides.accelerations),
                       .air = air.velocities ? commands.reads(*air.velocities) : 0,
                       .frame = frameAfter(i + 1),
                       .frame_before = frameAfter(i),
                       .roots = roots_ ? commands.reads(roots_->address(i + 1)) : 0,
                       .roots_before = roots_ ? commands.reads(roots_->address(i)) : 0,
                       .first_strand = 0,
                       .drag = air.drag});
        if (segments) segments_->record(commands, guides, frameAfter(i + 1), frameAfter(i));
        before = guides;
    }
}

RigidMotion Simulation::poseAt(double time) const {
    const RigidMotion carried = motion_.at(time);
    return roots_ ? carried * roots_->meanAt(time) : carried;
}

std::vector<RigidMotion> Simulation::rootMotions() const {
    if (!roots_) return std::vector<RigidMotion>(strand_count_, pose());
    std::vector<RigidMotion> motions = roots_->at(time());
    for (RigidMotion& motion : motions) motion = carried() * motion;
    return motions;
}

GuideAddresses Simulation::addresses(std::uint32_t copy) const {
    return {
        .parameters = parameters_.address() + copy * sizeof(gpu::GuideParameters),
        .positions = positions_[copy].address(),
        .previous = previous_[copy].address(),
        .accelerations = accelerations_.address()};
}

PullPass Simulation::pullPassOf(const SimulationSettings& settings) const {
    return {*device_, strand_count_, vertices_per_strand_, step_, settings.pulls};
}

std::array<gpu::GuideParameters, 2> Simulation::parametersWith(const gpu::Bodies& bodies) const {
    const auto of = [&](std::size_t copy) {
        return gpu::GuideParameters{
            .positions = positions_[copy].address(),
            .previous = previous_[copy].address(),
            .rest_positions = rest_positions_.address(),
            .bodies = bodies,
            .gravity = settings_.gravity,
            .step = step_,
            .velocity_kept = static_cast<float>(velocityKept(settings_, step_)),
            .strand_count = strand_count_,
            .vertices_per_strand = vertices_per_strand_,
            .seed = seed_};
    };
    return {of(0), of(1)};
}

// w: inverse mass relative to a free vertex.
std::vector<glm::vec4> Simulation::withMasses(std::span<const glm::vec3> positions) const {
    assert(positions.size() == pinned_.size());
    std::vector<glm::vec4> result;
    result.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const bool held = i % vertices_per_strand_ == 0 || pinned_[i];
        result.emplace_back(positions[i], held ? 0.0f : 1.0f);
    }
    return result;
}

std::vector<const engine::Buffer*> Simulation::state() const {
    std::vector<const engine::Buffer*> buffers{&positions_[current_], &previous_[current_]};
    if (solver_) std::ranges::copy(solver_->state(), std::back_inserter(buffers));
    if (hair_hair_) buffers.push_back(&hair_hair_->state());
    return buffers;
}

// ---- Guides between two steps -------------------------------------------------------------------

static_assert(sizeof(gpu::InterpolatePush) == 32 && offsetof(gpu::InterpolatePush, share) == 24);

GuideInterpolation::GuideInterpolation(const engine::Device& device, std::uint32_t vertex_count)
    : vertex_count_(vertex_count), positions_(device, rows(vertex_count)["guide drawn positions"]),
      pipeline_(
          device,
          {.shader = "simulation/interpolate.comp", .push_size = sizeof(gpu::InterpolatePush)}) {}

void GuideInterpolation::record(
    engine::Commands& commands, std::uint64_t from, std::uint64_t to, double share) const {
    commands.bind(
        pipeline_, gpu::InterpolatePush{
                       .from = commands.reads(from),
                       .to = commands.reads(to),
                       .drawn = commands.writes(positions_),
                       .share = static_cast<float>(share),
                       .vertex_count = vertex_count_});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
