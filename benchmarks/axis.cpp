#include "benchmarks/axis.h"

#include <algorithm>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "benchmarks/axis_range.h"
#include "benchmarks/pointer.h"
#include "benchmarks/read_settings.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

std::vector<std::string> splitAtTopLevelCommas(std::string_view text) {
    std::vector<std::string> parts(1);
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (c == ',' && !quoted && depth <= 0) {
            parts.emplace_back();
            continue;
        }
        parts.back() += c;
        if (quoted && c == '\\' && i + 1 < text.size()) parts.back() += text[++i];
    }
    return parts;
}

std::optional<std::vector<Document>> rangeOf(std::string_view argument, const std::string& text) {
    try {
        return rangeValues(text);
    } catch (const engine::Error& error) {
        throw engine::Error("-a " + std::string(argument), error.what());
    }
}

bool isIndex(std::string_view token) {
    return !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string joinedTail(const std::vector<std::string>& tokens, std::size_t count) {
    std::string text;
    for (std::size_t i = tokens.size() - count; i < tokens.size(); ++i)
        text += (text.empty() ? "" : ".") + tokens[i];
    return text;
}

}  // namespace

Document parseValue(const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    if (!value.is_discarded()) return Document(std::move(value));
    // Settings are UTF-8, and a command line need not be.
    return Document(Json::parse(Document(text).text()));
}

Axis parseAxis(std::string_view argument) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string_view::npos || equals == 0)
        throw engine::Error(
            "-a " + std::string(argument), "expected POINTER=V1,V2, as in /strands/density=16,64");
    Axis axis{.pointer = std::string(argument.substr(0, equals)), .values = {}, .tied = {}};
    for (const std::string& text : splitAtTopLevelCommas(argument.substr(equals + 1))) {
        if (text.empty()) throw engine::Error("-a " + std::string(argument), "a value is empty");
        if (const auto values = rangeOf(argument, text)) {
            axis.values.insert(axis.values.end(), values->begin(), values->end());
            continue;
        }
        axis.values.push_back(parseValue(text));
    }
    return axis;
}

Axis echoedAxis(const Axis& axis, const Json& resolved) {
    if (axis.values.empty()) throw engine::Error(axis.pointer, "an axis needs at least one value");
    Axis echoed{.pointer = axis.pointer, .values = {}, .tied = {}};
    for (const Document& value : axis.values) {
        Json document = resolved;
        patch(document, axis.pointer, value.json());
        Json echo = writeSettings(readSettings(document));
        echoed.values.push_back(
            value.json().is_object() ? value : Document(std::move(valueAt(echo, axis.pointer))));
    }
    return echoed;
}

Axis checkedAxis(const Axis& axis, const Json& resolved) {
    Axis echoed = echoedAxis(axis, resolved);
    std::set<std::string> texts;
    for (const Document& value : echoed.values)
        if (!texts.insert(value.text()).second)
            throw engine::Error(axis.pointer, valueLabel(value.json()) + " is there twice");
    return echoed;
}

std::vector<std::string> axisLabels(const std::vector<std::string>& pointers) {
    std::vector<std::vector<std::string>> tokens;
    for (const std::string& pointer : pointers) tokens.push_back(pointerTokens(pointer));
    std::vector<std::string> labels;
    for (const auto& mine : tokens) {
        std::size_t count = isIndex(mine.back()) && mine.size() > 1 ? 2 : 1;
        const auto shared = [&](const auto& other) {
            return &other != &mine && other.size() >= count &&
                   std::equal(
                       mine.end() - static_cast<std::ptrdiff_t>(count), mine.end(),
                       other.end() - static_cast<std::ptrdiff_t>(count));
        };
        while (count < mine.size() && std::ranges::any_of(tokens, shared)) ++count;
        labels.push_back(joinedTail(mine, count));
    }
    return labels;
}

std::string valueLabel(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace benchmarks
