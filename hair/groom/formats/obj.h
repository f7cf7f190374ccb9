#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// Strands of a Wavefront OBJ file: its line elements, `l`, of vertices, `v x y z [r g b]`, root
// first.
namespace hair::groom {

// A StrandExporter's `write`. Numbers are the shortest decimals that give the same floats.
std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out);

// A StrandImporter's `read`. Elements of two points that continue each other, as programs write
// that know only segments, are one strand. The comment that the file begins with is kept; what is
// neither vertex nor line is skipped, faces with a warning.
StrandSet importObj(const StrandFile& file);

}  // namespace hair::groom
