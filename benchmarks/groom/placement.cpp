#include "benchmarks/groom/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "benchmarks/report/text.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/surface.h"

namespace benchmarks::groom {
namespace {

constexpr std::array kUnits{1.0, 0.01, 0.001, 0.0254};  // m
constexpr std::array kTurns{0, 90, 180, 270};  // deg

glm::dmat3 turned(double degrees, const glm::dvec3& axis) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

// Returns the quarter turn that takes an axis to +y.
glm::dmat3 uprightOf(int up) {
    if (up == 0) return turned(90.0, {0.0, 0.0, 1.0});
    if (up == 2) return turned(-90.0, {1.0, 0.0, 0.0});
    return glm::dmat3(1.0);
}

// ---- The head by itself -------------------------------------------------------------------------

// A head is 0.2 to 0.3 m high, a bust 0.5 m, a whole figure 1.8 m. The scatter is a factor on the
// size, chosen so that a figure in metres, and a head alone in any unit, are recognised.
constexpr double kHeadSize = 0.35;
constexpr double kHeadScatter = 1.8;
constexpr double kSmallestHead = 0.12;
constexpr double kLargestHead = 2.5;

bool isSizeOfHead(double metres) { return metres >= kSmallestHead && metres <= kLargestHead; }

double headUnit(double size) {
    const auto deviation = [size](double metres) {
        return std::abs(std::log(size * metres / kHeadSize) / std::log(kHeadScatter));
    };
    return *std::ranges::min_element(kUnits, {}, deviation);
}

// ---- Roots on the head --------------------------------------------------------------------------

constexpr std::uint32_t kMostSamples = 500;

// Returns the indices of some strands, evenly spaced.
std::vector<std::uint32_t> sampled(const hair::groom::StrandSet& strands) {
    std::vector<std::uint32_t> samples(std::min(strands.strandCount(), kMostSamples));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] =
            static_cast<std::uint32_t>(std::uint64_t{i} * strands.strandCount() / samples.size());
    return samples;
}

enum class End { root, tip };

class Roots {
public:
    Roots(const hair::groom::StrandSet& strands, const hair::groom::Mesh& head, End end)
        : surface_(head.positions, head.triangles), head_(boxOf(head.positions)) {
        for (const std::uint32_t i : sampled(strands))
            roots_.push_back(
                end == End::root ? strands.strand(i).front() : strands.strand(i).back());
    }

    const Box& head() const { return head_; }

    // Two attempts that place the hair equally on the head have exactly the same fit.
    RootFit fit(const Lay& hair, const Lay& head) {
        const glm::dmat3 rotation = glm::transpose(head.rotation()) * hair.rotation();
        std::array<double, 10> key{hair.metres_per_unit / head.metres_per_unit};
        for (int i = 0; i < 9; ++i)
            key[static_cast<std::size_t>(i) + 1] = std::round(rotation[i / 3][i % 3]);
        const auto [entry, is_new] = fits_.try_emplace(key);
        if (is_new) entry->second = measured(rotation, hair, head);
        return entry->second;
    }

    // Returns how far the median root lies above the middle of the head, in units of the
    // head's size.
    double above(const Lay& hair, const Lay& head) const {
        std::vector<float> heights;
        for (const glm::vec3& root : roots_) heights.push_back(static_cast<float>(hair(root).y));
        const glm::dvec3 centre = head(glm::vec3(head_.centre()));
        return (hair::groom::quantileOf(heights, 0.5) - centre.y) /
               (head.metres_per_unit * head_.longestSide());
    }

private:
    RootFit measured(const glm::dmat3& rotation, const Lay& hair, const Lay& head) const {
        std::vector<float> distances;
        distances.reserve(roots_.size());
        std::size_t near = 0;
        for (const glm::vec3& root : roots_) {
            const glm::dvec3 point =
                rotation * (hair.metres_per_unit / head.metres_per_unit * glm::dvec3(root));
            const double distance = surface_(point).distance * head.metres_per_unit;
            if (distance <= kFitTolerance) ++near;
            distances.push_back(static_cast<float>(distance));
        }
        return {
            .share = static_cast<double>(near) / static_cast<double>(roots_.size()),
            .median = hair::groom::quantileOf(distances, 0.5)};
    }

    hair::groom::NearestSurface surface_;  // of the head in its file's coordinates
    Box head_;
    std::vector<glm::vec3> roots_;
    std::map<std::array<double, 10>, RootFit> fits_;
};

}  // namespace

Box boxOf(const std::vector<glm::vec3>& points) {
    Box box;
    for (const glm::vec3& point : points) box.add(point);
    return box;
}

// ---- Hair by itself -----------------------------------------------------------------------------

const char* axisName(int axis) { return std::array{"x", "y", "z"}[static_cast<std::size_t>(axis)]; }

// Strands leave the scalp along its normal, which points up on average, and hang down from there.
UpGuess guessUp(const hair::groom::StrandSet& strands) {
    glm::dvec3 leaves(0.0);
    glm::dvec3 hangs(0.0);
    for (const std::uint32_t i : sampled(strands)) {
        const auto points = strands.strand(i);
        const glm::dvec3 root = points.front();
        const auto apart =
            std::ranges::find_if(points, [&](const glm::vec3& p) { return glm::dvec3(p) != root; });
        if (apart == points.end()) continue;
        leaves += glm::normalize(glm::dvec3(*apart) - root);
        const glm::dvec3 tip = glm::dvec3(points.back()) - root;
        if (glm::length(tip) > 0.0) hangs -= glm::normalize(tip);
    }
    std::array<std::pair<double, int>, 3> scores;
    for (int axis = 0; axis < 3; ++axis)
        scores[static_cast<std::size_t>(axis)] = {
            (leaves[axis] + std::max(0.0, hangs[axis])) /
                std::max(1.0, static_cast<double>(std::min(strands.strandCount(), kMostSamples))),
            axis};
    std::ranges::sort(scores, std::greater());
    return {scores[0].second, scores[0].first - scores[1].first};
}

std::string straysText(const std::vector<hair::groom::Stray>& strays, double metres_per_unit) {
    constexpr std::size_t kMostNamed = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(strays.size(), kMostNamed); ++i) {
        const hair::groom::Stray& stray = strays[i];
        const std::string length = report::lengthText(stray.distance * metres_per_unit);
        text += (i == 0 ? "strand " : ", strand ") + std::to_string(stray.strand) +
                (i == 0 ? " (from 0)" : "") +
                (stray.by_root ? " with its root " + length + " from the middle of the others"
                               : " with a segment of " + length);
    }
    if (strays.size() > kMostNamed)
        text += " and " + std::to_string(strays.size() - kMostNamed) + " more";
    return text;
}

namespace {

// ---- The guess ----------------------------------------------------------------------------------

// With fewer of the roots on the head, no attempt is conclusive.
constexpr double kLeastShare = 0.3;
// More of the roots by this share speak against a statement.
constexpr double kClearlyMore = 0.1;
// With so many of the last points on the head, strands run from tip to root.
constexpr double kMostTips = 0.5;
// Attempts within these differences are equally good.
constexpr double kEqualShare = 0.02;
constexpr double kEqualMedian = 5e-4;  // m

std::string percent(double share) { return report::shortNumber(100.0 * share) + " %"; }

std::string fitText(const RootFit& fit) {
    return percent(fit.share) + " of the roots are within " + report::lengthText(kFitTolerance) +
           " of the head, the median one " + report::lengthText(fit.median) + " from it";
}

bool placesAlike(const LayAttempt& a, const LayAttempt& b) {
    const auto relative = [](const LayAttempt& attempt) {
        return glm::transpose(attempt.head.rotation()) * attempt.hair.rotation();
    };
    if (a.hair.metres_per_unit != b.hair.metres_per_unit) return false;
    const glm::dmat3 difference = relative(a) - relative(b);
    double most = 0.0;
    for (int i = 0; i < 9; ++i) most = std::max(most, std::abs(difference[i / 3][i % 3]));
    return most < 0.5;
}

// Returns a penalty for an attempt's assumptions: different axes or units for hair and head cost
// more than an unusual axis for both.
int suppositions(const LayAttempt& attempt) {
    return 4 * (attempt.hair.turn != attempt.head.turn) + 4 * (attempt.hair.up != attempt.head.up) +
           2 * (attempt.hair.metres_per_unit != attempt.head.metres_per_unit) +
           (attempt.head.up != 1);
}

std::vector<LayAttempt> attemptsOf(
    Roots& roots, double head_metres, const std::vector<double>& units, const LayHints& hints) {
    std::vector<LayAttempt> attempts;
    for (int head_up = 0; head_up < 3; ++head_up) {
        if (hints.head_is_stated && head_up != 1) continue;
        const Lay head{.metres_per_unit = head_metres, .up = head_up};
        for (int up = 0; up < 3; ++up) {
            if (hints.up && up != *hints.up) continue;
            for (const int turn : kTurns)
                for (const double unit : units) {
                    const Lay hair{.metres_per_unit = unit, .up = up, .turn = turn};
                    attempts.push_back({hair, head, roots.fit(hair, head)});
                }
        }
    }
    return attempts;
}

const LayAttempt& bestOf(const std::vector<LayAttempt>& attempts, const Roots& roots) {
    const LayAttempt* first = attempts.data();
    for (const LayAttempt& each : attempts)
        if (std::tuple(-each.fit.share, each.fit.median) <
            std::tuple(-first->fit.share, first->fit.median))
            first = &each;
    const LayAttempt* best = nullptr;
    std::tuple<double, int> least{};
    for (const LayAttempt& each : attempts) {
        if (each.fit.share < first->fit.share - kEqualShare ||
            each.fit.median > first->fit.median + kEqualMedian)
            continue;
        // Rounded to tenths of the head's size, because smaller differences say nothing about the
        // upward axis.
        const std::tuple worth{
            -std::round(10.0 * roots.above(each.hair, each.head)), suppositions(each)};
        if (best && worth >= least) continue;
        least = worth;
        best = &each;
    }
    return *best;
}

// Guesses the placement of hair and head separately.
void guessApart(
    const hair::groom::StrandSet& strands, const hair::groom::StrandFindings& findings,
    const LayHints& hints, LayGuess& guess) {
    guess.hair.metres_per_unit = hints.metres_per_unit.value_or(findings.metres_per_unit);
    guess.hair_reason =
        hints.metres_per_unit ? "The unit is stated by --scale." : findings.unit_reason;
    if (!hints.metres_per_unit && findings.other_unit)
        guess.doubts.push_back(
            "the file states " + findings.unit + ", but sizes are those of hair in " +
            findings.other_unit->unit.name + " (" +
            percent(std::min(findings.other_unit->certainty, 0.999)) +
            " certain): if the file is wrong, --scale " +
            report::plainNumber(findings.other_unit->unit.metres) + " sets the unit");
    if (hints.up) {
        guess.hair.up = *hints.up;
        guess.hair_reason += std::string(" +") + axisName(*hints.up) + " is up, as --up states.";
        return;
    }
    const auto [up, lead] = guessUp(strands);
    if (strands.up) {
        guess.hair.up = *strands.up;
        guess.hair_reason +=
            std::string(" +") + axisName(*strands.up) + " is up, as the file states.";
        if (up != *strands.up && lead >= kClearLead)
            guess.doubts.push_back(
                std::string("the file states +") + axisName(*strands.up) +
                " up, but strands leave the scalp and hang as if +" + axisName(up) +
                " were up, by " + report::shortNumber(lead) +
                " of their length: if the file is wrong, --up " + axisName(up) + " sets the axis");
        return;
    }
    guess.hair.up = up;
    guess.hair_reason += std::string(" +") + axisName(up) +
                         " is up: strands leave the scalp toward it and hang down from it, by " +
                         report::shortNumber(lead) +
                         " of their length more than for the next axis.";
}

}  // namespace

glm::dmat3 Lay::rotation() const { return turned(double(turn), {0.0, 1.0, 0.0}) * uprightOf(up); }

glm::vec3 Lay::eulerAngles() const {
    const glm::dmat3 m = rotation();  // [column][row] of Rz Ry Rx
    const auto degrees = [](double sine, double cosine) {
        return static_cast<float>(std::round(glm::degrees(std::atan2(sine, cosine))));
    };
    const double sine = -m[0][2];
    if (std::abs(sine) < 0.5) return {degrees(m[1][2], m[2][2]), 0.0f, degrees(m[0][1], m[0][0])};
    // A quarter turn about y, so the turn about x may be zero.
    return {0.0f, sine > 0.0 ? 90.0f : -90.0f, degrees(-m[1][0], m[1][1])};
}

std::string layText(const Lay& lay) {
    std::string text = "in " + hair::groom::statedUnit(lay.metres_per_unit).name + ", +" +
                       axisName(lay.up) + " up";
    if (lay.turn != 0) text += ", turned by " + std::to_string(lay.turn) + " degrees about it";
    return text;
}

LayGuess guessLay(
    const hair::groom::StrandSet& strands, const hair::groom::Mesh* head, const LayHints& hints) {
    const hair::groom::StrandFindings findings = hair::groom::inspect(strands, nullptr, {});
    LayGuess guess;
    if (!head) {
        guessApart(strands, findings, hints, guess);
        return guess;
    }

    Roots roots(strands, *head, End::root);
    const double size = roots.head().longestSide();
    const bool is_stated = hints.head_is_stated && isSizeOfHead(size);
    guess.head.metres_per_unit = is_stated ? 1.0 : headUnit(size);
    guess.head_reason =
        is_stated
            ? "The file states its unit and upward axis."
            : "Its longest side is " + report::shortNumber(size * guess.head.metres_per_unit) +
                  " m in " + hair::groom::statedUnit(guess.head.metres_per_unit).name +
                  " (a head is 0.2 m to 0.3 m high, a bust 0.5 m).";

    if (hints.head_is_stated && !is_stated)
        guess.doubts.push_back(
            "the head would be " + report::lengthText(size) +
            " long in the unit that its file states; it is taken to be in " +
            hair::groom::statedUnit(guess.head.metres_per_unit).name + " instead");

    // Options count more than the file's statements, and these count more than any fit.
    std::vector<double> open_units(kUnits.begin(), kUnits.end());
    if (hints.metres_per_unit) open_units = {*hints.metres_per_unit};
    std::vector<double> units = open_units;
    if (!hints.metres_per_unit && strands.metres_per_unit) units = {*strands.metres_per_unit};
    LayHints all_hints = hints;
    if (!hints.up) all_hints.up = strands.up;
    const std::vector<LayAttempt> attempts =
        attemptsOf(roots, guess.head.metres_per_unit, units, all_hints);
    guess.best = bestOf(attempts, roots);
    const LayAttempt free =
        bestOf(attemptsOf(roots, guess.head.metres_per_unit, open_units, hints), roots);
    if (free.fit.share >= kLeastShare && free.fit.share > guess.best->fit.share + kClearlyMore)
        guess.against = free;
    for (const LayAttempt& each : attempts) {
        if (placesAlike(each, *guess.best)) continue;
        if (!guess.runner_up ||
            std::tuple(-each.fit.share, each.fit.median) <
                std::tuple(-guess.runner_up->fit.share, guess.runner_up->fit.median))
            guess.runner_up = each;
    }
    guess.fits = guess.best->fit.share >= kLeastShare;
    if (!guess.fits) {
        Roots tips(strands, *head, End::tip);
        const LayAttempt turned_round =
            bestOf(attemptsOf(tips, guess.head.metres_per_unit, units, all_hints), tips);
        if (turned_round.fit.share >= kMostTips) {
            guess.reversed = turned_round;
            guess.hair = turned_round.hair;
            guess.head = turned_round.head;
            guess.hair_reason = "Strands run from tip to root: " + percent(turned_round.fit.share) +
                                " of their last points are within " +
                                report::lengthText(kFitTolerance) + " of the head.";
            return guess;
        }
        guessApart(strands, findings, hints, guess);
        if (!hints.head_is_stated) guess.head.up = guess.hair.up;
        return guess;
    }
    guess.hair = guess.best->hair;
    guess.head = guess.best->head;
    guess.hair_reason = fitText(guess.best->fit) + ".";
    if (guess.runner_up)
        guess.hair_reason += " Second best, " + layText(guess.runner_up->hair) + ": " +
                             percent(guess.runner_up->fit.share) + ", " +
                             report::lengthText(guess.runner_up->fit.median) + ".";
    return guess;
}

}  // namespace benchmarks::groom
