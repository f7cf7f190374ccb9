#include "hair/groom/style/style.h"

#include <cmath>

#include "hair/groom/style/along_strand.h"

namespace hair {

Groom taper(Groom groom, const TaperSettings& settings) {
    if (settings.root_width == 0.0f) return groom;
    groom.widths.resize(groom.points.size());
    const double start = settings.start;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const AlongStrand along(groom.strand(strand));
        const std::size_t first = std::size_t{strand} * groom.vertices_per_strand;
        for (std::uint32_t i = 0; i < groom.vertices_per_strand; ++i) {
            const double past = along.fraction(i) - start;
            groom.widths[first + i] = static_cast<float>(
                past <= 0.0
                    ? settings.root_width
                    : std::lerp(settings.root_width, settings.tip_width, past / (1.0 - start)));
        }
    }
    return groom;
}

}  // namespace hair
