#pragma once

#include "hair/groom/groom.h"
#include "hair/settings.h"

namespace hair {

// How many times wider strands may become in LodMode::distance, 1 or more.
//
// Strands thrown at random cover 1 - exp(-a) of what is behind them, a the sum of their areas over
// that area: fewer and wider ones of the same sum cover as much. But they stick out: hair of area A
// and outline P becomes A + P (s - 1) w / 2 where strands of width w are s times as wide (Steiner's
// formula, without its term in the square). With P / A = 2 / R of a disc as large as the hair that
// is (s - 1) w / R more, and it may be kOutlineGrowth.
float greatestWidthScale(const Groom& groom, const StrandSettings& settings);

inline constexpr float kOutlineGrowth = 0.03f;

}  // namespace hair
