#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Strands of a PLY file (Greg Turk, The PLY Polygon File Format, 1994), ascii or binary of either
// byte order. The points are the element `vertex`: x, y, z and, where present, width or radius,
// red, green, blue, and transparency or alpha. The strands are the first of these that are present:
//   - the lists `vertex_indices` or `vertex_index` of an element `strand`, `polyline` or `line`,
//     root first,
//   - chains of the element `edge` (vertex1, vertex2), see polylines.h,
//   - runs of StrandFile::points_per_strand consecutive vertices, as reconstructions of hair from
//     pictures write,
//   - the lists of two vertices of the element `face`, in which assimp writes lines: edges.
// Everything else is skipped with a warning.
namespace hair::groom {

// A StrandExporter's `write`: little-endian, strands as chains of edges.
std::vector<std::string> exportPly(const StrandSet& strands, std::ostream& out);

// A StrandImporter's `read`.
StrandSet importPly(const StrandFile& file);

// Throws engine::Error "place: reason" if a mesh's file names a vertex that isn't there, has a face
// without corners, is too short, or is no PLY. Readers of meshes don't check the first of these.
void checkPlyFaces(std::span<const std::byte> file);

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64,
};

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type;  // of a list; absent: a single value
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties;

    const PlyProperty* find(std::string_view property) const;
    bool hasLists() const;
    // The least bytes of one element in a binary file; lists count with their lengths alone.
    std::size_t leastSize() const;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;
    std::string comment;  // lines
    std::size_t size = 0;  // bytes
    std::size_t lines = 0;

    const PlyElement* find(std::string_view element) const;
};

// Throws engine::Error "line N: reason".
PlyHeader readPlyHeader(std::string_view file);

}  // namespace hair::groom
