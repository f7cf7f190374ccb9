#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace benchmarks::scene {

// A regular expression from a user or a file, in RE2's syntax: like ECMAScript, but without back
// references and look-around. Matching takes time linear in the text and bounded memory, whatever
// the input.
class Pattern {
public:
    // Throws engine::Error, without the expression, for an invalid one.
    explicit Pattern(const std::string& regex);

    // Whether it matches anywhere in the text; an empty one matches every text.
    bool isIn(std::string_view text) const;

private:
    std::shared_ptr<const re2::RE2> expression_;  // shared by copies; std::function needs copies
};

}  // namespace benchmarks::scene
