#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

// JSON documents, JSON pointers and errors about names.
namespace benchmarks::scene {

// Members keep their written order, because people read reports and sweeps.
using Json = nlohmann::ordered_json;

// Owns a JSON value, such as a scene, the value of an axis or part of a report, so that headers
// need not include nlohmann's. Copies are deep. A default or moved-from document is null.
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
    // Returns compact text with members in their written order. Replaces bytes that are not UTF-8
    // by U+FFFD.
    std::string text() const;

private:
    std::unique_ptr<const Json> value_;  // absent: JSON null
};

// Whether both have the same text, without writing it: 1 differs from 1.0 and 0.0 from -0.0, and
// the order of members counts.
bool sameText(const Json& a, const Json& b);
bool operator==(const Document& a, const Document& b);  // sameText()

// Returns the number of values in the document, including objects and arrays.
std::size_t valueCount(const Json& document);

// Parses one JSON document. Errors call the text `name`, usually its file:
//   scene.json:3:17: syntax error while parsing value - unexpected '}'; ...
//   scene.json: /strands/density: appears twice
// Stricter than JSON: duplicate members and nesting deeper than 64 are errors. No comments.
Json parseJson(std::string_view text, const std::string& name);

// Returns the reason of an exception of the JSON library in our words:
//   expected a number, found a string
std::string jsonReason(const std::exception& error);

// Returns the number of insertions, deletions and substitutions that turn `a` into `b` (Levenshtein
// 1966), in bytes.
std::size_t editDistance(std::string_view a, std::string_view b);

// Returns an error text about a name that is not among `known`, without a final full stop:
//   unknown key (did you mean 'density'?); known: backend, density
// `what` is the beginning, here "unknown key". Suggests the nearest name if the edit distance is at
// most half the length of the longer name.
std::string
unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& known);

// JSON pointers (RFC 6901) into a document that holds every field.

// Returns one token as written in a pointer: ~ and / are escaped, and control characters become '?'
// so that an error stays on one line.
std::string escapedToken(std::string_view token);

// "/lod/level" -> {"lod", "level"}. Throws engine::Error if the text is not a JSON pointer or is
// empty, which would be the whole document.
std::vector<std::string> pointerTokens(std::string_view pointer);

// Returns the value that the pointer names. If it is absent, throws engine::Error at the first
// unknown token.
Json& valueAt(Json& document, std::string_view pointer);

// Returns the index that a token of a pointer names in an array with `size` elements. Otherwise
// throws engine::Error; `here` is the pointer up to the token.
std::size_t elementNamed(const std::string& token, std::size_t size, const std::string& here);

// Returns the type with its article, for errors: "an array of 3", "the string \"x\"", "3".
std::string described(const Json& value);

// Returns the value at a JSON pointer as text, a string without its quotes; empty if it is absent.
std::string textAt(const Json& document, const char* pointer);

// Returns the shortest decimal that reads back as the same float, in any locale.
inline std::string decimalText(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value));
    return {text.data(), end.ptr};
}

// Returns the coordinates of a glm vector with `separator` between them.
template <class Vector>
std::string decimalTexts(const Vector& values, const char* separator) {
    std::string text = decimalText(values[0]);
    for (int i = 1; i < Vector::length(); ++i) text += separator + decimalText(values[i]);
    return text;
}

}  // namespace benchmarks::scene
