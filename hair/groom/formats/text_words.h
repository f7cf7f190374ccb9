#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Lines of text files, word by word. Numbers are spelt in C's notation whatever the locale, a '+'
// before them allowed.
namespace hair {

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

}  // namespace hair
