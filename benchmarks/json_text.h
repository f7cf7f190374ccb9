#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

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

}  // namespace benchmarks
