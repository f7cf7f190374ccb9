#include "hair/groom/style/style.h"

#include "hair/groom/style/displace.h"
#include "hair/groom/style/smooth_noise.h"
#include "hair/random.h"

namespace hair {

Groom frizz(Groom groom, const FrizzSettings& settings, std::uint32_t seed) {
    if (settings.amplitude == 0.0f) return groom;
    return displace(
        std::move(groom), settings.start,
        [&](const Groom&, std::uint32_t strand, const AlongStrand& along) {
            return [&, own = hash(seed, strand, purpose::frizz_x)](std::uint32_t point) {
                return double{settings.amplitude} *
                       smoothNoise(own, purpose::frizz_x, settings.frequency * along.arc(point));
            };
        });
}

}  // namespace hair
