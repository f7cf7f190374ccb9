#pragma once

#include <vector>

#include "hair/groom/inspect.h"

namespace hair {

// Quartiles lie between two of the numbers where their rank isn't whole (Hyndman and Fan 1996,
// Sample quantiles in statistical packages, definition 7). All 0 without numbers. Leaves them in
// another order: a copy of them all would be too much.
Spread spreadOf(std::vector<float>& numbers);

}  // namespace hair
