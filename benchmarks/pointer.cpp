#include "benchmarks/pointer.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

std::string unescaped(std::string_view token, std::string_view pointer) {
    std::string text;
    for (std::size_t i = 0; i < token.size(); ++i) {
        if (token[i] != '~') {
            text += token[i];
        } else if (i + 1 < token.size() && (token[i + 1] == '0' || token[i + 1] == '1')) {
            text += token[++i] == '0' ? '~' : '/';
        } else {
            throw engine::Error(
                std::string(pointer), "'~' must be written ~0, and '/' in a name ~1");
        }
    }
    return text;
}

std::optional<std::size_t> arrayIndex(const std::string& token) {
    std::size_t index = 0;
    const char* const end = token.data() + token.size();
    const auto [rest, error] = std::from_chars(token.data(), end, index);
    if (error != std::errc{} || rest != end || (token.size() > 1 && token[0] == '0')) return {};
    return index;
}

std::string lengthOf(const Json& array) {
    return std::to_string(array.size()) + (array.size() == 1 ? " element" : " elements");
}

Json& member(Json& owner, const std::string& token, const std::string& here) {
    if (owner.is_object()) {
        if (const auto found = owner.find(token); found != owner.end()) return *found;
        std::vector<std::string> known;
        for (const auto& [key, value] : owner.items()) known.push_back(key);
        throw engine::Error(here, unknownName("unknown key", token, known));
    }
    if (owner.is_array()) {
        if (const auto index = arrayIndex(token); index && *index < owner.size())
            return owner[*index];
        throw engine::Error(here, "the array has " + lengthOf(owner));
    }
    throw engine::Error(here, described(owner) + " has no members");
}

}  // namespace

std::string escapedToken(std::string_view token) {
    std::string text;
    for (const char c : token) {
        if (c == '~')
            text += "~0";
        else if (c == '/')
            text += "~1";
        else
            text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return text;
}

std::vector<std::string> pointerTokens(std::string_view pointer) {
    if (!pointer.starts_with('/'))
        throw engine::Error(
            '"' + std::string(pointer) + '"',
            "a JSON pointer starts with '/', as in /strands/density");
    std::vector<std::string> tokens;
    for (std::size_t begin = 1; begin <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
        tokens.push_back(unescaped(pointer.substr(begin, end - begin), pointer));
        begin = end + 1;
    }
    if (tokens.empty()) tokens.emplace_back();  // "/" names the member whose name is empty
    return tokens;
}

Json& valueAt(Json& document, std::string_view pointer) {
    Json* value = &document;
    std::string here;
    for (const std::string& token : pointerTokens(pointer)) {
        here += '/' + escapedToken(token);
        value = &member(*value, token, here);
    }
    return *value;
}

void patch(Json& document, std::string_view pointer, const Json& value) {
    Json& target = valueAt(document, pointer);
    if (target.is_object() && value.is_object())
        target.merge_patch(value);
    else
        target = value;
}

std::string described(const Json& value) {
    constexpr std::size_t kLongest = 40;  // bytes of a string that are worth showing
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const bool cut = value.is_string() && value.get_ref<const std::string&>().size() > kLongest;
    const Json shown =
        cut ? Json(value.get_ref<const std::string&>().substr(0, kLongest) + "...") : value;
    const std::string text = shown.dump(-1, ' ', false, Json::error_handler_t::replace);
    return value.is_string() ? "the string " + text : text;
}

}  // namespace benchmarks
