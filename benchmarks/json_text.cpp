#include "benchmarks/json_text.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/pointer.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

constexpr std::size_t kDeepest = 64;

// "file:line:column", both counted from 1; `position` is the number of bytes read.
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

// Builds the document from parsing events; nlohmann's own parser keeps the last of duplicate keys
// silently.
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
        levels_.back().key = key;
        if (levels_.back().value.contains(key))
            throw engine::Error(name_ + ": " + pointer(), "is there twice");
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
        std::string key;  // of the member being read, in an object
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
            throw engine::Error(name_, "nested deeper than " + std::to_string(kDeepest));
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
    std::vector<Level> levels_;  // what is open, outermost first
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

bool operator==(const Document& a, const Document& b) { return a.text() == b.text(); }

Json parseJson(std::string_view text, const std::string& name) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw engine::Error(name, "is empty; a scene is at least {}");
    Builder builder(text, name);
    Json::sax_parse(text, &builder);
    return builder.take();
}

}  // namespace benchmarks
