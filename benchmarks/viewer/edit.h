#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"

// A change of settings by widgets or the mouse, and the values that the settings' tables allow.
namespace benchmarks::viewer {

// What widgets or the mouse did to settings in one frame of the window.
struct Edit {
    bool changed = false;    // the settings have other values now
    bool continues = false;  // something is being dragged, and goes on changing them

    Edit& operator|=(const Edit& other) {
        changed |= other.changed;
        continues |= other.continues;
        return *this;
    }
};

inline float within(float value, double minimum, double maximum) {
    float inside = static_cast<float>(std::fmin(std::fmax(double{value}, minimum), maximum));
    // The nearest float to a limit can be beyond it.
    if (double{inside} < minimum) inside = std::nextafter(inside, 1e30f);
    if (double{inside} > maximum) inside = std::nextafter(inside, -1e30f);
    return inside;
}

// The value that is nearest to `value` among those that the table of `Owner` allows for a member.
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

// How many elements the table of `Owner` allows in a list.
template <class Owner, class Element>
std::size_t mostOf(std::vector<Element> Owner::* member) {
    const Owner owner;
    return std::get<hair::List>(hair::fieldAt(owner, &(owner.*member)).kind).maximum_count;
}

}  // namespace benchmarks::viewer
