#include "hair/groom/inspect/guess_unit.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace hair {
namespace {

struct Known {
    const char* name;
    double metres;
};

constexpr std::array kKnown{
    Known{"m", 1.0}, Known{"cm", 0.01}, Known{"mm", 0.001}, Known{"inch", 0.0254}};

// Heads are 0.15 m wide and 0.2 m long, more or less, and hair is 0.01 m to 1 m long. The scatter
// is a factor: with 1.5, the extent of a part of a scalp or of a bearded head is still likely, and
// an inch is well apart from a centimetre.
constexpr double kRootExtent = 0.2;
constexpr double kRootScatter = 1.5;
constexpr double kLength = 0.1;
constexpr double kLengthScatter = 10.0;

// Square of the number of scatters that a size is off.
double misfit(double size, double expected, double scatter) {
    const double off = size > 0.0 ? std::log(size / expected) / std::log(scatter) : 0.0;
    return off * off;
}

}  // namespace

Unit statedUnit(double metres) {
    for (const Known& known : kKnown)
        if (std::abs(metres / known.metres - 1.0) < 1e-6)
            return {known.name, metres, "The file states it."};
    std::ostringstream name;
    name << metres << " m";
    return {name.str(), metres, "The file states it."};
}

Unit guessUnit(double root_extent, double median_length) {
    const Known* best = &kKnown.front();
    double least = std::numeric_limits<double>::infinity();
    for (const Known& known : kKnown) {
        const double found = misfit(root_extent * known.metres, kRootExtent, kRootScatter) +
                             misfit(median_length * known.metres, kLength, kLengthScatter);
        if (found >= least) continue;
        least = found;
        best = &known;
    }
    std::ostringstream reason;
    reason.precision(3);
    reason << "The file doesn't state it";
    if (root_extent <= 0.0 && median_length <= 0.0) {
        reason << ", and nothing in it has a length to guess from.";
    } else {
        reason << "; in " << best->name << " ";
        if (root_extent > 0.0)
            reason << "the roots span " << root_extent * best->metres << " m (a head: about "
                   << kRootExtent << " m)";
        if (root_extent > 0.0 && median_length > 0.0) reason << " and ";
        if (median_length > 0.0)
            reason << "the median strand is " << median_length * best->metres
                   << " m long (hair: 0.01 m to 1 m)";
        reason << ", which fits best of m, cm, mm and inch.";
    }
    return {best->name, best->metres, reason.str()};
}

}  // namespace hair
