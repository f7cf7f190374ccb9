#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include <glm/vec3.hpp>

#include "hair/fields.h"

namespace benchmarks {

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
    hair::forEachField<Owner>([&](const auto& row) {
        if constexpr (requires { row.minimum; }) {
            if constexpr (std::is_same_v<decltype(row.member), Value Owner::*>) {
                if (row.member != member) return;
                if constexpr (std::is_same_v<Value, glm::vec3>)
                    for (int i = 0; i < 3; ++i)
                        value[i] = within(value[i], row.minimum, row.maximum);
                else
                    value = within(value, row.minimum, row.maximum);
            }
        }
    });
    return value;
}

// How many entries the table allows for a list.
template <class Owner, class Element>
std::size_t mostOf(std::vector<Element> Owner::* member) {
    std::size_t most = 0;
    hair::forEachField<Owner>([&](const auto& row) {
        if constexpr (requires { row.maximum_count; }) {
            if constexpr (std::is_same_v<decltype(row.member), std::vector<Element> Owner::*>)
                if (row.member == member) most = row.maximum_count;
        }
    });
    return most;
}

}  // namespace benchmarks
