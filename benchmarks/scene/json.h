#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

// JSON documents, JSON pointers and errors about names.
namespace benchmarks::scene {

// Members keep the order in which they were written: reports and sweeps are read by people.
using Json = nlohmann::ordered_json;

// A JSON value that others own: a scene, the value of an axis, what a report quotes. Headers that
// hold one need not know how JSON is made. Copies are deep; a default one, and one that was moved
// from, is null.
class Document {
public:
    Document();
    explicit Document(Json value);
    Document(const Document& other);
    Document(Document&& other) noexcept;
    Document& operator=(const Document& other);
    Document& operator=(Document&& other) noexcept;
    ~Document();

    const Json& json() const;
    // Compact, with members in the order in which they were written; bytes that are not UTF-8 are
    // U+FFFD there.
    std::string text() const;

private:
    std::unique_ptr<const Json> value_;  // absent: null
};

// Whether their texts are the same: 1 differs from 1.0, and the order of members counts.
bool operator==(const Document& a, const Document& b);

// Parses one JSON document. `name` is what the text is called in errors, usually its file:
//   scene.json:3:17: syntax error while parsing value - unexpected '}'; ...
//   scene.json: /strands/density: is there twice
// Stricter than JSON: a member written twice and nesting deeper than 64 are errors. No comments.
Json parseJson(std::string_view text, const std::string& name);

// Insertions, deletions and substitutions that turn `a` into `b` (Levenshtein 1966), in bytes.
std::size_t editDistance(std::string_view a, std::string_view b);

// What to say of a name that is not among `known`, without its final stop:
//   unknown key (did you mean "density"?); known: backend, density
// `what` is the beginning, here "unknown key". The nearest name is suggested if it shares at least
// half.
std::string
unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& known);

// JSON pointers (RFC 6901) into a document that holds every field.

// One token as it stands in a pointer: ~ and / are escaped, control characters are shown as '?' so
// that an error stays one line.
std::string escapedToken(std::string_view token);

// "/lod/level" -> {"lod", "level"}. Throws engine::Error if the text is no JSON pointer or is the
// whole document's ("").
std::vector<std::string> pointerTokens(std::string_view pointer);

// The value that the pointer names. An absent one is an engine::Error at the first token that is
// unknown.
Json& valueAt(Json& document, std::string_view pointer);

// Puts a value where the pointer leads, which must exist. An object is merged (RFC 7386) into the
// object that is there, so that members it does not name stay as they are.
void patch(Json& document, std::string_view pointer, const Json& value);

// The type with its article, for errors: "an array", "the string \"x\"", "3".
std::string described(const Json& value);

// The value at a JSON pointer as text, a string without its quotes; empty where it is absent.
std::string textAt(const Json& document, const char* pointer);

// The shortest decimal that reads back as the same float, whatever the locale.
inline std::string decimalText(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value));
    return {text.data(), end.ptr};
}

// The coordinates of a glm vector, with `separator` between them.
template <class Vector>
std::string decimalTexts(const Vector& values, const char* separator) {
    std::string text = decimalText(values[0]);
    for (int i = 1; i < Vector::length(); ++i) text += separator + decimalText(values[i]);
    return text;
}

}  // namespace benchmarks::scene
