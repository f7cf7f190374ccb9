#pragma once

#include <stdexcept>
#include <string>

namespace engine {

// What went wrong with something the user gave us or the device offers: a file, a scene, a driver.
// Each layer adds its context once, outermost first: "scenes/a.json: /strands/density: 0 is outside
// [1, 4096] count". Our own bugs are asserts.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    Error(const std::string& context, const std::string& reason)
        : std::runtime_error(context + ": " + reason) {}
};

// The device lacks something that a case asks for: the case is skipped, the sweep goes on.
class Unsupported : public Error {
public:
    using Error::Error;
};

}  // namespace engine
