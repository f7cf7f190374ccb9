#include "hair/groom/style/style.h"

#include <cmath>
#include <numbers>

#include "hair/groom/style/displace.h"
#include "hair/groom/style/strand_frames.h"
#include "hair/random.h"

namespace hair {

Groom wave(Groom groom, const WaveSettings& settings, std::uint32_t seed) {
    if (settings.amplitude == 0.0f) return groom;
    return displace(
        std::move(groom), settings.start,
        [&](const Groom& before, std::uint32_t strand, const AlongStrand& along) {
            const double phase =
                double{settings.phase_variation} * random01(seed, strand, purpose::wave_phase);
            return [&, phase,
                    frames = strandFrames(before.strand(strand), rootNormalOf(before, strand))](
                       std::uint32_t point) {
                const double waves = settings.frequency * along.arc(point) + phase;
                return settings.amplitude * std::sin(2.0 * std::numbers::pi * waves) *
                       frames[point].normal;
            };
        });
}

}  // namespace hair
