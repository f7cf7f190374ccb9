#include "hair/rendering/procedural_offsets.h"

#include <cmath>
#include <numbers>

#include "hair/groom/style/along_strand.h"
#include "hair/groom/style/smooth_noise.h"
#include "hair/random.h"

namespace hair {
namespace {

// Adds `offset(along)`, along in (0, 1], which grows over the fraction `start` of the strand.
template <class Offset>
void add(double start, std::span<glm::vec3> samples, Offset&& offset) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double along = static_cast<double>(i) / static_cast<double>(samples.size() - 1);
        samples[i] += glm::vec3(ease(0.0, start, along) * offset(along));
    }
}

}  // namespace

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

void addVariation(
    const StrandVariationSettings& settings, double length, std::uint32_t seed,
    std::uint32_t profile, std::span<glm::vec3> samples) {
    const std::uint32_t own = hash(seed, profile, purpose::offset_noise_x);
    add(settings.start, samples, [&](double along) {
        return double{settings.amplitude} *
               smoothNoise(own, purpose::offset_noise_x, settings.frequency * length * along);
    });
}

}  // namespace hair
