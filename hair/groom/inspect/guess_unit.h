#pragma once

#include <string>

namespace hair {

struct Unit {
    std::string name;  // "m", "cm", "mm" or "inch"; a stated one may be another: "0.5 m"
    double metres;     // its length
    std::string reason;  // a sentence
};

Unit statedUnit(double metres);

// Of human hair: the unit in which the extent of the roots is nearest to that of a scalp and the
// median strand is long as hair is. Either may be 0: then it says nothing.
Unit guessUnit(double root_extent, double median_length);

}  // namespace hair
