#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hair {

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

std::size_t sizeOf(PlyType type);  // bytes
bool isInteger(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties;

    const PlyProperty* find(std::string_view property) const;
    bool hasLists() const;
    // The bytes of one in a binary file; of its lists only what says how long they are.
    std::size_t leastSize() const;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;
    std::string comment;    // lines
    std::size_t size = 0;   // bytes
    std::size_t lines = 0;

    const PlyElement* find(std::string_view element) const;
};

// Throws engine::Error "line N: reason".
PlyHeader readPlyHeader(std::string_view file);

}  // namespace hair
