#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"

// Changes of settings by widgets or the mouse, limited to values that the settings' tables allow.
namespace benchmarks::viewer {

// The effect of widgets or the mouse on settings in one frame of the window.
struct Edit {
    bool changed = false;  // some settings changed
    bool continues = false;  // a drag is in progress and may change more

    Edit& operator|=(const Edit& other) {
        changed |= other.changed;
        continues |= other.continues;
        return *this;
    }
};

inline float within(float value, double minimum, double maximum) {
    float inside = static_cast<float>(std::fmin(std::fmax(double{value}, minimum), maximum));
    // Rounding to float can exceed a limit.
    if (double{inside} < minimum) inside = std::nextafter(inside, 1e30f);
    if (double{inside} > maximum) inside = std::nextafter(inside, -1e30f);
    return inside;
}

// Returns the nearest value that the table of `Owner` allows for a member.
template <class Owner, class Value>
Value allowed(Value Owner::* member, Value value) {
    const Owner owner;
    const hair::Field& field = hair::fieldAt(owner, &(owner.*member));
    const hair::Range& range = std::get<hair::Number<Value>>(field.kind);
    if constexpr (std::is_same_v<Value, glm::vec3>)
        for (int i = 0; i < 3; ++i) value[i] = within(value[i], range.minimum, range.maximum);
    else
        value = within(value, range.minimum, range.maximum);
    return value;
}

// Returns the maximum number of elements of a list in the table of `Owner`.
template <class Owner, class Element>
std::size_t mostOf(std::vector<Element> Owner::* member) {
    const Owner owner;
    return std::get<hair::List>(hair::fieldAt(owner, &(owner.*member)).kind).maximum_count;
}

}  // namespace benchmarks::viewer
