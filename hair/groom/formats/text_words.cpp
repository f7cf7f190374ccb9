#include "hair/groom/formats/text_words.h"

#include <charconv>
#include <system_error>

namespace hair {
namespace {

constexpr std::size_t kQuotedLength = 40;

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// std::from_chars takes no '+'; "+-1" stays wrong.
std::string_view withoutPlus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

template <class Number>
std::errc parse(std::string_view word, Number& number) {
    word = withoutPlus(word);
    const char* end = word.data() + word.size();
    const auto [at, error] = std::from_chars(word.data(), end, number);
    return at == end ? error : std::errc::invalid_argument;
}

template <class Number>
std::optional<Number> parsed(std::string_view word) {
    Number number{};
    if (parse(word, number) != std::errc{}) return {};
    return number;
}

}  // namespace

std::string_view takeWord(std::string_view& line) {
    std::size_t start = 0;
    while (start < line.size() && isSpace(line[start])) ++start;
    std::size_t end = start;
    while (end < line.size() && !isSpace(line[end])) ++end;
    const std::string_view word = line.substr(start, end - start);
    line.remove_prefix(end);
    return word;
}

std::string inQuotes(std::string_view word) {
    std::string text = "'";
    for (const char c : word.substr(0, kQuotedLength)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (word.size() > kQuotedLength ? "...'" : "'");
}

std::optional<std::int64_t> integerFrom(std::string_view word) {
    return parsed<std::int64_t>(word);
}

std::optional<double> doubleFrom(std::string_view word) { return parsed<double>(word); }

std::optional<float> floatFrom(std::string_view word) {
    float number = 0.0f;
    const std::errc error = parse(word, number);
    if (error == std::errc{}) return number;
    if (error != std::errc::result_out_of_range) return {};
    const auto wide = doubleFrom(word);
    if (!wide) return {};
    return static_cast<float>(*wide);
}

}  // namespace hair
