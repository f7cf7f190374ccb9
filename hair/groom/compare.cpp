#include "hair/groom/compare.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <future>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/mesh/depth.h"
#include "hair/groom/mesh/surface.h"

namespace hair::groom {
namespace {

// ---- Work shared by threads ---------------------------------------------------------------------

constexpr std::uint32_t kStrandsAtOnce = 64;

// Calls `work(strand)` once for every strand, as a step of this name. `make_work` makes a `work`
// for each thread, so that each has memory of its own. It may only write the strand's own data.
template <class MakeWork>
void forEachStrand(
    const char* name, std::uint32_t strands, std::uint32_t threads, MakeWork&& make_work) {
    engine::Step step(name, strands);
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    std::atomic<std::uint32_t> next = 0;
    const auto run = [&] {
        auto work = make_work();
        for (;;) {
            const std::uint32_t first = next.fetch_add(kStrandsAtOnce);
            if (first >= strands) return;
            const std::uint32_t end = std::min(strands, first + kStrandsAtOnce);
            for (std::uint32_t strand = first; strand < end; ++strand) work(strand);
            step.advance(end - first);
        }
    };
    const std::uint32_t useful = (strands + kStrandsAtOnce - 1) / kStrandsAtOnce;
    std::vector<std::future<void>> others;
    for (std::uint32_t i = 1; i < std::min(threads, useful); ++i)
        others.push_back(std::async(std::launch::async, run));
    run();
    for (std::future<void>& other : others) other.get();
}

// ---- Samples ------------------------------------------------------------------------------------

// A place on a strand and the unit vector along it there, towards the tip.
struct StrandSample {
    glm::dvec3 point;
    glm::dvec3 tangent;
};

// Finds places on a strand that has a length, at ascending arc lengths.
class StrandWalk {
public:
    explicit StrandWalk(std::span<const glm::vec3> points) : points_(points) {
        double start = 0.0;
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const double length = glm::distance(glm::dvec3(points[k]), glm::dvec3(points[k + 1]));
            if (length > 0.0) stretches_.push_back({k, start, length});
            start += length;
        }
    }

    StrandSample at(double arc) {
        while (now_ + 1 < stretches_.size() && arc >= stretches_[now_ + 1].start) ++now_;
        const auto& [segment, start, length] = stretches_[now_];
        const glm::dvec3 from(points_[segment]);
        const glm::dvec3 along = glm::dvec3(points_[segment + 1]) - from;
        const double share = std::clamp((arc - start) / length, 0.0, 1.0);
        return {from + share * along, along / length};
    }

private:
    struct Stretch {
        std::size_t segment;
        double start, length;  // of arc, m
    };
    std::span<const glm::vec3> points_;
    std::vector<Stretch> stretches_;  // the segments that have a length
    std::size_t now_ = 0;
};

// The strands of a groom that have a length.
struct MeasuredStrands {
    const StrandSet& set;
    std::vector<std::uint32_t> strands;  // indices, in an order of neighbours in space
    std::vector<double> lengths;  // m
    std::vector<std::size_t> first_samples;  // [strand + 1]

    std::uint32_t count() const { return static_cast<std::uint32_t>(strands.size()); }
    std::span<const glm::vec3> points(std::uint32_t i) const { return set.strand(strands[i]); }
    std::size_t samples(std::uint32_t i) const { return first_samples[i + 1] - first_samples[i]; }
};

// A length of a whole number of spacings may be a little more in floats.
constexpr double kSpacingSlack = 1e-6;

// Throws engine::Error with the name of the groom for strands that can't be compared.
MeasuredStrands measureStrands(const StrandSet& set, double spacing, const char* name) {
    std::vector<double> lengths(set.strandCount());
    std::vector<std::uint32_t> with_length;
    std::vector<glm::vec3> middles;
    std::vector<std::array<std::uint32_t, 3>> places;  // triangles of one corner
    for (std::uint32_t i = 0; i < set.strandCount(); ++i) {
        lengths[i] = arcLength(set.strand(i));
        if (!std::isfinite(lengths[i]) || !std::isfinite(glm::length(glm::dvec3(set.strand(i)[0]))))
            throw engine::Error(
                name, "strand " + std::to_string(i) + " has coordinates that are not finite");
        if (lengths[i] / spacing > 1e9)
            throw engine::Error(
                name, "strand " + std::to_string(i) +
                          " would have more than a billion samples: is it in metres?");
        if (lengths[i] == 0.0) continue;
        const auto place = static_cast<std::uint32_t>(with_length.size());
        places.push_back({place, place, place});
        with_length.push_back(i);
        middles.push_back(set.strand(i)[set.size(i) / 2]);
    }
    if (with_length.empty()) throw engine::Error(name, "has no strand with a length to compare");

    // Neighbours in space follow each other, because they look at the same part of the other groom.
    MeasuredStrands measured{.set = set};
    measured.first_samples.push_back(0);
    for (const std::uint32_t place : buildTriangleBvh(middles, places, 1).order) {
        const double length = lengths[with_length[place]];
        measured.strands.push_back(with_length[place]);
        measured.lengths.push_back(length);
        measured.first_samples.push_back(
            measured.first_samples.back() +
            static_cast<std::size_t>(
                std::max(1.0, std::ceil(length / spacing * (1.0 - kSpacingSlack)))));
    }
    return measured;
}

// Visits the samples of a strand: the middles of equal pieces, so that each stands for the same
// length.
template <class Visit>
void forEachSample(const MeasuredStrands& strands, std::uint32_t strand, Visit&& visit) {
    StrandWalk walk(strands.points(strand));
    const std::size_t count = strands.samples(strand);
    const double piece = strands.lengths[strand] / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k)
        visit(k, walk.at((static_cast<double>(k) + 0.5) * piece));
}

// ---- The nearest of many segments ---------------------------------------------------------------

// A bounding volume hierarchy of the segments of strands. A segment longer than `longest_box` has
// several boxes along it, so that boxes are small compared with the distances of a search. Each of
// its boxes finds the whole segment. Boxes are off by the rounding of floats, 1e-8 m for a head.
class SegmentBvh {
public:
    struct Segment {
        glm::vec3 from;
        glm::vec3 to;
        std::uint32_t strand;  // among the measured ones
    };

    SegmentBvh(const MeasuredStrands& strands, double longest_box) {
        std::vector<glm::vec3> ends;
        std::vector<std::array<std::uint32_t, 3>> boxes;  // triangles of two corners
        std::vector<Segment> owners;
        for (std::uint32_t i = 0; i < strands.count(); ++i) {
            const std::span<const glm::vec3> points = strands.points(i);
            for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                if (points[k] == points[k + 1]) continue;
                const double length =
                    glm::distance(glm::dvec3(points[k]), glm::dvec3(points[k + 1]));
                const double pieces = std::clamp(std::ceil(length / longest_box), 1.0, 1024.0);
                ends.push_back(points[k]);
                for (double piece = 1.0; piece <= pieces; ++piece) {
                    ends.push_back(
                        glm::mix(points[k], points[k + 1], static_cast<float>(piece / pieces)));
                    const auto last = static_cast<std::uint32_t>(ends.size() - 1);
                    boxes.push_back({last - 1, last, last});
                    owners.push_back({points[k], points[k + 1], i});
                }
            }
        }
        if (boxes.size() > std::numeric_limits<std::uint32_t>::max() / 2)
            throw engine::Error("grooms", "they have too many segments to compare");
        constexpr std::size_t kMostSegmentsInLeaf = 8;
        tree_ = buildTriangleBvh(ends, boxes, kMostSegmentsInLeaf);
        segments_.reserve(boxes.size());
        for (const std::uint32_t i : tree_.order) segments_.push_back(owners[i]);
    }

    // Calls visit(segment, squared distance) for the segments within sqrt(square), until it returns
    // false. It also visits some segments farther away, and some more than once.
    template <class Visit>
    void forEachNear(const glm::dvec3& point, double square, Visit&& visit) const {
        std::array<std::uint32_t, kBvhStackSize> stack;
        std::size_t count = 0;
        stack[count++] = 0;
        while (count > 0) {
            const TriangleBvh::Node& node = tree_.nodes[stack[--count]];
            if (squareDistance(point, node) > square) continue;
            for (std::size_t i = 0; i < node.count; ++i) {
                const Segment& segment = segments_[node.first + i];
                if (!visit(segment, squareDistanceOf(point, segment))) return;
            }
            if (node.count > 0) continue;
            stack[count++] = node.first;
            stack[count++] = node.first + 1;
        }
    }

    struct Nearest {
        double square = std::numeric_limits<double>::infinity();  // of the distance
        const Segment* segment = nullptr;
    };

    // The nearest segment, or none if it is not nearer than `bound`.
    Nearest nearest(const glm::dvec3& point, double bound) const {
        Nearest best{.square = bound * bound};
        forEachNearer(tree_, point, best.square, [&](std::size_t slot) {
            const double square = squareDistanceOf(point, segments_[slot]);
            if (square < best.square) best = {square, &segments_[slot]};
        });
        return best;
    }

private:
    static double squareDistanceOf(const glm::dvec3& point, const Segment& segment) {
        const glm::dvec3 from(segment.from);
        const glm::dvec3 along = glm::dvec3(segment.to) - from;
        const glm::dvec3 to_point = point - from;
        const double share =
            std::clamp(glm::dot(to_point, along) / glm::dot(along, along), 0.0, 1.0);
        const glm::dvec3 off = to_point - share * along;
        return glm::dot(off, off);
    }

    TriangleBvh tree_;
    std::vector<Segment> segments_;  // in the order of the leaves
};

// ---- Matches ------------------------------------------------------------------------------------

// Results of a search for one groom's samples in the other.
struct Found {
    std::vector<float> distances;  // [sample], m
    std::vector<std::vector<std::uint32_t>> matched;  // [threshold][strand], matched samples
    // Greatest number of matched samples that lie in one strand of the other groom.
    std::vector<std::vector<std::uint32_t>> together;
};

// Whether matches are counted for each strand of the other groom. This takes all matches of a
// sample, not just one.
enum class MatchedStrands { counted, any };

// A threshold in the form that is compared.
struct Limit {
    double square;  // m^2
    double cosine;
};

// The cosine of two equal directions may round below 1.
constexpr double kCosineSlack = 1e-12;

// Counts the samples of one strand that find the same strand of the other groom.
class StrandMatches {
public:
    StrandMatches(std::uint32_t strands, std::size_t limits)
        : seen_(strands * limits), limits_(limits), most_(limits) {}

    // Records that a sample of the strand, numbered from 1, finds `strand`. Each sample counts
    // once.
    void find(std::uint32_t strand, std::size_t limit, std::uint32_t sample) {
        Seen& seen = seen_[strand * limits_ + limit];
        if (seen.last_sample == sample) return;
        if (seen.samples == 0) touched_.push_back(strand * limits_ + limit);
        seen.last_sample = sample;
        most_[limit] = std::max(most_[limit], ++seen.samples);
    }

    // Returns the greatest number of samples that found a single strand, [limit], and forgets all.
    std::vector<std::uint32_t> take() {
        for (const std::size_t i : touched_) seen_[i] = {};
        touched_.clear();
        return std::exchange(most_, std::vector<std::uint32_t>(limits_));
    }

private:
    struct Seen {
        std::uint32_t last_sample = 0;
        std::uint32_t samples = 0;
    };
    std::vector<Seen> seen_;  // [strand][limit]
    std::vector<std::size_t> touched_;
    std::size_t limits_;
    std::vector<std::uint32_t> most_;  // [limit]
};

std::size_t consistencySamples(std::size_t samples, std::uint32_t most) {
    return most == 0 ? samples : std::min<std::size_t>(samples, most);
}

// Searches for a groom's strands in the other groom, one after the other.
class StrandSearch {
public:
    StrandSearch(
        const MeasuredStrands& strands, const MeasuredStrands& others, const SegmentBvh& tree,
        const CompareSettings& settings, MatchedStrands kind, Found& found)
        : strands_(strands), tree_(tree), directions_(settings.directions),
          consistency_samples_(settings.consistency_samples), kind_(kind),
          matches_(
              kind == MatchedStrands::counted ? others.count() : 0, settings.thresholds.size()),
          found_(found) {
        for (const MatchThreshold& each : settings.thresholds) {
            limits_.push_back(
                {each.distance * each.distance, std::cos(glm::radians(each.angle)) - kCosineSlack});
            reach_ = std::max(reach_, limits_.back().square);
        }
        is_matched_.resize(limits_.size());
    }

    void operator()(std::uint32_t strand) {
        // A distance is at most that of the previous sample plus the distance between the two
        // samples.
        glm::dvec3 before(0.0);
        double bound = std::numeric_limits<double>::infinity();
        forEachSample(strands_, strand, [&](std::size_t k, const StrandSample& sample) {
            const double way = glm::distance(sample.point, before);
            auto nearest = tree_.nearest(sample.point, (bound + way) * (1.0 + 1e-9));
            if (!nearest.segment)  // both are 0, or rounding
                nearest = tree_.nearest(sample.point, std::numeric_limits<double>::infinity());
            before = sample.point;
            bound = std::sqrt(nearest.square);
            found_.distances[strands_.first_samples[strand] + k] = static_cast<float>(bound);
            if (nearest.square > reach_) return;
            const bool counts = kind_ == MatchedStrands::counted && isCounted(strand, k);
            match(
                sample, nearest, counts ? MatchedStrands::counted : MatchedStrands::any,
                static_cast<std::uint32_t>(k + 1));
            for (std::size_t i = 0; i < limits_.size(); ++i)
                found_.matched[i][strand] += is_matched_[i] ? 1u : 0u;
        });
        if (kind_ == MatchedStrands::any) return;
        const std::vector<std::uint32_t> most = matches_.take();
        for (std::size_t i = 0; i < limits_.size(); ++i) found_.together[i][strand] = most[i];
    }

private:
    // Whether the sample counts towards the strand's consistency. The counted samples are the
    // middles of consistencySamples() equal runs of samples.
    bool isCounted(std::uint32_t strand, std::size_t k) const {
        const std::size_t samples = strands_.samples(strand);
        const std::size_t counted = consistencySamples(samples, consistency_samples_);
        const std::size_t run = k * counted / samples;
        return k == (2 * run + 1) * samples / (2 * counted);
    }

    // Tries the nearest segment first, because it mostly matches.
    void match(
        const StrandSample& sample, const SegmentBvh::Nearest& nearest, MatchedStrands kind,
        std::uint32_t number) {
        is_matched_.assign(limits_.size(), false);
        std::size_t left = limits_.size();  // limits without a match
        const auto goOn = [&](const SegmentBvh::Segment& other, double square) {
            if (square > reach_) return true;
            const glm::dvec3 along = glm::dvec3(other.to) - glm::dvec3(other.from);
            double cosine = glm::dot(sample.tangent, along) / glm::length(along);
            if (directions_ == StrandDirections::either_way) cosine = std::abs(cosine);
            for (std::size_t i = 0; i < limits_.size(); ++i) {
                if (square > limits_[i].square || cosine < limits_[i].cosine) continue;
                left -= is_matched_[i] ? 0 : 1;
                is_matched_[i] = true;
                if (kind == MatchedStrands::counted) matches_.find(other.strand, i, number);
            }
            return left > 0 || kind == MatchedStrands::counted;
        };
        if (goOn(*nearest.segment, nearest.square)) tree_.forEachNear(sample.point, reach_, goOn);
    }

    const MeasuredStrands& strands_;
    const SegmentBvh& tree_;
    StrandDirections directions_;
    std::uint32_t consistency_samples_;
    MatchedStrands kind_;
    std::vector<Limit> limits_;
    double reach_ = 0.0;  // the greatest of the limits' squares, m^2
    StrandMatches matches_;
    std::vector<bool> is_matched_;  // [limit]
    Found& found_;
};

constexpr double kShortestBox = 1e-3;  // m

Found findIn(
    const MeasuredStrands& strands, const MeasuredStrands& others, const CompareSettings& settings,
    MatchedStrands kind) {
    double farthest = 0.0;
    for (const MatchThreshold& each : settings.thresholds)
        farthest = std::max(farthest, each.distance);
    const SegmentBvh tree(others, std::max(2.0 * farthest, kShortestBox));
    Found found{.distances = std::vector<float>(strands.first_samples.back())};
    found.matched.assign(settings.thresholds.size(), std::vector<std::uint32_t>(strands.count()));
    found.together = found.matched;
    const bool counts = kind == MatchedStrands::counted;
    const char* const step =
        counts ? "finds strands in the second groom" : "finds strands in the first groom";
    forEachStrand(step, strands.count(), settings.threads, [&] {
        return StrandSearch(strands, others, tree, settings, kind, found);
    });
    return found;
}

double matchedShare(const Found& found, std::size_t threshold) {
    const auto& matched = found.matched[threshold];
    const std::size_t sum = std::accumulate(matched.begin(), matched.end(), std::size_t{0});
    return static_cast<double>(sum) / static_cast<double>(found.distances.size());
}

double consistency(
    const Found& found, const MeasuredStrands& strands, std::size_t threshold,
    std::uint32_t most_samples) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < strands.count(); ++i)
        sum += found.together[threshold][i] /
               static_cast<double>(consistencySamples(strands.samples(i), most_samples));
    return sum / strands.count();
}

// ---- Distributions ------------------------------------------------------------------------------

DistanceFindings findingsOf(std::vector<float>& distances) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double distance : distances) {
        sum += distance;
        squares += distance * distance;
    }
    const auto count = static_cast<double>(distances.size());
    return {
        .mean = sum / count,
        .mean_square = squares / count,
        .median = quantileOf(distances, 0.5),
        .percentile90 = quantileOf(distances, 0.9),
        .percentile95 = quantileOf(distances, 0.95),
        .percentile99 = quantileOf(distances, 0.99),
        .maximum = double{*std::ranges::max_element(distances)}};
}

// The area between the cumulative distributions of two ascending lists.
double earthMoversDistance(std::span<const float> first, std::span<const float> second) {
    double area = 0.0;
    std::size_t i = 0;
    std::size_t k = 0;
    double place = std::min(first[0], second[0]);
    while (i < first.size() || k < second.size()) {
        const double share_first = static_cast<double>(i) / static_cast<double>(first.size());
        const double share_second = static_cast<double>(k) / static_cast<double>(second.size());
        const bool is_first = k == second.size() || (i < first.size() && first[i] <= second[k]);
        const double next = is_first ? first[i++] : second[k++];
        area += std::abs(share_first - share_second) * (next - place);
        place = next;
    }
    return area;
}

constexpr std::size_t kBins = 20;  // and one for all beyond them

std::vector<double> sharesOf(std::span<const float> ascending, std::span<const double> edges) {
    std::vector<double> shares;
    auto from = ascending.begin();
    for (std::size_t i = 1; i <= edges.size(); ++i) {
        const auto end =
            i < edges.size() ? std::lower_bound(from, ascending.end(), edges[i]) : ascending.end();
        shares.push_back(static_cast<double>(end - from) / static_cast<double>(ascending.size()));
        from = end;
    }
    return shares;
}

// The numbers must not be negative. The bins reach to the greater of the two 99th percentiles.
DistributionFindings distributionsOf(std::vector<float> first, std::vector<float> second) {
    DistributionFindings findings{.first = summaryOf(first), .second = summaryOf(second)};
    double top = std::max(quantileOf(first, 0.99), quantileOf(second, 0.99));
    if (top == 0.0) top = 1.0;
    std::ranges::sort(first);
    std::ranges::sort(second);
    findings.earth_movers_distance = earthMoversDistance(first, second);
    for (std::size_t i = 0; i <= kBins; ++i)
        findings.edges.push_back(top * static_cast<double>(i) / double{kBins});
    findings.first_shares = sharesOf(first, findings.edges);
    findings.second_shares = sharesOf(second, findings.edges);
    for (std::size_t i = 0; i < findings.first_shares.size(); ++i)
        findings.histogram_distance +=
            std::abs(findings.first_shares[i] - findings.second_shares[i]);
    return findings;
}

std::vector<float> lengthsOf(const MeasuredStrands& strands) {
    return {strands.lengths.begin(), strands.lengths.end()};
}

// Curvature is the angle between successive chords over the arc between their middles. On a circle
// it is exact for any step. There are at least two chords.
std::vector<float> curvaturesOf(const MeasuredStrands& strands, double wanted_step) {
    std::vector<float> curvatures;
    for (std::uint32_t i = 0; i < strands.count(); ++i) {
        const double length = strands.lengths[i];
        const auto pieces =
            static_cast<std::size_t>(std::max(2.0, std::round(length / wanted_step)));
        const double step = length / static_cast<double>(pieces);
        StrandWalk walk(strands.points(i));
        glm::dvec3 point = walk.at(0.0).point;
        glm::dvec3 chord(0.0);
        for (std::size_t k = 1; k <= pieces; ++k) {
            const glm::dvec3 next = walk.at(static_cast<double>(k) * step).point;
            const glm::dvec3 next_chord = next - point;
            if (k > 1) {
                const double angle = std::atan2(
                    glm::length(glm::cross(chord, next_chord)), glm::dot(chord, next_chord));
                curvatures.push_back(static_cast<float>(angle / step));
            }
            point = next;
            chord = next_chord;
        }
    }
    return curvatures;
}

// ---- Penetration --------------------------------------------------------------------------------

PenetrationFindings
penetrationOf(const MeasuredStrands& strands, const DepthInside& depths, std::uint32_t threads) {
    struct Inside {
        std::size_t samples = 0;
        double sum = 0.0;
        double deepest = 0.0;
    };
    std::vector<Inside> inside(strands.count());
    forEachStrand("finds strands inside the head", strands.count(), threads, [&] {
        return [&, depthOf = depths](std::uint32_t strand) mutable {
            forEachSample(strands, strand, [&](std::size_t, const StrandSample& sample) {
                const double depth = depthOf(sample.point);
                Inside& all = inside[strand];
                all.deepest = std::max(all.deepest, depth);
                if (depth <= kSurfaceTolerance) return;
                ++all.samples;
                all.sum += depth;
            });
        };
    });
    PenetrationFindings findings;
    double sum = 0.0;
    for (const Inside& each : inside) {
        findings.samples_inside += each.samples;
        findings.strands_inside += each.samples > 0 ? 1 : 0;
        findings.deepest = std::max(findings.deepest, each.deepest);
        sum += each.sum;
    }
    findings.share = static_cast<double>(findings.samples_inside) /
                     static_cast<double>(strands.first_samples.back());
    if (findings.samples_inside > 0)
        findings.mean_depth = sum / static_cast<double>(findings.samples_inside);
    return findings;
}

// ---- The whole ----------------------------------------------------------------------------------

void checkCompareSettings(const CompareSettings& settings) {
    const auto isPositive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (!isPositive(settings.spacing)) throw engine::Error("spacing", "is not a length above 0");
    if (!isPositive(settings.curvature_step))
        throw engine::Error("curvature step", "is not a length above 0");
    if (settings.thresholds.empty()) throw engine::Error("thresholds", "there are none");
    for (const MatchThreshold& each : settings.thresholds)
        if (!isPositive(each.distance) || !(each.angle >= 0.0 && each.angle <= 180.0))
            throw engine::Error(
                "threshold", "expected a finite distance above 0 and an angle in [0, 180] degrees");
}

SampledStrands sampledOf(const MeasuredStrands& strands) {
    return {
        .strands = strands.set.strandCount(),
        .without_length = strands.set.strandCount() - strands.count(),
        .samples = strands.first_samples.back(),
        .length = std::accumulate(strands.lengths.begin(), strands.lengths.end(), 0.0)};
}

}  // namespace

StrandComparison compareStrands(
    const StrandSet& first, const StrandSet& second, const BodyMesh* mesh,
    const CompareSettings& settings) {
    checkCompareSettings(settings);
    const MeasuredStrands a = measureStrands(first, settings.spacing, "the first groom");
    const MeasuredStrands b = measureStrands(second, settings.spacing, "the second groom");
    StrandComparison comparison{
        .first = sampledOf(a),
        .second = sampledOf(b),
        .equal = first.ends == second.ends && first.points == second.points};

    Found of_first = findIn(a, b, settings, MatchedStrands::counted);
    Found of_second = findIn(b, a, settings, MatchedStrands::any);
    for (std::size_t i = 0; i < settings.thresholds.size(); ++i) {
        MatchScores scores{
            .threshold = settings.thresholds[i],
            .precision = matchedShare(of_second, i),
            .recall = matchedShare(of_first, i),
            .strand_consistency = consistency(of_first, a, i, settings.consistency_samples)};
        if (scores.precision + scores.recall > 0.0)
            scores.f1 = 2.0 * scores.precision * scores.recall / (scores.precision + scores.recall);
        comparison.scores.push_back(scores);
    }
    comparison.first_to_second = findingsOf(of_first.distances);
    comparison.second_to_first = findingsOf(of_second.distances);
    comparison.lengths = distributionsOf(lengthsOf(a), lengthsOf(b));
    comparison.curvatures = distributionsOf(
        curvaturesOf(a, settings.curvature_step), curvaturesOf(b, settings.curvature_step));
    if (mesh) {
        const DepthInside depths(*mesh);
        comparison.first_inside = penetrationOf(a, depths, settings.threads);
        comparison.second_inside = penetrationOf(b, depths, settings.threads);
    }
    return comparison;
}

}  // namespace hair::groom
