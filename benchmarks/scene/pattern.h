#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace benchmarks::scene {

// A regular expression that a user or a file gives, as RE2 knows them: as in ECMAScript, but for
// references back and looking around. Time is linear in the text and memory bounded, whatever they
// are.
class Pattern {
public:
    // Throws engine::Error, without the expression, for what is none.
    explicit Pattern(const std::string& regex);

    // Whether it is found anywhere in the text; an empty one is in all.
    bool isIn(std::string_view text) const;

private:
    std::shared_ptr<const re2::RE2> expression_;  // of all copies, which std::function asks for
};

}  // namespace benchmarks::scene
