#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <glm/vec3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

constexpr std::string_view kBinaryMark = "BINARY_HAIR";
constexpr std::size_t kBinaryStart = kBinaryMark.size() + sizeof(std::uint32_t);

// ---- Strands ------------------------------------------------------------------------------------

// Ends a strand if it has a vertex.
void endMitsubaStrand(StrandSet& set) {
    const auto size = static_cast<std::uint32_t>(set.points.size());
    if (size > (set.ends.empty() ? 0 : set.ends.back())) set.ends.push_back(size);
}

// ---- Binary -------------------------------------------------------------------------------------

StrandSet readMitsubaBinary(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kVertex = sizeof(glm::vec3);
    if (bytes.size() < kBinaryStart)
        failAt(bytes.size(), "truncated: the mark and the number of vertices are 15 bytes");
    const std::uint64_t count = valueAt<std::uint32_t>(bytes, kBinaryMark.size());
    const std::uint64_t room = bytes.size() - kBinaryStart;
    const std::string vertices = std::to_string(count) + " vertices";
    if (count == 0) failAt(kBinaryMark.size(), "0 vertices; at least 1 is needed");
    if (count > room / kVertex)
        failAt(
            bytes.size(), "truncated: " + vertices + " are at least " +
                              std::to_string(kBinaryStart + count * kVertex) + " bytes");
    StrandSet set;
    set.points.reserve(count);
    std::uint64_t at = kBinaryStart;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (bytes.size() - at < sizeof(float))
            failAt(bytes.size(), "truncated: vertex " + std::to_string(i) + " is expected");
        if (std::isinf(valueAt<float>(bytes, at))) {
            endMitsubaStrand(set);
            at += sizeof(float);
        }
        if (bytes.size() - at < kVertex)
            failAt(bytes.size(), "truncated: vertex " + std::to_string(i) + " is expected");
        set.points.push_back(valueAt<glm::vec3>(bytes, at));
        at += kVertex;
    }
    if (at != bytes.size())
        failAt(at, std::to_string(bytes.size() - at) + " trailing bytes after the last vertex");
    endMitsubaStrand(set);
    return set;
}

// ---- Text ---------------------------------------------------------------------------------------

// Only a double holds half of the smallest floats.
void addRadius(TextWriter& text, float width) {
    const float radius = 0.5f * width;
    if (2.0f * radius == width)
        text.addNumber(radius);
    else
        text.addNumber(0.5 * double{width});
}

StrandSet readMitsubaText(std::string_view text) {
    StrandSet set;
    TextLines lines(text);
    std::size_t expected = 0;  // numbers of a line
    const auto fail = [&](const std::string& reason) { failAtLine(lines.number(), reason); };
    while (!lines.atEnd()) {
        std::string_view line = lines.take();
        std::array<double, 4> numbers{};
        std::size_t count = 0;
        const bool is_comment = line.starts_with('#');
        for (std::string_view word = takeWord(line); !word.empty() && !is_comment;
             word = takeWord(line)) {
            const auto number = doubleFrom(word);
            if (!number) fail(inQuotes(word) + " is not a number: expected x y z, or x y z radius");
            if (count < numbers.size()) numbers[count] = *number;
            ++count;
        }
        if (count == 0) {
            endMitsubaStrand(set);
            continue;
        }
        if (expected == 0) expected = count;
        if ((count != 3 && count != 4) || count != expected)
            fail(
                std::to_string(count) + " numbers, expected " +
                (count == expected ? "3, or 4 with a radius"
                                   : std::to_string(expected) + " as in the first line"));
        if (set.points.size() == std::numeric_limits<std::uint32_t>::max())
            fail("the strands have 2^32 vertices, or more");
        set.points.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (count == 4) set.widths.values.push_back(static_cast<float>(2.0 * numbers[3]));
    }
    endMitsubaStrand(set);
    if (set.ends.empty())
        failAtLine(std::max<std::size_t>(lines.number(), 1), "the file has no strands");
    return set;
}

}  // namespace

std::vector<std::string> exportMitsubaBinary(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    out.write(kBinaryMark.data(), static_cast<std::streamsize>(kBinaryMark.size()));
    writeValue(out, static_cast<std::uint32_t>(strands.points.size()));
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        writeValue(out, std::numeric_limits<float>::infinity());
        const auto points = std::as_bytes(strands.strand(i));
        out.write(
            reinterpret_cast<const char*>(points.data()),
            static_cast<std::streamsize>(points.size()));
    }
    return leftOut(strands, {});
}

std::vector<std::string> exportMitsubaText(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    TextWriter text(out);
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        if (i > 0) text.add("\n");
        for (std::size_t k = strands.first(i); k < strands.ends[i]; ++k) {
            const glm::vec3& point = strands.points[k];
            text.addNumber(point.x, "");
            text.addNumber(point.y);
            text.addNumber(point.z);
            if (strands.widths.known()) addRadius(text, strands.widths.at(k));
            text.add("\n");
        }
    }
    text.flush();
    return leftOut(strands, {Part::widths});
}

bool looksLikeMitsubaText(std::span<const std::byte> head, std::uint64_t) {
    constexpr std::string_view kNumbers = "0123456789+-.eE \t\r\n";
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    return !text.empty() &&
           (text.starts_with('#') || text.find_first_not_of(kNumbers) == text.npos);
}

StrandSet importMitsubaHair(const StrandFile& file) {
    const std::string_view text(
        reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    return text.starts_with(kBinaryMark) ? readMitsubaBinary(file.bytes) : readMitsubaText(text);
}

}  // namespace hair::groom
