#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

namespace hair::groom {

// Writes what gltf.h reads: one LINES primitive, and a node that scales to metres
// where the strands' unit is known to be another. As StrandExporter says.
std::vector<std::string> exportGltf(const StrandSet& strands, std::ostream& out);  // data in JSON
std::vector<std::string> exportGlb(const StrandSet& strands, std::ostream& out);  // binary

// Strands of a glTF 2.0 file, .glb or .gltf: its line primitives, LINES chained as polylines.h
// says (without indices, where one begins at the point at which the last one ended), LINE_STRIP
// root first. Points are POSITION under the node's transform, in metres; widths are
// `_WIDTH`, scaled by the cube root of the transform's change of volume; COLOR_0 gives colours, and
// transparencies where `_TRANSPARENCY` doesn't. Other primitives are skipped with a warning.
// Errors begin with the mesh and primitive, the accessor, or the byte where JSON ends.
StrandSet importGltfStrands(const StrandFile& file);

}  // namespace hair::groom
