#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// The members of an object in a script. Errors are "<JSON pointer>: <reason>".
class Members {
public:
    // Throws engine::Error for what is no object, or has members that are not among `known`.
    Members(const Json& object, const std::string& pointer, const std::vector<const char*>& known);

    bool has(const char* name) const;
    // Throws engine::Error where it is absent.
    const Json& at(const char* name) const;

    // Absent, or of that type: else they throw engine::Error.
    std::optional<std::string> text(const char* name) const;
    std::optional<bool> flag(const char* name) const;
    std::optional<std::uint32_t> count(const char* name) const;
    std::optional<std::array<float, 2>> pair(const char* name) const;

    std::string pointerOf(const char* name) const;

private:
    const Json& object_;
    std::string pointer_;
};

// The same of values that are no members.
std::string textOf(const Json& value, const std::string& pointer);
bool flagOf(const Json& value, const std::string& pointer);
std::uint32_t countOf(const Json& value, const std::string& pointer);
std::array<float, 2> pairOf(const Json& value, const std::string& pointer);
// One, or an array of them.
std::vector<std::string> textsOf(const Json& value, const std::string& pointer);

}  // namespace benchmarks
