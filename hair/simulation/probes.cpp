#include "hair/simulation/probes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"

namespace hair::simulation {

// ---- Checks of a state --------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::VertexCondition) == 12);
static_assert(offsetof(gpu::ConditionPush, frame) == 16);

double segmentLength(const glm::vec3& a, const glm::vec3& b) {
    return glm::distance(glm::dvec3(a), glm::dvec3(b));
}

void add(Worst& worst, double value, double limit, std::uint32_t guide, bool& counted) {
    if (!(value <= worst.value) && !std::isnan(worst.value)) {
        worst.value = value;
        worst.guide = guide;
    }
    if (!(value <= limit) && !counted) {
        ++worst.guides;
        counted = true;
    }
}

}  // namespace

GuideCondition worstOf(
    std::span<const gpu::VertexCondition> vertices, std::uint32_t vertices_per_strand,
    double substep, const ConditionLimits& limits) {
    GuideCondition condition;
    for (std::size_t first = 0; first < vertices.size(); first += vertices_per_strand) {
        const auto guide = static_cast<std::uint32_t>(first / vertices_per_strand);
        bool stretched = false, inside = false, moving = false;
        for (const gpu::VertexCondition& vertex : vertices.subspan(first, vertices_per_strand)) {
            add(condition.stretch, double{vertex.stretch}, limits.stretch, guide, stretched);
            add(condition.depth, -double{vertex.gap}, limits.depth, guide, inside);
            add(condition.speed, double{vertex.moved} / substep, limits.speed, guide, moving);
        }
    }
    return condition;
}

std::optional<BrokenVertex> findBroken(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> rest,
    std::uint32_t vertices_per_strand, double most_stretch) {
    assert(positions.size() == rest.size());
    double length = 0.0, rest_length = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const bool is_root = i % vertices_per_strand == 0;
        length = is_root ? 0.0 : length + segmentLength(positions[i - 1], positions[i]);
        rest_length = is_root ? 0.0 : rest_length + segmentLength(rest[i - 1], rest[i]);
        const glm::dvec3 at(positions[i]);
        const bool is_finite = std::isfinite(at.x + at.y + at.z);
        if (is_finite && length <= most_stretch * rest_length) continue;
        return BrokenVertex{
            .guide = static_cast<std::uint32_t>(i / vertices_per_strand),
            .vertex = static_cast<std::uint32_t>(i % vertices_per_strand),
            .stretch = is_finite ? length / rest_length : std::numeric_limits<double>::quiet_NaN()};
    }
    return std::nullopt;
}

double mostStretch(const SimulationSettings&) { return 2.0; }

std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count) {
    const engine::Buffer conditions(
        device, {.size = count * sizeof(gpu::VertexCondition),
                 .name = "guide conditions",
                 .purpose = "simulation"});
    const engine::ComputePipeline pipeline(
        device, {.shader = "simulation/condition.comp", .push_size = sizeof(gpu::ConditionPush)});
    runOnce(device, [&](engine::Commands& commands) {
        commands.bind(
            pipeline,
            gpu::ConditionPush{
                .guides = guides, .conditions = commands.writes(conditions), .frame = frame});
        commands.dispatchInvocations(count, gpu::kGuideGroupSize);
    });
    return engine::downloadAs<gpu::VertexCondition>(device, conditions);
}

// ---- Probes over time ---------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::ProbePush) == 92 && offsetof(gpu::ProbePush, frame) == 48);
static_assert(sizeof(gpu::ProbeReducePush) == 28 && sizeof(gpu::ProbeResult) == 16);

constexpr float kDegrees = static_cast<float>(180.0 / std::numbers::pi);

// A value of a frame: a row of the guides and how it is combined.
struct Value {
    bool ProbeSettings::* asked;
    std::uint32_t quantity;
    const char* name;
    std::uint32_t row;
    std::uint32_t combined;
    double share = 0.0;  // of the guides up to the rank
    float factor = 1.0f;
};

using P = ProbeSettings;
constexpr Value kValues[] = {
    {&P::tip_displacement, gpu::kProbesTip, "tip_displacement.mean", gpu::kProbeTip,
     gpu::kProbeMean},
    {&P::tip_displacement, gpu::kProbesTip, "tip_displacement.median", gpu::kProbeTip,
     gpu::kProbeRank, 0.5},
    {&P::tip_displacement, gpu::kProbesTip, "tip_displacement.percentile_90", gpu::kProbeTip,
     gpu::kProbeRank, 0.9},
    {&P::tip_displacement, gpu::kProbesTip, "tip_displacement.maximum", gpu::kProbeTip,
     gpu::kProbeGreatest},
    {&P::groom_distance, gpu::kProbesGroom, "groom_distance.mean", gpu::kProbeDistance,
     gpu::kProbeMean},
    {&P::groom_distance, gpu::kProbesGroom, "groom_distance.maximum", gpu::kProbeMostDistance,
     gpu::kProbeGreatest},
    {&P::length_error, gpu::kProbesLength, "length_error.mean", gpu::kProbeStrain, gpu::kProbeMean},
    {&P::length_error, gpu::kProbesLength, "length_error.maximum", gpu::kProbeMostStrain,
     gpu::kProbeGreatest},
    {&P::energy, gpu::kProbesMotion, "kinetic_energy", gpu::kProbeKinetic, gpu::kProbeSum},
    {&P::energy, gpu::kProbesMotion, "gravitational_energy", gpu::kProbeGravitational,
     gpu::kProbeSum},
    {&P::energy, gpu::kProbesElastic, "elastic_energy", gpu::kProbeElastic, gpu::kProbeSum},
    {&P::contact, gpu::kProbesContact, "contacts", gpu::kProbeContacts, gpu::kProbeSum},
    {&P::contact, gpu::kProbesContact, "penetration", gpu::kProbeDepth, gpu::kProbeGreatest},
    {&P::speed, gpu::kProbesMotion, "speed", gpu::kProbeSpeed, gpu::kProbeGreatest},
    {&P::bending, gpu::kProbesBending, "bending.mean", gpu::kProbeBending, gpu::kProbeMean, 0.0,
     kDegrees},
    {&P::bending, gpu::kProbesBending, "bending.maximum", gpu::kProbeMostBending,
     gpu::kProbeGreatest, 0.0, kDegrees},
    {&P::torsion, gpu::kProbesTorsion, "torsion.mean", gpu::kProbeTorsion, gpu::kProbeMean, 0.0,
     kDegrees},
    {&P::torsion, gpu::kProbesTorsion, "torsion.maximum", gpu::kProbeMostTorsion,
     gpu::kProbeGreatest, 0.0, kDegrees},
    {&P::momentum, gpu::kProbesMotion, "momentum.x", gpu::kProbeMomentum, gpu::kProbeSum},
    {&P::momentum, gpu::kProbesMotion, "momentum.y", gpu::kProbeMomentum + 1, gpu::kProbeSum},
    {&P::momentum, gpu::kProbesMotion, "momentum.z", gpu::kProbeMomentum + 2, gpu::kProbeSum}};

// Only `rod` has an elastic energy that probes know.
std::vector<Value> valuesOf(const ProbeSettings& probes, Solver solver) {
    std::vector<Value> values;
    for (const Value& value : kValues)
        if (probes.*value.asked && (value.quantity != gpu::kProbesElastic || solver == Solver::rod))
            values.push_back(value);
    return values;
}

// Throws if there are no such guides.
std::uint32_t guidesOf(const ProbeSettings& probes, std::uint64_t guides) {
    const auto outside = [&](const char* field, std::uint32_t value) {
        return engine::Error(
            std::string("/run/probes/") + field,
            std::to_string(value) + " is beyond the " + std::to_string(guides) + " guides");
    };
    if (probes.first_guide >= guides) throw outside("first_guide", probes.first_guide);
    const std::uint64_t left = guides - probes.first_guide;
    if (probes.guides > left) throw outside("guides", probes.guides);
    return probes.guides > 0 ? probes.guides : static_cast<std::uint32_t>(left);
}

// The groom with the mass of each vertex: half of that of each segment that it ends.
std::vector<glm::vec4> withMass(const groom::Groom& groom, double line_density) {
    std::vector<glm::vec4> result;
    result.reserve(groom.points.size());
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        const std::span<const glm::vec3> points = groom.strand(s);
        const auto length = [&](std::size_t i) {
            return i == 0 || i == points.size()
                       ? 0.0
                       : glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1]));
        };
        for (std::size_t i = 0; i < points.size(); ++i)
            result.emplace_back(
                points[i], static_cast<float>(line_density * (length(i) + length(i + 1)) / 2.0));
    }
    return result;
}

double lineDensity(const MaterialSettings& material) {
    return wetDensity(material) * std::numbers::pi * double{material.radius} *
           double{material.radius};
}

std::vector<gpu::ProbeResult> resultsOf(std::span<const Value> values, std::uint32_t guides) {
    std::vector<gpu::ProbeResult> results;
    for (const Value& value : values) {
        const double rank = std::ceil(value.share * guides) - 1.0;
        results.push_back(
            {.row = value.row,
             .combined = value.combined,
             .rank = static_cast<std::uint32_t>(std::max(rank, 0.0)),
             .factor = value.factor});
    }
    return results;
}

}  // namespace

bool hasProbes(const ProbeSettings& settings) {
    return std::ranges::any_of(kValues, [&](const Value& value) { return settings.*value.asked; });
}

std::vector<std::string> Probes::names(const ProbeSettings& probes, Solver solver) {
    std::vector<std::string> names;
    for (const Value& value : valuesOf(probes, solver)) names.emplace_back(value.name);
    return names;
}

engine::MemoryRows Probes::rows(
    const groom::GroomSize& size, Solver solver, const ProbeSettings& probes,
    std::uint32_t most_frames) {
    const std::uint64_t values = valuesOf(probes, solver).size();
    engine::MemoryRows rows{
        "measuring",
        {{"probes' groom", engine::bytesOf<glm::vec4>(size.vertices())},
         {"probes of guides", engine::bytesOf<float>(gpu::kProbeRows * size.guides)},
         {"probes' results", engine::bytesOf<gpu::ProbeResult>(values)},
         {"probes of frames", engine::bytesOf<float>(values * most_frames)}}};
    if (!probes.reference.empty())
        rows.add("measuring", {{"probes' reference", engine::bytesOf<glm::vec4>(size.vertices())}});
    return rows;
}

Probes::Probes(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const ProbeSettings& probes, std::uint32_t most_frames, const groom::StrandSet* reference)
    : device_(&device), first_guide_(probes.first_guide),
      guide_count_(guidesOf(probes, groom.strand_count)),
      line_density_(static_cast<float>(lineDensity(settings.material))), most_frames_(most_frames),
      guides_(
          device, {.shader = "simulation/probe.comp",
                   .constants =
                       {{gpu::kEllipticSectionConstant, settings.material.ellipticity != 1.0f},
                        {gpu::kRodSetConstant, settings.material.set_share > 0.0f},
                        {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                   .push_size = sizeof(gpu::ProbePush)}),
      reduce_(
          device,
          {.shader = "simulation/probe_reduce.comp", .push_size = sizeof(gpu::ProbeReducePush)}) {
    assert(hasProbes(probes) && most_frames > 0);
    const std::vector<Value> values = valuesOf(probes, settings.solver);
    for (const Value& value : values) quantities_ |= value.quantity;
    results_per_frame_ = static_cast<std::uint32_t>(values.size());
    const engine::MemoryRows rows =
        Probes::rows(sizeOf(groom), settings.solver, probes, most_frames);
    rest_ = engine::makeBuffer(
        device, withMass(groom, lineDensity(settings.material)), rows, "probes' groom");
    if (reference) {
        assert(reference->points.size() == groom.points.size());
        std::vector<glm::vec4> points;
        for (const glm::vec3& point : reference->points) points.emplace_back(point, 0.0f);
        reference_ = engine::makeBuffer(device, points, rows, "probes' reference");
    }
    wanted_ = engine::makeBuffer(device, resultsOf(values, guide_count_), rows, "probes' results");
    rows_ = {device, rows["probes of guides"]};
    results_ = {device, rows["probes of frames"]};
}

void Probes::record(engine::Commands& commands, const ProbedGuides& guides) {
    assert(frames_ < most_frames_);
    if (guide_count_ == 0) return;
    commands.uses(
        {{guides.positions, engine::Access::compute_read},
         {guides.previous, engine::Access::compute_read}});
    if (guides.rods.parameters) commands.uses({{guides.rods.motion, engine::Access::compute_read}});
    if (guides.rods.set) commands.uses({{guides.rods.set, engine::Access::compute_read}});
    commands.bind(
        guides_, gpu::ProbePush{
                     .guides = guides.parameters,
                     .rest = rest_.address(),
                     .reference = (reference_.size() > 0 ? reference_ : rest_).address(),
                     .rows = commands.writes(rows_),
                     .roots = guides.roots ? commands.reads(guides.roots) : 0,
                     .rods = guides.rods.parameters,
                     .frame = guides.frame,
                     .first_guide = first_guide_,
                     .guide_count = guide_count_,
                     .quantities = quantities_,
                     .line_density = line_density_});
    commands.dispatchInvocations(guide_count_, gpu::kGuideGroupSize);
    commands.bind(
        reduce_, gpu::ProbeReducePush{
                     .rows = commands.reads(rows_),
                     .wanted = wanted_.address(),
                     .results = commands.writes(results_) +
                                std::uint64_t{frames_++} * results_per_frame_ * sizeof(float),
                     .guide_count = guide_count_});
    commands.dispatch(results_per_frame_);
}

std::vector<std::vector<double>> Probes::read() const {
    const auto results = engine::downloadAs<float>(*device_, results_);
    std::vector<std::vector<double>> values(results_per_frame_);
    for (std::uint32_t frame = 0; frame < frames_; ++frame)
        for (std::uint32_t i = 0; i < results_per_frame_; ++i)
            values[i].push_back(double{results[std::size_t{frame} * results_per_frame_ + i]});
    return values;
}

}  // namespace hair::simulation
