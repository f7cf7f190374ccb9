#include "hair/rendering/strand_offsets.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/error.h"
#include "hair/groom/style/along_strand.h"
#include "hair/random.h"
#include "hair/rendering/model_offsets.h"
#include "hair/rendering/procedural_offsets.h"

namespace hair {
namespace {

constexpr double kSamplesPerTurn = 16.0;
constexpr double kSamplesPerChange = 8.0;
constexpr std::uint32_t kMostValues = std::uint32_t{1} << 22;

bool curls(const StrandSettings& settings) { return settings.curl.radius > 0.0f; }

bool varies(const StrandSettings& settings) {
    return settings.variation.amplitude > 0.0f && settings.variation.share > 0.0f;
}

double meanLength(const Groom& groom) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i)
        sum += AlongStrand(groom.strand(i)).length();
    return sum / groom.strand_count;
}

// Intervals that `count` things of a strand need.
std::uint32_t intervalsFor(
    double count, double intervals_each, const std::string& pointer, const std::string& things) {
    const double most = StrandOffsets::kMostSamples / intervals_each;
    if (count > most)
        throw engine::Error(
            pointer, "makes " + std::to_string(std::llround(count)) + ' ' + things +
                         " on a strand, more than the " + std::to_string(std::llround(most)) +
                         " that offsets can have");
    return static_cast<std::uint32_t>(std::ceil(count * intervals_each));
}

std::uint32_t
samplesFor(const StrandSettings& settings, double length, const std::optional<StrandSet>& model) {
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
    // What starts slowly has to be seen starting slowly.
    constexpr std::uint32_t kLeastIntervals = 32;
    return std::clamp(intervals + 1, kLeastIntervals + 1, StrandOffsets::kMostSamples);
}

// The next one of evenly spaced points of a parabola.
glm::vec3 runOn(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return 3.0f * (c - b) + a;
}

}  // namespace

bool hasOffsets(const StrandSettings& settings) {
    return curls(settings) || varies(settings) || !settings.offsets.empty();
}

StrandOffsets makeStrandOffsets(
    const StrandSettings& settings, const Groom& groom, const StrandSet* model,
    std::uint32_t seed) {
    std::optional<StrandSet> strands;
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
        offsets.values.push_back(runOn(samples[2], samples[1], samples[0]));
        offsets.values.insert(offsets.values.end(), samples.begin(), samples.end());
        offsets.values.push_back(runOn(samples.end()[-3], samples.end()[-2], samples.end()[-1]));
    }
    return offsets;
}

}  // namespace hair
