#pragma once

#include <stdexcept>
#include <string>

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

}  // namespace engine
