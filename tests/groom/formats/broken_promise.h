#pragma once

#include <cmath>
#include <string>

#include "hair/groom/groom.h"

namespace hair::groom {

inline bool isFinite(float x) { return std::isfinite(x); }
template <class Vector>
bool isFinite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

template <class Value>
bool isRight(const PointAttribute<Value>& attribute, std::size_t points) {
    if (attribute.everywhere && !isFinite(*attribute.everywhere)) return false;
    for (const Value& value : attribute.values)
        if (!isFinite(value)) return false;
    return attribute.values.empty() || attribute.values.size() == points;
}

// The first promise of groom.h that this set breaks; empty if it keeps all of them. The function
// uses no test library, so that the fuzzers can use it.
inline std::string brokenPromise(const StrandSet& set) {
    std::uint32_t end = 0;
    for (const std::uint32_t next : set.ends) {
        if (next <= end) return "ends ascend";
        end = next;
    }
    if (end != set.points.size()) return "the last end is the number of points";
    for (const glm::vec3& point : set.points)
        if (!isFinite(point)) return "points are finite";
    if (!isRight(set.widths, end)) return "widths are finite, one for each point";
    if (!isRight(set.transparencies, end)) return "transparencies are finite, one for each point";
    if (!isRight(set.colors, end)) return "colours are finite, one for each point";
    if (!set.root_uvs.empty() && set.root_uvs.size() != set.ends.size())
        return "there is a texture coordinate for each strand";
    if (!set.groups.empty() && set.groups.size() != set.ends.size())
        return "there is a group for each strand";
    if (!set.guides.empty() && set.guides.size() != set.ends.size())
        return "it is said of each strand whether it is a guide";
    for (const std::uint8_t guide : set.guides)
        if (guide > 1) return "a strand is a guide or not";
    for (const glm::vec2& uv : set.root_uvs)
        if (!isFinite(uv)) return "texture coordinates are finite";
    for (const auto& triangle : set.root_triangles)
        for (const std::uint32_t strand : triangle)
            if (strand >= set.ends.size()) return "root triangles name strands";
    const double unit = set.metres_per_unit.value_or(1.0);
    if (!(unit > 0.0) || std::isinf(unit)) return "a unit has a length";
    return "";
}

}  // namespace hair::groom
