#include "benchmarks/viewer/script/members.h"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/pointer.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

[[noreturn]] void refuse(const std::string& pointer, const char* wanted, const Json& value) {
    throw engine::Error(pointer, std::string("must be ") + wanted + ", not " + described(value));
}

}  // namespace

Members::Members(
    const Json& object, const std::string& pointer, const std::vector<const char*>& known)
    : object_(object), pointer_(pointer) {
    if (!object.is_object()) refuse(pointer.empty() ? "the whole" : pointer, "an object", object);
    const std::vector<std::string> names(known.begin(), known.end());
    for (const auto& [key, value] : object.items())
        if (std::ranges::find(names, key) == names.end())
            throw engine::Error(
                pointer.empty() ? '/' + escapedToken(key) : pointer,
                unknownName("unknown key", key, names));
}

bool Members::has(const char* name) const { return object_.contains(name); }

const Json& Members::at(const char* name) const {
    if (!has(name))
        throw engine::Error(
            pointer_.empty() ? "/" : pointer_, '"' + std::string(name) + "\" is missing");
    return object_.at(name);
}

std::string Members::pointerOf(const char* name) const { return pointer_ + '/' + name; }

std::optional<std::string> Members::text(const char* name) const {
    if (!has(name)) return std::nullopt;
    return textOf(at(name), pointerOf(name));
}

std::optional<bool> Members::flag(const char* name) const {
    if (!has(name)) return std::nullopt;
    return flagOf(at(name), pointerOf(name));
}

std::optional<std::uint32_t> Members::count(const char* name) const {
    if (!has(name)) return std::nullopt;
    return countOf(at(name), pointerOf(name));
}

std::optional<std::array<float, 2>> Members::pair(const char* name) const {
    if (!has(name)) return std::nullopt;
    return pairOf(at(name), pointerOf(name));
}

std::string textOf(const Json& value, const std::string& pointer) {
    if (!value.is_string()) refuse(pointer, "a string", value);
    return value.get<std::string>();
}

bool flagOf(const Json& value, const std::string& pointer) {
    if (!value.is_boolean()) refuse(pointer, "true or false", value);
    return value.get<bool>();
}

std::uint32_t countOf(const Json& value, const std::string& pointer) {
    const bool counts = value.is_number_unsigned() || (value.is_number_integer() && value >= 0);
    if (!counts || value > std::numeric_limits<std::uint32_t>::max())
        refuse(pointer, "a whole number from 0", value);
    return value.get<std::uint32_t>();
}

std::array<float, 2> pairOf(const Json& value, const std::string& pointer) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
        refuse(pointer, "two numbers, [x, y]", value);
    return {value[0].get<float>(), value[1].get<float>()};
}

std::vector<std::string> textsOf(const Json& value, const std::string& pointer) {
    if (!value.is_array()) return {textOf(value, pointer)};
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < value.size(); ++i)
        texts.push_back(textOf(value[i], pointer + '/' + std::to_string(i)));
    return texts;
}

}  // namespace benchmarks
