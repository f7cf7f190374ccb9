#include "benchmarks/scene/json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <charconv>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace benchmarks::scene {

// ---- Unknown names ------------------------------------------------------------------------------

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);  // row[j]: from the part of a read so far to b[0,
                                                 // j)
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i] == b[j] ? 0u : 1u);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

std::string
unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& known) {
    // Limits of the message's length, in bytes.
    constexpr std::size_t kLongestName = 64;
    constexpr std::size_t kLongestList = 1000;
    std::string text(what);
    const auto distance = [&](const std::string& other) { return editDistance(name, other); };
    if (name.size() <= kLongestName) {
        const auto nearest = std::ranges::min_element(known, {}, distance);
        if (nearest != known.end() &&
            2 * distance(*nearest) <= std::max(name.size(), nearest->size()))
            text += " (did you mean '" + *nearest + "'?)";
    }
    text += "; known: ";
    const std::size_t start = text.size();
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (text.size() - start + known[i].size() > kLongestList)
            return text + " and " + std::to_string(known.size() - i) + " more";
        text += (i == 0 ? "" : ", ") + known[i];
    }
    return text;
}

namespace {

// ---- JSON pointers ------------------------------------------------------------------------------

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

Json& member(Json& owner, const std::string& token, const std::string& here) {
    if (owner.is_object()) {
        if (const auto found = owner.find(token); found != owner.end()) return *found;
        std::vector<std::string> known;
        for (const auto& [key, value] : owner.items()) known.push_back(key);
        throw engine::Error(here, unknownName("unknown key", token, known));
    }
    if (owner.is_array()) return owner[elementNamed(token, owner.size(), here)];
    throw engine::Error(here, described(owner) + " has no members");
}

}  // namespace

std::size_t elementNamed(const std::string& token, std::size_t size, const std::string& here) {
    std::size_t index = 0;
    const char* const end = token.data() + token.size();
    const auto [rest, error] = std::from_chars(token.data(), end, index);
    const bool is_index =
        error == std::errc{} && rest == end && (token.size() == 1 || token[0] != '0');
    if (!is_index || index >= size)
        throw engine::Error(
            here, "the array has " + std::to_string(size) + (size == 1 ? " element" : " elements"));
    return index;
}

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
            '\'' + std::string(pointer) + '\'',
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

std::string described(const Json& value) {
    constexpr std::size_t kLongest = 40;  // longer strings are shortened, bytes
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const bool cut = value.is_string() && value.get_ref<const std::string&>().size() > kLongest;
    const Json shown =
        cut ? Json(value.get_ref<const std::string&>().substr(0, kLongest) + "...") : value;
    const std::string text = shown.dump(-1, ' ', false, Json::error_handler_t::replace);
    return value.is_string() ? "the string " + text : text;
}

namespace {

// ---- Documents and parsing ----------------------------------------------------------------------

constexpr std::size_t kDeepest = 64;
// The limit matters because members are searched one by one.
constexpr std::size_t kMostMembers = 4096;
constexpr std::size_t kLongestKey = 512;  // bytes

// Returns "file:line:column", both counted from 1. `position` is the number of bytes read.
std::string placeName(std::string_view text, std::size_t position, const std::string& name) {
    const std::size_t last = std::min(position, text.size() + 1) - (position > 0 ? 1 : 0);
    const std::string_view before = text.substr(0, last);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t column = last - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    return name + ':' + std::to_string(line) + ':' + std::to_string(column);
}

// "[json.exception.parse_error.101] parse error at line 1, column 2: reason" -> "reason"
std::string reasonOf(std::string text) {
    if (const auto code_end = text.find("] "); code_end != std::string::npos)
        text.erase(0, code_end + 2);
    if (text.starts_with("parse error"))
        if (const auto place_end = text.find(": "); place_end != std::string::npos)
            text.erase(0, place_end + 2);
    return text;
}

std::string withArticle(std::string_view type) {
    if (type == "null") return "null";
    return (type.starts_with('a') || type.starts_with('o') ? "an " : "a ") + std::string(type);
}

// Builds the document from parsing events, because nlohmann's own parser silently keeps the last of
// duplicate keys.
class Builder : public nlohmann::json_sax<Json> {
public:
    Builder(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }  // not in JSON text
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& key) override {
        if (key.size() > kLongestKey)
            throw engine::Error(
                name_, "a name has " + std::to_string(key.size()) + " bytes; at most " +
                           std::to_string(kLongestKey) + " are permitted");
        levels_.back().key = key;
        if (levels_.back().value.size() >= kMostMembers)
            throw engine::Error(
                name_ + ": " + pointer(),
                "the object has more than " + std::to_string(kMostMembers) + " members");
        if (levels_.back().value.contains(key))
            throw engine::Error(name_ + ": " + pointer(), "appears twice");
        return true;
    }

    bool parse_error(
        std::size_t position, const std::string&,
        const nlohmann::detail::exception& error) override {
        throw engine::Error(placeName(text_, position, name_), reasonOf(error.what()));
    }

    Json take() { return std::move(document_); }

private:
    struct Level {
        Json value;
        std::string key;  // key of the member being read, in an object
    };

    std::string pointer() const {
        std::string text;
        for (const Level& level : levels_)
            text += '/' + (level.value.is_array() ? std::to_string(level.value.size())
                                                  : escapedToken(level.key));
        return text;
    }

    bool add(Json value) {
        if (levels_.empty())
            document_ = std::move(value);
        else if (levels_.back().value.is_array())
            levels_.back().value.push_back(std::move(value));
        else
            levels_.back().value.emplace(levels_.back().key, std::move(value));
        return true;
    }

    bool open(Json value) {
        if (levels_.size() == kDeepest)
            throw engine::Error(
                name_, "is nested deeper than " + std::to_string(kDeepest) + " levels");
        levels_.push_back({std::move(value), {}});
        return true;
    }

    bool close() {
        Json value = std::move(levels_.back().value);
        levels_.pop_back();
        return add(std::move(value));
    }

    std::string_view text_;
    const std::string& name_;
    Json document_;
    std::vector<Level> levels_;  // open objects and arrays, outermost first
};

}  // namespace

Document::Document() = default;
Document::Document(Json value) : value_(std::make_unique<const Json>(std::move(value))) {}
Document::Document(const Document& other)
    : value_(other.value_ ? std::make_unique<const Json>(*other.value_) : nullptr) {}
Document::Document(Document&& other) noexcept = default;
Document& Document::operator=(const Document& other) { return *this = Document(other); }
Document& Document::operator=(Document&& other) noexcept = default;
Document::~Document() = default;

const Json& Document::json() const {
    static const Json null;
    return value_ ? *value_ : null;
}

std::string Document::text() const {
    return json().dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool sameText(const Json& a, const Json& b) {
    const auto isSmall = [](const Json& each) { return each.get<std::int64_t>() >= 0; };
    if (a.type() != b.type())  // == would convert an unsigned integer to a signed one
        return a.is_number_integer() && b.is_number_integer() && isSmall(a) && isSmall(b) && a == b;
    switch (a.type()) {
    case Json::value_t::number_float: {
        const auto x = a.get<double>(), y = b.get<double>();
        return x == y ? std::signbit(x) == std::signbit(y)
                      : !std::isfinite(x) && !std::isfinite(y);  // all written as "null"
    }
    case Json::value_t::array:
        return std::ranges::equal(a, b, sameText);
    case Json::value_t::object:
        return std::ranges::equal(
            a.get_ref<const Json::object_t&>(), b.get_ref<const Json::object_t&>(),
            [](const auto& x, const auto& y) {
                return x.first == y.first && sameText(x.second, y.second);
            });
    default:
        return a == b;
    }
}

bool operator==(const Document& a, const Document& b) { return sameText(a.json(), b.json()); }

std::size_t valueCount(const Json& document) {
    std::size_t count = 1;
    if (document.is_structured())
        for (const Json& each : document) count += valueCount(each);
    return count;
}

std::string jsonReason(const std::exception& error) {
    const std::string text = reasonOf(error.what());
    const std::string_view all = text;
    // "type must be number, but is string"
    constexpr std::string_view kWanted = "type must be ", kFound = ", but is ";
    if (const std::size_t found = all.find(kFound);
        all.starts_with(kWanted) && found != std::string_view::npos)
        return "expected " + withArticle(all.substr(kWanted.size(), found - kWanted.size())) +
               ", found " + withArticle(all.substr(found + kFound.size()));
    // "key 'name' not found"
    constexpr std::string_view kKey = "key ", kMissing = " not found";
    if (all.starts_with(kKey) && all.ends_with(kMissing))
        return std::string(all.substr(kKey.size(), all.size() - kKey.size() - kMissing.size())) +
               " is missing";
    // "cannot use at() with number"
    constexpr std::string_view kWith = " with ";
    if (const std::size_t with = all.rfind(kWith);
        all.starts_with("cannot use ") && with != std::string_view::npos)
        return "expected an object or an array, found " +
               withArticle(all.substr(with + kWith.size()));
    return text;
}

Json parseJson(std::string_view text, const std::string& name) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw engine::Error(name, "is empty; a scene is at least {}");
    Builder builder(text, name);
    Json::sax_parse(text, &builder);
    return builder.take();
}

std::string textAt(const Json& document, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!document.contains(place)) return {};
    const Json& value = document.at(place);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace benchmarks::scene
