#include "hair/rendering/strand_offsets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/error.h"
#include "hair/gpu_structs.h"
#include "hair/groom/style/displace.h"
#include "hair/groom/style/style.h"
#include "hair/random.h"

namespace hair::rendering {

// ---- Offsets ------------------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::FramesPush) == 96 && offsetof(gpu::FramesPush, guides) == 64);
static_assert(sizeof(gpu::TurnsPush) == 48 && offsetof(gpu::TurnsPush, guides) == 16);

// ---- Offsets of a model -------------------------------------------------------------------------

// A cubic needs 3 points beside the root; more points make it a fit by arc length. A table of 1,024
// profiles has room for kMostPoints.
constexpr std::uint32_t kLeastPoints = 16;
constexpr std::uint32_t kMostPoints = 4096;

// p(s) = root + c0 s + c1 s^2 + c2 s^3, s the fraction of arc length.
struct Cubic {
    glm::dvec3 root;
    glm::dmat3 coefficients;  // columns c0 to c2

    glm::dvec3 at(double s) const { return root + coefficients * glm::dvec3(s, s * s, s * s * s); }
};

// Least squares over arc length, by the trapezoidal rule.
Cubic fit(std::span<const glm::vec3> strand, const groom::AlongStrand& along) {
    const glm::dvec3 root(strand.front());
    glm::dmat3 normal_matrix(1e-12);  // so that coinciding points don't make it singular
    glm::dmat3 moments(0.0);
    for (std::size_t i = 0; i < strand.size(); ++i) {
        const double weight = along.fraction(std::min(i + 1, strand.size() - 1)) -
                              along.fraction(std::max<std::size_t>(i, 1) - 1);
        const double s = along.fraction(i);
        const glm::dvec3 powers(s, s * s, s * s * s);
        normal_matrix += weight * glm::outerProduct(powers, powers);
        moments += weight * glm::outerProduct(glm::dvec3(strand[i]) - root, powers);
    }
    return {root, moments * glm::inverse(normal_matrix)};
}

// Picks the strands of a model that offsets are taken from: those with a length, at most `most`,
// spread over the file. Throws engine::Error if no strand has a length.
groom::StrandSet offsetModel(const groom::StrandSet& strands, std::uint32_t most) {
    std::vector<std::uint32_t> usable;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (groom::AlongStrand(strands.strand(i)).length() > 0.0) usable.push_back(i);
    if (usable.empty()) throw engine::Error("no strand has a length");
    const std::size_t count = std::min<std::size_t>(usable.size(), most);
    std::vector<std::uint32_t> spread(count);
    for (std::size_t i = 0; i < count; ++i) spread[i] = usable[i * usable.size() / count];
    groom::StrandSet picked = groom::pickStrands(strands, spread);
    const std::uint32_t points = std::clamp(groom::greatestSize(picked), kLeastPoints, kMostPoints);
    return groom::resample(std::move(picked), points);
}

// Adds the offsets of a model's strand from its smooth shape to `samples`, which are evenly spaced
// from root to tip. The offsets are scaled from the length of the smooth shape to `length` and
// turned about it by `turn` (1: a full turn). The smooth shape is the cubic through the root that
// fits the strand best by arc length. The offsets are in its rotation-minimising frame.
void addModelOffsets(
    std::span<const glm::vec3> strand, double length, double turn, std::span<glm::vec3> samples) {
    const groom::AlongStrand along(strand);
    const Cubic cubic = fit(strand, along);
    std::vector<glm::vec3> smooth(strand.size());
    for (std::size_t i = 0; i < strand.size(); ++i)
        smooth[i] = glm::vec3(cubic.at(along.fraction(i)));
    const std::vector<groom::StrandFrame> frames = groom::strandFrames(smooth, nullptr);
    // A strand that ends where it began may have a smooth shape of almost no length.
    const double scale =
        length / std::max(groom::AlongStrand(smooth).length(), 0.01 * along.length());

    const double angle = 2.0 * std::numbers::pi * turn;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    std::vector<glm::dvec3> offsets(strand.size());
    for (std::size_t i = 0; i < strand.size(); ++i) {
        const glm::dvec3 offset = glm::dvec3(strand[i]) - cubic.at(along.fraction(i));
        const groom::StrandFrame& frame = frames[i];
        const double x = glm::dot(offset, frame.normal);
        const double y = glm::dot(offset, frame.binormal);
        offsets[i] = scale * glm::dvec3(
                                 cosine * x - sine * y, sine * x + cosine * y,
                                 glm::dot(offset, frame.tangent));
    }
    std::size_t before = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double s = static_cast<double>(i) / static_cast<double>(samples.size() - 1);
        while (before + 2 < strand.size() && along.fraction(before + 1) <= s) ++before;
        const double from = along.fraction(before);
        const double span = along.fraction(before + 1) - from;
        const double part = span > 0.0 ? std::min((s - from) / span, 1.0) : 1.0;
        samples[i] += glm::vec3(glm::mix(offsets[before], offsets[before + 1], part));
    }
}

// ---- Curls and variation ------------------------------------------------------------------------

// Procedural offsets. All functions add to `samples`, evenly spaced from the root to the tip of a
// strand of `length` m, and leave the first alone. `profile` is the key of the random numbers.

// Adds `offset(along)`, along in (0, 1]. The offset fades in over the fraction `start` of the
// strand.
template <class Offset>
void add(double start, std::span<glm::vec3> samples, Offset&& offset) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double along = static_cast<double>(i) / static_cast<double>(samples.size() - 1);
        samples[i] += glm::vec3(groom::ease(0.0, start, along) * offset(along));
    }
}

// Adds a helix of random phase and frequency.
void addCurl(
    const StrandCurlSettings& settings, double length, std::uint32_t seed, std::uint32_t profile,
    std::span<glm::vec3> samples) {
    const double phase = random01(seed, profile, purpose::offset_phase);
    const double change = settings.frequency_variation *
                          (2.0 * random01(seed, profile, purpose::offset_frequency) - 1.0);
    const double turns = settings.frequency * (1.0 + change) * length;
    add(settings.start, samples, [&](double along) {
        const double angle = 2.0 * std::numbers::pi * (turns * along + phase);
        return double{settings.radius} * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
    });
}

// Adds smooth noise: a random vector of at most the amplitude at every change of direction.
void addVariation(
    const StrandVariationSettings& settings, double length, std::uint32_t seed,
    std::uint32_t profile, std::span<glm::vec3> samples) {
    const std::uint32_t own = hash(seed, profile, purpose::offset_noise_x);
    add(settings.start, samples, [&](double along) {
        return double{settings.amplitude} *
               groom::smoothNoise(
                   own, purpose::offset_noise_x, settings.frequency * length * along);
    });
}

// ---- The table of offsets -----------------------------------------------------------------------

constexpr double kSamplesPerTurn = 16.0;
constexpr double kSamplesPerChange = 8.0;
constexpr std::uint32_t kMostValues = std::uint32_t{1} << 22;

bool curls(const StrandSettings& settings) { return settings.curl.radius > 0.0f; }

bool varies(const StrandSettings& settings) {
    return settings.variation.amplitude > 0.0f && settings.variation.share > 0.0f;
}

double meanLength(const groom::Groom& groom) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i)
        sum += groom::AlongStrand(groom.strand(i)).length();
    return sum / groom.strand_count;
}

// Returns the intervals that `count` turns or changes of a strand need. Throws engine::Error for
// more than the table can have.
std::uint32_t intervalsFor(
    double count, double intervals_each, const std::string& pointer, const std::string& things) {
    const double most = StrandOffsets::kMostSamples / intervals_each;
    if (count > most)
        throw engine::Error(
            pointer, "makes " + std::to_string(std::llround(count)) + ' ' + things +
                         " on a strand; offsets can have at most " +
                         std::to_string(std::llround(most)));
    return static_cast<std::uint32_t>(std::ceil(count * intervals_each));
}

// Enough to resolve the slow start of offsets.
constexpr std::uint32_t kLeastIntervals = 32;

std::uint32_t samplesFor(
    const StrandSettings& settings, double length, const std::optional<groom::StrandSet>& model) {
    std::uint32_t intervals = model ? model->size(0) - 1 : 1;
    if (curls(settings)) {
        const StrandCurlSettings& curl = settings.curl;
        const double turns = curl.frequency * (1.0 + curl.frequency_variation) * length;
        intervals = std::max(
            intervals, intervalsFor(turns, kSamplesPerTurn, "/strands/curl/frequency", "turns"));
    }
    if (varies(settings)) {
        intervals = std::max(
            intervals, intervalsFor(
                           settings.variation.frequency * length, kSamplesPerChange,
                           "/strands/variation/frequency", "changes of direction"));
    }
    return std::clamp(intervals + 1, kLeastIntervals + 1, StrandOffsets::kMostSamples);
}

// The point that follows three evenly spaced points of a parabola.
glm::vec3 extrapolated(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return 3.0f * (c - b) + a;
}

}  // namespace

bool FramesPass::isNeeded(const StrandView& view) {
    return view.root_frames != 0 || view.rest_tangents != 0;
}

engine::MemoryRows FramesPass::rows(std::uint64_t vertices, bool has_normals, bool has_turns) {
    engine::MemoryRows rows;
    if (has_normals) rows.add("groom", {{"guide normals", engine::bytesOf<glm::vec3>(vertices)}});
    if (has_turns) rows.add("groom", {{"guide turns", engine::bytesOf<glm::vec4>(vertices)}});
    return rows;
}

FramesPass::FramesPass(const engine::Device& device, const StrandView& view) {
    const engine::MemoryRows rows = FramesPass::rows(
        std::uint64_t{view.guide_count} * view.vertices_per_guide, view.root_frames != 0,
        view.rest_tangents != 0);
    if (view.root_frames != 0) {
        frame_.emplace(
            device, engine::ComputeDescription{
                        .shader = "strands/frames.comp", .push_size = sizeof(gpu::FramesPush)});
        normals_ = {device, rows["guide normals"]};
    }
    if (view.rest_tangents != 0) {
        turn_.emplace(
            device, engine::ComputeDescription{
                        .shader = "strands/turns.comp", .push_size = sizeof(gpu::TurnsPush)});
        turns_ = {device, rows["guide turns"]};
    }
}

void FramesPass::record(engine::Commands& commands, const StrandView& view) const {
    if (frame_) {
        commands.bind(
            *frame_, gpu::FramesPush{
                         .head = view.head,
                         .guides = commands.reads(view.guides),
                         .root_frames = view.root_frames,
                         .normals = commands.writes(normals_),
                         .guide_count = view.guide_count,
                         .vertices_per_guide = view.vertices_per_guide});
        commands.dispatchInvocations(view.guide_count, gpu::kFramesGroupSize);
    }
    if (turn_) {
        const glm::quat head = glm::normalize(glm::quat_cast(glm::dmat3(glm::mat3(view.head))));
        commands.bind(
            *turn_, gpu::TurnsPush{
                        .head_turn = {head.x, head.y, head.z, head.w},
                        .guides = commands.reads(view.guides),
                        .rest_tangents = view.rest_tangents,
                        .turns = commands.writes(turns_),
                        .guide_count = view.guide_count,
                        .vertices_per_guide = view.vertices_per_guide});
        commands.dispatchInvocations(view.guide_count, gpu::kFramesGroupSize);
    }
}

bool hasOffsets(const StrandSettings& settings) {
    return curls(settings) || varies(settings) || !settings.offsets.empty();
}

bool hasFrames(const StrandSettings& settings) {
    return hasOffsets(settings) || !settings.offset_function.empty();
}

float functionReach(const StrandSettings& settings) {
    return extensionNumber(settings.offset_parameters, "reach");
}

std::uint64_t offsetBytes(const StrandSettings& settings, double length) {
    constexpr double kModelIntervals = 63.0;
    double intervals = settings.offsets.empty() ? 1.0 : kModelIntervals;
    if (curls(settings)) {
        const double turns =
            settings.curl.frequency * (1.0 + settings.curl.frequency_variation) * length;
        intervals = std::max(intervals, turns * kSamplesPerTurn);
    }
    if (varies(settings))
        intervals = std::max(intervals, settings.variation.frequency * length * kSamplesPerChange);
    const auto samples = static_cast<std::uint32_t>(std::clamp(
        std::ceil(intervals) + 1.0, kLeastIntervals + 1.0, double{StrandOffsets::kMostSamples}));
    const std::uint32_t profiles =
        settings.offsets.empty() ? StrandOffsets::kProfiles : StrandOffsets::kMostProfiles;
    return std::uint64_t{std::min(profiles, kMostValues / samples)} * (samples + 2) *
           sizeof(glm::vec3);
}

StrandOffsets makeStrandOffsets(
    const StrandSettings& settings, const groom::Groom& groom, const groom::StrandSet* model,
    std::uint32_t seed) {
    std::optional<groom::StrandSet> strands;
    if (model) strands = offsetModel(*model, StrandOffsets::kMostProfiles);
    const double length = meanLength(groom);
    StrandOffsets offsets{.samples = samplesFor(settings, length, strands)};
    const std::uint32_t modelled = strands ? strands->strandCount() : 0;
    offsets.profiles =
        std::min(std::max(modelled, StrandOffsets::kProfiles), kMostValues / offsets.samples);
    const std::uint32_t varied = static_cast<std::uint32_t>(
        std::lround(static_cast<double>(settings.variation.share) * offsets.profiles));
    std::vector<glm::vec3> samples(offsets.samples);
    offsets.values.reserve(std::size_t{offsets.profiles} * (offsets.samples + 2));
    for (std::uint32_t profile = 0; profile < offsets.profiles; ++profile) {
        std::ranges::fill(samples, glm::vec3(0.0f));
        if (curls(settings)) addCurl(settings.curl, length, seed, profile, samples);
        if (varies(settings) && profile < varied)
            addVariation(settings.variation, length, seed, profile, samples);
        if (strands) {
            const std::uint64_t strand = std::uint64_t{profile} * modelled / offsets.profiles;
            const double turn = random01(seed, profile, purpose::offset_phase);
            addModelOffsets(
                strands->strand(static_cast<std::uint32_t>(strand)), length, turn, samples);
        }
        offsets.values.push_back(extrapolated(samples[2], samples[1], samples[0]));
        offsets.values.insert(offsets.values.end(), samples.begin(), samples.end());
        offsets.values.push_back(
            extrapolated(samples.end()[-3], samples.end()[-2], samples.end()[-1]));
    }
    return offsets;
}

// ---- Residuals of a file ------------------------------------------------------------------------

namespace {

constexpr std::uint32_t kMostSteps = 32767;  // in a coordinate of a sample
const auto kMostPlace = static_cast<std::uint32_t>(gpu::kResidualPlaces);

// ---- Curves of strands at rest ------------------------------------------------------------------

using CurveWeights = std::array<double, 4>;

// Thesis equation (4), and Catmull and Rom 1974; t in [0, 1].
CurveWeights curveWeights(Curve curve, double t) {
    const double s = 1.0 - t;
    if (curve == Curve::catmull_rom)
        return {
            -0.5 * t * s * s, 0.5 * ((3.0 * t - 5.0) * t * t + 2.0),
            0.5 * ((3.0 * s - 5.0) * s * s + 2.0), -0.5 * s * t * t};
    return {
        s * s * s / 6.0, ((3.0 * t - 6.0) * t * t + 4.0) / 6.0,
        ((3.0 * s - 6.0) * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

// The curve that strands of a groom have at rest, without residuals:
// shaders/strands/interpolation.glsl.
class RestCurve {
public:
    RestCurve(const groom::Groom& groom, const StrandSettings& settings)
        : groom_(groom), curve_(settings.curve), single_(singleShare(settings)),
          controls_(groom.vertices_per_strand + std::size_t{2}) {}

    void take(const groom::StrandBinding& binding) {
        const std::size_t vertices = groom_.vertices_per_strand;
        if (binding.followsHead()) {
            std::ranges::fill(controls_, glm::dvec3(binding.offset));
            return;
        }
        const int heaviest = heaviestOf(binding.weights);
        const auto weightOf = [&](int i) {
            return (1.0 - single_) * binding.weights[i] + (i == heaviest ? single_ : 0.0);
        };
        glm::dvec3 mean_root(0.0);
        for (int i = 0; i < 3; ++i)
            mean_root += double{binding.weights[i]} * glm::dvec3(guide(binding, i)[0]);
        const glm::dvec3 lift = glm::dvec3(binding.offset) +
                                single_ * (mean_root - glm::dvec3(guide(binding, heaviest)[0]));
        for (std::size_t k = 0; k < vertices; ++k) {
            controls_[k + 1] = lift;
            for (int i = 0; i < 3; ++i)
                controls_[k + 1] += weightOf(i) * glm::dvec3(guide(binding, i)[k]);
        }
        const bool reflects = curve_ != Curve::bspline_unpinned;
        controls_[0] = reflects ? 2.0 * controls_[1] - controls_[2] : controls_[1];
        controls_[vertices + 1] =
            reflects ? 2.0 * controls_[vertices] - controls_[vertices - 1] : controls_[vertices];
    }

    // `along` in [0, 1].
    glm::dvec3 at(double along) const {
        const std::size_t segments = groom_.vertices_per_strand - 1;
        const double place = along * static_cast<double>(segments);
        const std::size_t segment = std::min(static_cast<std::size_t>(place), segments - 1);
        const CurveWeights weights = curveWeights(curve_, place - static_cast<double>(segment));
        glm::dvec3 point(0.0);
        for (std::size_t k = 0; k < 4; ++k) point += weights[k] * controls_[segment + k];
        return point;
    }

private:
    static double singleShare(const StrandSettings& settings) {
        switch (settings.interpolation) {
        case Interpolation::multi:
            return 0.0;
        case Interpolation::single:
            return 1.0;
        case Interpolation::mixed:
            return 1.0 - double{settings.blend};
        }
        return 0.0;
    }

    static int heaviestOf(const glm::vec3& weights) {
        if (weights.x >= weights.y && weights.x >= weights.z) return 0;
        return weights.y >= weights.z ? 1 : 2;
    }

    std::span<const glm::vec3> guide(const groom::StrandBinding& binding, int i) const {
        return groom_.strand(binding.guides[static_cast<std::size_t>(i)]);
    }

    const groom::Groom& groom_;
    Curve curve_;
    double single_;  // share of the heaviest guide alone
    std::vector<glm::dvec3> controls_;  // [1 + vertex + 1], m
};

// ---- Samples ------------------------------------------------------------------------------------

// A point of the file, with its place along the strand.
struct PlacedPoint {
    std::uint32_t place;
    glm::dvec3 position;  // m
};

std::uint32_t placeAt(double along) {
    return static_cast<std::uint32_t>(std::lround(along * kMostPlace));
}

// A strand's points at ascending places, from 0 to kMostPlace. Leaves out points with places that
// are taken, never the first or the last, and records their distances from the points that are
// kept.
class PlacedPoints {
public:
    void take(std::span<const glm::vec3> points, std::size_t vertices) {
        placed_.clear();
        left_out_ = {};
        farthest_left_out_ = 0.0;
        const glm::dvec3 tip(points.back());
        const std::size_t last = points.size() - 1;
        placed_.push_back({0, glm::dvec3(points.front())});
        if (last > 1) {
            const groom::AlongStrand along(points);
            const bool by_number = points.size() == vertices || along.length() == 0.0;
            for (std::size_t i = 1; i < last; ++i) {
                const double fraction = by_number
                                            ? static_cast<double>(i) / static_cast<double>(last)
                                            : along.fraction(i);
                const std::uint32_t place = placeAt(fraction);
                const glm::dvec3 position(points[i]);
                if (place > placed_.back().place && place < kMostPlace)
                    placed_.push_back({place, position});
                else
                    leaveOut(position, place < kMostPlace ? placed_.back().position : tip);
            }
        }
        placed_.push_back({kMostPlace, tip});
    }

    const std::vector<PlacedPoint>& points() const { return placed_; }
    double leftOut() const { return left_out_; }  // sum of the distances
    double farthestLeftOut() const { return farthest_left_out_; }

private:
    void leaveOut(const glm::dvec3& point, const glm::dvec3& kept) {
        const double distance = glm::distance(point, kept);
        left_out_ += distance;
        farthest_left_out_ = std::max(farthest_left_out_, distance);
    }

    std::vector<PlacedPoint> placed_;
    double left_out_ = 0.0;
    double farthest_left_out_ = 0.0;
};

// Whether every place can be found without a search: by the sample at its place among evenly spaced
// ones, shifted by kResidualGuess = 1/4 of an interval, or by a neighbour of that sample.
bool isEven(std::span<const PlacedPoint> points) {
    const auto intervals = static_cast<double>(points.size() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double ahead = points[i].place * intervals / kMostPlace - static_cast<double>(i);
        if (ahead < -0.2 || ahead > 0.7) return false;
    }
    return true;
}

glm::uvec2 packed(const glm::ivec3& steps, std::uint32_t place) {
    const glm::uvec3 low = glm::uvec3(steps) & 0xffffu;
    return {low.x | low.y << 16u, low.z | place << 16u};
}

// Bounds the length of the curve's vectors. The curve stays within the hull of its control points
// in Bernstein form: the samples, and the points a third of an interval along the slope at both of
// its ends.
double reachOf(std::span<const glm::dvec3> samples, std::span<const PlacedPoint> points) {
    const auto slope = [&](std::size_t i) {
        return (samples[i + 1] - samples[i]) /
               static_cast<double>(points[i + 1].place - points[i].place);
    };
    const auto size = [&](std::size_t i) {
        return static_cast<double>(points[i + 1].place - points[i].place);
    };
    const std::size_t intervals = samples.size() - 1;
    // The slope of the parabola through a sample and its neighbours. The ends use the parabola of
    // the next sample.
    const auto steepness = [&](std::size_t i) {
        if (intervals == 1) return slope(0);
        if (i == 0) return slope(0) + size(0) / (size(0) + size(1)) * (slope(0) - slope(1));
        if (i == intervals)
            return slope(i - 1) +
                   size(i - 1) / (size(i - 1) + size(i - 2)) * (slope(i - 1) - slope(i - 2));
        return (size(i) * slope(i - 1) + size(i - 1) * slope(i)) / (size(i - 1) + size(i));
    };
    double reach = 0.0;
    for (std::size_t i = 0; i <= intervals; ++i) {
        const glm::dvec3 along = steepness(i) / 3.0;
        reach = std::max(reach, glm::length(samples[i]));
        if (i < intervals) reach = std::max(reach, glm::length(samples[i] + size(i) * along));
        if (i > 0) reach = std::max(reach, glm::length(samples[i] - size(i - 1) * along));
    }
    return reach;
}

}  // namespace

// ---- Residuals ----------------------------------------------------------------------------------

StrandResiduals makeStrandResiduals(
    const groom::Groom& groom, const StrandSettings& settings,
    std::span<const std::uint32_t> order) {
    assert(groom.bound_ends.size() == groom.bindings.size());
    StrandResiduals residuals;
    residuals.strands.reserve(order.size());
    residuals.samples.reserve(groom.bound_points.size() + 1);
    residuals.samples.emplace_back(0, 0);
    RestCurve curve(groom, settings);
    PlacedPoints placed;
    std::vector<glm::dvec3> vectors;
    double points = 0.0;
    const auto count = [](Lengths& lengths, double length) {
        lengths.mean += length;  // the sum so far
        lengths.greatest = std::max(lengths.greatest, length);
    };
    for (const std::uint32_t strand : order) {
        curve.take(groom.bindings[strand]);
        placed.take(groom.boundStrand(strand), groom.vertices_per_strand);
        vectors.clear();
        double greatest = 0.0;
        for (const PlacedPoint& point : placed.points()) {
            vectors.push_back(
                point.position - curve.at(static_cast<double>(point.place) / kMostPlace));
            count(residuals.kept, glm::length(vectors.back()));
            for (int axis = 0; axis < 3; ++axis)
                greatest = std::max(greatest, std::abs(vectors.back()[axis]));
        }
        StrandResidual residual{
            .first = static_cast<std::uint32_t>(residuals.samples.size()),
            .count = static_cast<std::uint32_t>(vectors.size()),
            .step = static_cast<float>(greatest / kMostSteps)};
        // Residuals below the smallest step count as none.
        const double step = residual.step > 0.0f ? double{residual.step} : 1.0;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            const glm::dvec3 steps =
                glm::clamp(glm::round(vectors[i] / step), -double{kMostSteps}, double{kMostSteps});
            residuals.samples.push_back(packed(glm::ivec3(steps), placed.points()[i].place));
            const glm::dvec3 drawn = double{residual.step} * steps;
            count(residuals.left, glm::distance(vectors[i], drawn));
            vectors[i] = drawn;
        }
        residual.reach = static_cast<float>(reachOf(vectors, placed.points()) * (1.0 + 1e-6));
        residuals.strands.push_back(residual);
        if (!isEven(placed.points())) {
            const auto halvings = static_cast<std::uint32_t>(std::bit_width(vectors.size()));
            residuals.samples.front().x = std::max(residuals.samples.front().x, halvings);
        }
        residuals.left.mean += placed.leftOut();
        residuals.left.greatest = std::max(residuals.left.greatest, placed.farthestLeftOut());
        points += static_cast<double>(vectors.size());
    }
    if (points > 0.0) {
        residuals.kept.mean /= points;
        residuals.left.mean /= points;
    }
    return residuals;
}

std::vector<glm::vec3> restTangents(const groom::Groom& groom) {
    std::vector<glm::vec3> tangents;
    tangents.reserve(groom.points.size());
    const std::size_t last = groom.vertices_per_strand - 1;
    for (std::uint32_t guide = 0; guide < groom.strand_count; ++guide) {
        const auto points = groom.strand(guide);
        for (std::size_t k = 0; k <= last; ++k) {
            const glm::dvec3 chord =
                glm::dvec3(points[std::min(k + 1, last)]) - glm::dvec3(points[k == 0 ? 0 : k - 1]);
            const double length = glm::length(chord);
            tangents.emplace_back(length > 0.0 ? chord / length : glm::dvec3(0.0));
        }
    }
    return tangents;
}

}  // namespace hair::rendering
