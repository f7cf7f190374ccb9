#include "benchmarks/viewer/files/readable_json.h"

#include <nlohmann/json.hpp>

namespace benchmarks {

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 2;

std::string keyText(const std::string& key) { return Json(key).dump() + ": "; }

std::string onOneLine(const Json& value) {
    if (!value.is_structured() || value.empty()) return value.dump();
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (!text.empty()) text += ", ";
        if (value.is_object()) text += keyText(key);
        text += onOneLine(member);
    }
    return value.is_object() ? "{ " + text + " }" : '[' + text + ']';
}

std::string onLines(const Json& value, std::size_t indent);

// `column` is where the text begins.
std::string text(const Json& value, std::size_t indent, std::size_t column) {
    std::string line = onOneLine(value);
    constexpr std::size_t kComma = 1;
    if (!value.is_structured() || value.empty() || column + line.size() + kComma <= kColumns)
        return line;
    return onLines(value, indent);
}

std::string onLines(const Json& value, std::size_t indent) {
    const std::string margin(indent + kIndent, ' ');
    std::string lines;
    for (const auto& [key, member] : value.items()) {
        if (!lines.empty()) lines += ',';
        const std::string name = value.is_object() ? keyText(key) : "";
        lines += '\n' + margin + name;
        lines += text(member, indent + kIndent, margin.size() + name.size());
    }
    lines += '\n' + std::string(indent, ' ');
    return value.is_object() ? '{' + lines + '}' : '[' + lines + ']';
}

}  // namespace

std::string readableJson(const Json& document) {
    const bool lines = document.is_structured() && !document.empty();
    return (lines ? onLines(document, 0) : document.dump()) + '\n';
}

}  // namespace benchmarks
