#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"

// What formats of text have in common: comments, words and numbers, and sentences on what they
// leave out.
namespace hair::groom {

// The comment as lines of a text file, each after `keyword`; nothing for an empty comment.
// Carriage returns, which belong to a line's end, are left out.
std::string commentLines(std::string_view comment, std::string_view keyword);

// What strands may have beside their points.
enum class Part {
    widths,
    transparencies,
    colors,
    root_uvs,
    groups,
    guides,
    root_triangles,
    unit,
    comment
};

// A sentence for each part that the strands have and the format has no place for. To be opaque
// everywhere is not to have transparencies.
std::vector<std::string> leftOut(const StrandSet& strands, std::initializer_list<Part> held);

// Warns where strands were left out: "3 strands with ... are left out".
void warnOfStrands(std::size_t count, const std::string& which, StrandSet& set);

// Lines of text files, word by word. Numbers are spelt in C's notation whatever the locale, a '+'
// before them allowed.

// The lines of a text without their ends, which may be of Unix or of Windows.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {}

    bool atEnd() const { return rest_.empty(); }
    std::size_t number() const { return number_; }  // of the line taken last
    std::size_t bytesLeft() const { return rest_.size(); }
    std::string_view take();  // empty at the end

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

// Takes the next word, up to white space, off the beginning of `line`; empty at its end.
std::string_view takeWord(std::string_view& line);

// The word for a message: in quotes, short, without characters that can't be printed.
std::string inQuotes(std::string_view word);

// The number that the whole word is.
std::optional<std::int64_t> integerFrom(std::string_view word);
std::optional<double> doubleFrom(std::string_view word);  // also "nan" and "inf"

// The nearest float; 0 and infinity for what is too small and too large for one, as long as a
// double holds it.
std::optional<float> floatFrom(std::string_view word);

// The ends of strands of `size` points each.
std::vector<std::uint32_t> uniformEnds(std::uint32_t strands, std::uint32_t size);

// How many points a format wants each strand to have.
struct NumberOfPoints {
    std::uint32_t least;
    std::uint32_t most;
    std::uint32_t wanted;  // of strands that have other numbers
};

// The strands resampled to one number of points, which a warning says; absent where they all have
// one, from `least` to `most`, already.
std::optional<StrandSet> makeUniform(
    const StrandSet& strands, const NumberOfPoints& number, std::vector<std::string>& warnings);

// Whether text is UTF-8, without surrogates and needlessly long forms (RFC 3629).
bool isUtf8(std::string_view text);

// Latin-1 as UTF-8: what files with an 8-bit text of no stated encoding mostly mean.
std::string utf8FromLatin1(std::string_view text);

}  // namespace hair::groom
