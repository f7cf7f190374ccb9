#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

namespace hair::groom {

// Writes one LINES primitive, as importGltfStrands() reads it, and a node that scales to metres if
// the strands' unit is known to be another. Keeps StrandExporter's contract.
std::vector<std::string> exportGltf(const StrandSet& strands, std::ostream& out);  // data in JSON
std::vector<std::string> exportGlb(const StrandSet& strands, std::ostream& out);  // binary

// Reads strands of a glTF 2.0 file, .glb or .gltf: its line primitives. LINES are chained as
// polylines.h says; without indices, a line continues the previous one if it begins at its end.
// LINE_STRIP is root first. Points are POSITION under the node's transform, in metres. Widths are
// `_WIDTH`, scaled by the cube root of the transform's change of volume. COLOR_0 gives colours,
// and transparencies if there is no `_TRANSPARENCY`. Strands of hidden nodes are counted and left
// out; extras may have groups and guides. Other primitives are skipped with a warning. Errors begin
// with the mesh and primitive, the accessor, or the byte where JSON ends.
StrandSet importGltfStrands(const StrandFile& file);

}  // namespace hair::groom
