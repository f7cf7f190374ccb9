#include "hair/groom/formats/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "engine/error.h"

namespace hair::groom {
namespace {

struct Row {
    Part part;
    std::string_view sentence;
    bool (*has)(const StrandSet& strands);
};

constexpr Row kRows[] = {
    {Part::widths, "the widths are left out", [](const StrandSet& s) { return s.widths.known(); }},
    {Part::transparencies, "the transparencies are left out",
     [](const StrandSet& s) {
         return !s.transparencies.values.empty() || s.transparencies.everywhere.value_or(0.0f) != 0;
     }},
    {Part::colors, "the colours are left out", [](const StrandSet& s) { return s.colors.known(); }},
    {Part::root_uvs, "the texture coordinates of the roots are left out",
     [](const StrandSet& s) { return !s.root_uvs.empty(); }},
    {Part::groups, "the groups that strands belong to are left out",
     [](const StrandSet& s) { return !s.groups.empty(); }},
    {Part::guides, "the marks of guides are left out",
     [](const StrandSet& s) { return !s.guides.empty(); }},
    {Part::root_triangles, "the root triangles are left out",
     [](const StrandSet& s) { return !s.root_triangles.empty(); }},
    {Part::unit, "the unit of length is left out",
     [](const StrandSet& s) { return s.metres_per_unit.has_value(); }},
    {Part::comment, "the comment is left out",
     [](const StrandSet& s) { return !s.comment.empty(); }},
};

constexpr std::size_t kQuotedLength = 40;

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// std::from_chars takes no '+'; "+-1" stays invalid.
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

// ---- Comments -----------------------------------------------------------------------------------

std::string commentLines(std::string_view comment, std::string_view keyword) {
    if (comment.empty()) return {};
    std::string lines(keyword);
    for (const char c : comment) {
        if (c == '\r') continue;
        lines += c;
        if (c == '\n') lines += keyword;
    }
    return lines + '\n';
}

// ---- Parts that a format leaves out -------------------------------------------------------------

std::vector<std::string> leftOut(const StrandSet& strands, std::initializer_list<Part> held) {
    std::vector<std::string> warnings;
    for (const Row& row : kRows)
        if (std::ranges::find(held, row.part) == held.end() && row.has(strands))
            warnings.emplace_back(row.sentence);
    return warnings;
}

void warnOfStrands(std::size_t count, const std::string& which, StrandSet& set) {
    if (count == 0) return;
    set.warnings.push_back(
        std::to_string(count) + (count == 1 ? " strand " : " strands ") + which +
        (count == 1 ? " is left out" : " are left out"));
}

// ---- Parts that only some strands have ----------------------------------------------------------

namespace {

std::size_t countIn(std::span<const PointRange> ranges) {
    std::size_t count = 0;
    for (const PointRange& range : ranges) count += range.count;
    return count;
}

template <class Value>
void fill(std::vector<Value>& values, std::span<const PointRange> ranges, const Value& value) {
    for (const PointRange& range : ranges)
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(range.first), range.count, value);
}

void warnOfFilled(
    StrandSet& set, std::span<const PointRange> without, const char* element, const char* part,
    const std::string& filled) {
    set.warnings.push_back(
        std::to_string(countIn(without)) + " of " +
        std::to_string(
            std::string_view(element) == "strands" ? set.ends.size() : set.points.size()) +
        ' ' + element + " have no " + part + " and " + filled);
}

}  // namespace

void completeWidths(StrandSet& set, std::span<const PointRange> without) {
    if (without.empty()) return;
    std::vector<float>& widths = set.widths.values;
    fill(widths, without, 0.0f);  // so that the sum is that of the others
    double sum = 0.0;
    for (const float width : widths) sum += std::isfinite(width) ? width : 0.0;
    const double mean = sum / static_cast<double>(widths.size() - countIn(without));
    fill(widths, without, static_cast<float>(mean));
    warnOfFilled(set, without, "points", "width", "get the mean width of the others");
}

void completeTransparencies(StrandSet& set, std::span<const PointRange> without) {
    if (without.empty()) return;
    fill(set.transparencies.values, without, 0.0f);
    warnOfFilled(set, without, "points", "transparency", "become opaque");
}

void completeColors(StrandSet& set, std::span<const PointRange> without) {
    if (without.empty()) return;
    fill(set.colors.values, without, glm::vec3(1.0f));
    warnOfFilled(set, without, "points", "colour", "become white");
}

void completeGroups(StrandSet& set, std::span<const StrandRange> without) {
    if (without.empty()) return;
    std::vector<bool> is_without(set.groups.size());
    for (const StrandRange& range : without)
        std::fill_n(
            is_without.begin() + static_cast<std::ptrdiff_t>(range.first), range.count, true);
    std::int32_t greatest = -1;
    for (std::size_t i = 0; i < set.groups.size(); ++i)
        if (!is_without[i]) greatest = std::max(greatest, set.groups[i]);
    const std::int32_t group =
        greatest == std::numeric_limits<std::int32_t>::max() ? -1 : greatest + 1;
    fill(set.groups, without, group);
    warnOfFilled(set, without, "strands", "group", "become group " + std::to_string(group));
}

// ---- Words --------------------------------------------------------------------------------------

std::string_view TextLines::take() {
    ++number_;
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

void failAtLine(std::size_t line, const std::string& reason) {
    throw engine::Error("line " + std::to_string(line), reason);
}

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

// ---- Strands of one size ------------------------------------------------------------------------

std::vector<std::uint32_t> uniformEnds(std::uint32_t strands, std::uint32_t size) {
    std::vector<std::uint32_t> ends(strands);
    for (std::uint32_t i = 0; i < strands; ++i) ends[i] = (i + 1) * size;
    return ends;
}

std::optional<StrandSet> makeUniform(
    const StrandSet& strands, const NumberOfPoints& number, std::vector<std::string>& warnings) {
    const auto size = commonSize(strands);
    if (size && *size >= number.least && *size <= number.most) return {};
    const std::string before =
        size ? std::to_string(*size) + " points" : std::string("differing numbers of points");
    warnings.push_back(
        "the strands have " + before + " and are resampled to " + std::to_string(number.wanted) +
        " each");
    return resample(strands, number.wanted);
}

// ---- UTF-8 --------------------------------------------------------------------------------------

bool isUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i++]);
        if (byte < 0x80) continue;
        const int more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
        constexpr std::uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
        if (byte < 0xc0 || byte >= 0xf8) return false;
        std::uint32_t code = byte & (0x3fu >> more);
        for (int k = 0; k < more; ++k) {
            if (i == text.size() || (text[i] & 0xc0) != 0x80) return false;
            code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
        }
        if (code < kLeast[more] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
            return false;
    }
    return true;
}

std::string utf8FromLatin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            utf8 += c;
        } else {
            utf8 += static_cast<char>(0xc0 | byte >> 6);
            utf8 += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return utf8;
}

}  // namespace hair::groom
