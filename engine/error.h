#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace engine {

// A fault of the user's input or of the device: a file, a scene, a driver. Each layer adds its
// context once, outermost first: "scenes/a.json: /strands/density: 0 is outside [1, 4096] count".
// Our own bugs are asserts.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    Error(const std::string& context, const std::string& reason)
        : std::runtime_error(context + ": " + reason) {}
};

// The device lacks a feature that a case needs. The case is skipped and the sweep continues.
class Unsupported : public Error {
public:
    using Error::Error;
};

// Text from files, names and other programs, made safe for a terminal.

// Returns the text as one line without effects on a terminal. Control characters, invisible
// characters, characters that change the writing direction and invalid UTF-8 become '?'; line
// breaks and tabs become spaces. If the result is longer than `longest` bytes, " [...] " replaces
// its middle.
std::string
shownText(std::string_view text, std::size_t longest = std::numeric_limits<std::size_t>::max());

}  // namespace engine
