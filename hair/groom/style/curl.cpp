#include "hair/groom/style/style.h"

#include <cmath>
#include <numbers>

#include "hair/groom/style/displace.h"
#include "hair/groom/style/strand_frames.h"
#include "hair/random.h"

namespace hair {

Groom curl(Groom groom, const CurlSettings& settings, std::uint32_t seed) {
    if (settings.radius == 0.0f) return groom;
    return displace(
        std::move(groom), settings.start,
        [&](const Groom& before, std::uint32_t strand, const AlongStrand& along) {
            const double phase =
                double{settings.phase_variation} * random01(seed, strand, purpose::curl_phase);
            return [&, phase,
                    frames = strandFrames(before.strand(strand), rootNormalOf(before, strand))](
                       std::uint32_t point) {
                const double turns = settings.frequency * along.arc(point) + phase;
                const double angle = 2.0 * std::numbers::pi * turns;
                return double{settings.radius} * (std::cos(angle) * frames[point].normal +
                                                  std::sin(angle) * frames[point].binormal);
            };
        });
}

}  // namespace hair
