#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Strands of a Wavefront OBJ file: its line elements, `l`, of vertices, `v x y z [r g b]`, root
// first.
namespace hair::groom {

// A StrandExporter's `write`. Numbers are the shortest decimals that give the same floats.
std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out);

// A StrandImporter's `read`. Consecutive elements of two points that continue each other become
// one strand, because some programs write only segments. The comment at the beginning of the file
// is kept. Everything except vertices and lines is skipped, faces with a warning.
StrandSet importObj(const StrandFile& file);

}  // namespace hair::groom
