#pragma once

#include <string>
#include <type_traits>

#include "benchmarks/decimal_text.h"

// Elements of a Mitsuba scene, each with its line's end.
namespace benchmarks {

template <class Value>
std::string element(const char* type, const char* name, const Value& value) {
    std::string text;
    if constexpr (std::is_arithmetic_v<Value>) {
        text = decimalText(value);
    } else {
        text = value;
    }
    return std::string("<") + type + " name=\"" + name + "\" value=\"" + text + "\"/>\n";
}

template <class Vector>
std::string rgb(const char* name, const Vector& linear) {
    return element("rgb", name, decimalTexts(linear, ", "));
}

}  // namespace benchmarks
