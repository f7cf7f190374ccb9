#include "hair/groom/style/style.h"

namespace hair {

Groom style(Groom groom, const StyleSettings& settings, std::uint32_t seed) {
    groom = clump(std::move(groom), settings.clump, seed);
    groom = wave(std::move(groom), settings.wave, seed);
    groom = curl(std::move(groom), settings.curl, seed);
    groom = frizz(std::move(groom), settings.frizz, seed);
    groom = cut(std::move(groom), settings.cut);
    return taper(std::move(groom), settings.taper);
}

}  // namespace hair
