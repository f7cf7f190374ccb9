#pragma once

#include "hair/groom/importers.h"

namespace hair {

// The curves of every UsdGeomBasisCurves in a stage of Universal Scene Description (.usd, .usda,
// .usdc, .usdz), read by usd_curves.py, whose comments say how. Throws engine::Error: where the
// project's Python environment is missing, for a file that has no path, with the tool's last words.
StrandSet importUsd(const StrandFile& file);

}  // namespace hair
