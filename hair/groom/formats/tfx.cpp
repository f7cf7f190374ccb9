#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- The header ---------------------------------------------------------------------------------

// The beginning of a .tfx file, as it is in memory; formats.h says what follows. Offsets are bytes
// from the beginning of the file, 0 where there is no array.
struct TfxHeader {
    static constexpr float kVersion = 4.0f;

    float version = kVersion;
    std::uint32_t strands = 0;
    std::uint32_t vertices_per_strand = 0;
    std::uint32_t positions = 0;
    std::uint32_t strand_uvs = 0;
    std::uint32_t vertex_uvs = 0;
    std::uint32_t strand_thickness = 0;
    std::uint32_t vertex_colors = 0;
    std::array<std::uint32_t, 32> reserved{};
};
static_assert(sizeof(TfxHeader) == 160 && offsetof(TfxHeader, vertex_colors) == 28);

// The offsets at which a version's header has the members of TfxHeader, and other differences.
struct TfxForm {
    std::uint64_t header_size;
    std::uint64_t position_size;  // bytes of one, xyz first
    std::uint64_t positions;
    std::uint64_t strand_uvs;
    std::uint64_t vertex_uvs;
    std::uint64_t strand_thickness;
    std::uint64_t vertex_colors;
};

constexpr TfxForm kTfx4{
    sizeof(TfxHeader),
    sizeof(glm::vec4),
    offsetof(TfxHeader, positions),
    offsetof(TfxHeader, strand_uvs),
    offsetof(TfxHeader, vertex_uvs),
    offsetof(TfxHeader, strand_thickness),
    offsetof(TfxHeader, vertex_colors)};
constexpr TfxForm kTfx3{296, sizeof(glm::vec3), 144, 152, 164, 148, 156};
constexpr std::uint64_t kTfx3Followers = 12;
constexpr std::uint64_t kTfx3BothEndsFixed = 16;
constexpr std::uint64_t kTfx3GuideStrands = 160;

// ---- Writing ------------------------------------------------------------------------------------

// AMD's loader takes numbers in this range, powers of two only.
constexpr std::uint32_t kLeastVertices = 4;
constexpr std::uint32_t kMostVertices = 64;
constexpr std::uint32_t kFixedVertices = 2;

std::vector<glm::vec4> positionsOf(const StrandSet& strands, std::uint32_t vertices) {
    std::vector<glm::vec4> positions;
    positions.reserve(strands.points.size());
    for (const glm::vec3& point : strands.points) {
        const bool fixed = positions.size() % vertices < kFixedVertices;
        positions.emplace_back(point, fixed ? 0.0f : 1.0f);
    }
    return positions;
}

std::vector<float>
widthsOf(const StrandSet& strands, std::uint32_t vertices, std::vector<std::string>& warnings) {
    if (!strands.widths.known()) return {};
    std::vector<float> widths;
    widths.reserve(strands.strandCount());
    std::size_t varying = 0;
    for (std::size_t i = 0; i < strands.points.size(); i += vertices) {
        widths.push_back(strands.widths.at(i));
        for (std::size_t k = i; k < i + vertices; ++k) {
            if (strands.widths.at(k) == widths.back()) continue;
            ++varying;
            break;
        }
    }
    if (varying > 0) {
        warnings.push_back(
            "the width varies along " + std::to_string(varying) +
            " strands, which get that of their root");
    }
    return widths;
}

// Colours and alphas; empty if no colours are known and everything is opaque.
std::vector<glm::vec4> colorsOf(const StrandSet& strands, std::vector<std::string>& warnings) {
    const bool opaque = strands.transparencies.values.empty() &&
                        strands.transparencies.everywhere.value_or(0.0f) == 0.0f;
    if (!strands.colors.known() && opaque) return {};
    if (!strands.colors.known())
        warnings.emplace_back("the colours are not known: white is written beside the alphas");
    std::vector<glm::vec4> colors;
    colors.reserve(strands.points.size());
    std::size_t rounded = 0;
    for (std::size_t i = 0; i < strands.points.size(); ++i) {
        const float transparency = opaque ? 0.0f : strands.transparencies.at(i);
        const float alpha = 1.0f - transparency;
        if (1.0f - alpha != transparency) ++rounded;
        colors.emplace_back(strands.colors.known() ? strands.colors.at(i) : glm::vec3(1.0f), alpha);
    }
    if (rounded > 0) {
        warnings.push_back(
            std::to_string(rounded) + " transparencies are rounded: the format holds alpha, which "
                                      "is 1 minus the transparency");
    }
    return colors;
}

// Returns the place of an array of `bytes` at the end of the file; 0 if it is empty.
std::uint32_t place(std::uint64_t& end, std::uint64_t bytes) {
    if (bytes == 0) return 0;
    const std::uint64_t start = (end + 7) / 8 * 8;
    end = start + bytes;
    if (start > std::numeric_limits<std::uint32_t>::max())
        throw engine::Error("more bytes than .tfx can count: the offset of an array has 32 bits");
    return static_cast<std::uint32_t>(start);
}

template <class Element>
void writeAt(
    std::ostream& out, std::uint64_t& position, std::uint32_t start,
    const std::vector<Element>& elements) {
    if (elements.empty()) return;
    writeArray(out, std::vector<char>(start - position));
    writeArray(out, elements);
    position = start + elements.size() * sizeof(Element);
}

// ---- Reading ------------------------------------------------------------------------------------

// Returns the form of the file's version.
const TfxForm& formOf(std::span<const std::byte> bytes) {
    const bool has_version = bytes.size() >= sizeof(float);
    const float version = has_version ? valueAt<float>(bytes, 0) : TfxHeader::kVersion;
    const bool is_old = version >= 3.0f && version < 4.0f;
    if (version != TfxHeader::kVersion && !is_old) {
        failAt(
            0, "version " + std::to_string(version) +
                   "; only 3, 4.0 and texts that begin with \"version\" are read");
    }
    const TfxForm& form = is_old ? kTfx3 : kTfx4;
    if (bytes.size() < form.header_size) {
        failAt(
            bytes.size(),
            "truncated: the header alone is " + std::to_string(form.header_size) + " bytes");
    }
    return form;
}

TfxHeader readHeader(std::span<const std::byte> bytes, const TfxForm& form) {
    const auto offsetAt = [&](std::uint64_t byte) { return valueAt<std::uint32_t>(bytes, byte); };
    const TfxHeader header{
        .strands = offsetAt(offsetof(TfxHeader, strands)),
        .vertices_per_strand = offsetAt(offsetof(TfxHeader, vertices_per_strand)),
        .positions = offsetAt(form.positions),
        .strand_uvs = offsetAt(form.strand_uvs),
        .vertex_uvs = offsetAt(form.vertex_uvs),
        .strand_thickness = offsetAt(form.strand_thickness),
        .vertex_colors = offsetAt(form.vertex_colors)};
    if (header.strands == 0) failAt(4, "0 strands; at least 1 is needed");
    if (header.vertices_per_strand == 0) failAt(8, "0 vertices per strand; at least 2 are needed");
    const std::uint64_t vertices = std::uint64_t{header.strands} * header.vertices_per_strand;
    if (vertices > std::numeric_limits<std::uint32_t>::max())
        failAt(4, std::to_string(vertices) + " vertices; at most 2^32 - 1 are read");
    if (header.positions == 0) failAt(form.positions, "there are no positions");
    return header;
}

// An array that the header names.
struct Array {
    std::string_view name;
    std::uint64_t header_offset;  // byte of the header that holds the array's offset
    std::uint64_t start;
    std::uint64_t size;  // bytes
};

// Returns the arrays that the file has. They have at most 2^32 vertices of 16 bytes, so ends fit
// in 64 bits.
std::vector<Array> arraysOf(const TfxHeader& header, const TfxForm& form) {
    const std::uint64_t strands = header.strands;
    const std::uint64_t vertices = strands * header.vertices_per_strand;
    std::vector<Array> arrays{
        {"positions", form.positions, header.positions, form.position_size * vertices},
        {"strand UVs", form.strand_uvs, header.strand_uvs, 8 * strands},
        {"vertex UVs", form.vertex_uvs, header.vertex_uvs, 8 * vertices},
        {"strand thickness", form.strand_thickness, header.strand_thickness, 4 * strands},
        {"vertex colours", form.vertex_colors, header.vertex_colors, 16 * vertices},
    };
    std::erase_if(arrays, [](const Array& array) { return array.start == 0; });
    return arrays;
}

void checkPlaces(std::vector<Array> arrays, std::uint64_t header_size, std::uint64_t size) {
    std::ranges::stable_sort(arrays, {}, &Array::start);
    std::string before = "header";
    std::uint64_t end = header_size;
    for (const Array& array : arrays) {
        const std::string at = std::string(array.name) + " at byte " + std::to_string(array.start);
        if (array.start % sizeof(float) != 0)
            failAt(
                array.header_offset, at + ": not a multiple of " + std::to_string(sizeof(float)));
        if (array.start < end) {
            failAt(
                array.header_offset,
                at + " overlap the " + before + ", which end at byte " + std::to_string(end));
        }
        before = array.name;
        end = array.start + array.size;
        if (end <= size) continue;
        failAt(
            array.start < size ? size : array.header_offset,
            at + ": truncated: they end at byte " + std::to_string(end) +
                ", but the file ends at byte " + std::to_string(size));
    }
}

// Returns the values, or one value if all are the same, because TressFX has no other way to store
// one.
template <class Value>
PointAttribute<Value> compact(std::vector<Value> values) {
    const Value first = values.front();
    const auto is_first = [&](const Value& value) {  // to the bit: -0 differs from 0
        return std::memcmp(&value, &first, sizeof first) == 0;
    };
    if (std::ranges::all_of(values, is_first)) return {.everywhere = first};
    return {.values = std::move(values)};
}

void readPositions(const TfxHeader& header, std::span<const std::byte> bytes, StrandSet& strands) {
    const std::uint64_t count = std::uint64_t{header.strands} * header.vertices_per_strand;
    const auto positions = arrayAt<glm::vec4>(bytes, header.positions, count);
    strands.points.assign(positions.begin(), positions.end());
    std::size_t fixed = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (i % header.vertices_per_strand > 1 && positions[i].w == 0.0f) ++fixed;
    if (fixed > 0) {
        strands.warnings.push_back(
            std::to_string(fixed) +
            " vertices beyond the first two of their strand are fixed (w = 0); this is not read");
    }
}

PointAttribute<float> readWidths(const TfxHeader& header, std::span<const std::byte> bytes) {
    if (header.strand_thickness == 0) return {};
    const auto widths = arrayAt<float>(bytes, header.strand_thickness, header.strands);
    std::vector<float> values;
    values.reserve(std::size_t{header.strands} * header.vertices_per_strand);
    for (const float width : widths) values.insert(values.end(), header.vertices_per_strand, width);
    return compact(std::move(values));
}

void readPositions3(const TfxHeader& header, std::span<const std::byte> bytes, StrandSet& strands) {
    strands.points = arrayAt<glm::vec3>(
        bytes, header.positions, std::uint64_t{header.strands} * header.vertices_per_strand);
}

// Warns of features of TressFX's versions 2 and 3 that are left out.
void warnOfFollowers(std::int64_t followers, bool both_ends_fixed, StrandSet& strands) {
    if (followers > 0) {
        const std::string count = std::to_string(followers);
        strands.warnings.push_back(
            "the " + count +
            " followers that TressFX makes round each strand are left out: hairbench groom convert "
            "--followers " +
            count + " makes them");
    }
    if (both_ends_fixed)
        strands.warnings.emplace_back("the fixing of both ends of strands is left out");
}

void readColors(const TfxHeader& header, std::span<const std::byte> bytes, StrandSet& strands) {
    if (header.vertex_colors == 0) return;
    const auto colors = arrayAt<glm::vec4>(bytes, header.vertex_colors, strands.points.size());
    strands.colors = compact(std::vector<glm::vec3>(colors.begin(), colors.end()));
    std::vector<float> transparencies(colors.size());
    std::ranges::transform(
        colors, transparencies.begin(), [](const glm::vec4& color) { return 1.0f - color.a; });
    strands.transparencies = compact(std::move(transparencies));
}

// ---- The text of version 2 ----------------------------------------------------------------------

// Reads lines of a keyword with its values, up to the number of strands, then each strand's line
// and its points.
class TfxText {
public:
    explicit TfxText(std::string_view text) : lines_(text) {}

    StrandSet read() {
        readHeader();
        for (std::int64_t i = 0; i < strands_; ++i) readStrand(i);
        while (!lines_.atEnd()) {
            std::string_view line = lines_.take();
            if (const auto word = takeWord(line); !word.empty())
                fail(inQuotes(word) + " after the last strand");
        }
        warnOfFollowers(followers_, both_ends_fixed_, set_);
        return std::move(set_);
    }

private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw engine::Error("line " + std::to_string(lines_.number()), reason);
    }

    void takeLine() {
        if (lines_.atEnd()) {
            lines_.take();
            fail("truncated: the file ends here");
        }
        line_ = lines_.take();
    }

    void expectEnd() {
        if (const auto word = takeWord(line_); !word.empty())
            fail(inQuotes(word) + " is one value too many");
    }

    std::int64_t takeCount(std::string_view name, std::int64_t least) {
        const std::string_view word = takeWord(line_);
        const auto count = integerFrom(word);
        if (!count || *count < least || *count > std::numeric_limits<std::uint32_t>::max())
            fail(inQuotes(word) + " is not a " + std::string(name));
        return *count;
    }

    float takeFloat() {
        const std::string_view word = takeWord(line_);
        const auto number = floatFrom(word);
        if (!number) fail(inQuotes(word) + " is not a number");
        return *number;
    }

    // Nothing states how a file's transform is applied; all known files have none.
    void expectIdentity(std::string_view keyword, int count, float identity) {
        for (int i = 0; i < count; ++i) {
            if (takeFloat() == identity) continue;
            fail(
                "a " + std::string(keyword) +
                ", which is not read: export the points without a transform");
        }
    }

    void readHeader() {
        while (strands_ == 0) {
            takeLine();
            const std::string_view keyword = takeWord(line_);
            if (keyword == "version") {
                const std::string_view version = takeWord(line_);
                if (floatFrom(version) != 2.0f)
                    fail("version " + inQuotes(version) + "; only 2.0 is read as text");
            } else if (keyword == "scale") {
                expectIdentity(keyword, 1, 1.0f);
            } else if (keyword == "rotation" || keyword == "translation") {
                expectIdentity(keyword, 3, 0.0f);
            } else if (keyword == "bothEndsImmovable") {
                both_ends_fixed_ = takeCount("flag", 0) != 0;
            } else if (keyword == "maxNumVerticesInStrand") {
                most_vertices_ = takeCount("number of vertices", 1);
            } else if (keyword == "numFollowHairsPerGuideHair") {
                followers_ = takeCount("number of followers", 0);
            } else if (keyword == "maxRadiusAroundGuideHair") {
                takeFloat();
            } else if (keyword == "numStrands") {
                strands_ = takeCount("number of strands of at least 1", 1);
            } else {
                fail("unknown keyword " + inQuotes(keyword) + " before 'numStrands'");
            }
            expectEnd();
        }
        // A line and a point of each strand take more bytes than this.
        constexpr std::size_t kLeastStrand = sizeof("strand 0 numVerts 1 0 0 0");
        if (static_cast<std::size_t>(strands_) > lines_.bytesLeft() / kLeastStrand + 1)
            fail("truncated: " + std::to_string(strands_) + " strands are expected");
    }

    void expectWord(std::string_view expected) {
        const std::string_view word = takeWord(line_);
        if (word != expected) fail(inQuotes(word) + ", expected " + inQuotes(expected));
    }

    // "strand 0 numVerts 16 texcoord 0.5 0.5", with a line for each vertex.
    void readStrand(std::int64_t number) {
        takeLine();
        std::string_view keyword = takeWord(line_);
        if (number == 0 && keyword == "is") {
            expectWord("sorted");
            takeCount("flag", 0);
            expectEnd();
            takeLine();
            keyword = takeWord(line_);
        }
        if (keyword != "strand") fail(inQuotes(keyword) + ", expected 'strand'");
        if (takeCount("number of a strand", 0) != number)
            fail("strand " + std::to_string(number) + " is expected here");
        expectWord("numVerts");
        const std::int64_t vertices = takeCount("number of vertices of at least 1", 1);
        if (vertices > most_vertices_)
            fail("more vertices than maxNumVerticesInStrand, " + std::to_string(most_vertices_));
        if (const auto word = takeWord(line_); !word.empty()) {
            if (word != "texcoord") fail(inQuotes(word) + ", expected 'texcoord'");
            const float u = takeFloat();
            set_.root_uvs.emplace_back(u, takeFloat());
            expectEnd();
        }
        if (!set_.root_uvs.empty() && std::ssize(set_.root_uvs) != number + 1)
            fail("all strands have a texcoord, or none");
        for (std::int64_t i = 0; i < vertices; ++i) {
            takeLine();
            const float x = takeFloat();
            const float y = takeFloat();
            set_.points.emplace_back(x, y, takeFloat());
            expectEnd();
        }
        if (set_.points.size() > std::numeric_limits<std::uint32_t>::max())
            fail("the strands have 2^32 points, or more");
        set_.ends.push_back(static_cast<std::uint32_t>(set_.points.size()));
    }

    TextLines lines_;
    std::string_view line_;  // rest of the line
    std::int64_t strands_ = 0;
    std::int64_t most_vertices_ = std::numeric_limits<std::uint32_t>::max();
    std::int64_t followers_ = 0;
    bool both_ends_fixed_ = false;
    StrandSet set_;
};

}  // namespace

std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    auto warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::root_uvs});
    const auto resampled = makeUniform(
        strands,
        {.least = 2,
         .most = std::numeric_limits<std::uint32_t>::max(),
         .wanted = std::clamp(
             std::bit_ceil(std::min(greatestSize(strands), kMostVertices)), kLeastVertices,
             kMostVertices)},
        warnings);
    const StrandSet& uniform = resampled ? *resampled : strands;
    const std::uint32_t vertices = uniform.ends.front();
    if (!std::has_single_bit(vertices) || vertices < kLeastVertices || vertices > kMostVertices) {
        warnings.push_back(
            std::to_string(vertices) +
            " vertices per strand: TressFX itself takes 4, 8, 16, 32 or 64");
    }
    const auto positions = positionsOf(uniform, vertices);
    const auto widths = widthsOf(uniform, vertices, warnings);
    const auto colors = colorsOf(uniform, warnings);

    std::uint64_t end = sizeof(TfxHeader);
    const TfxHeader header{
        .strands = uniform.strandCount(),
        .vertices_per_strand = vertices,
        .positions = place(end, positions.size() * sizeof(glm::vec4)),
        .strand_uvs = place(end, uniform.root_uvs.size() * sizeof(glm::vec2)),
        .strand_thickness = place(end, widths.size() * sizeof(float)),
        .vertex_colors = place(end, colors.size() * sizeof(glm::vec4))};
    writeValue(out, header);
    std::uint64_t position = sizeof(TfxHeader);
    writeAt(out, position, header.positions, positions);
    writeAt(out, position, header.strand_uvs, uniform.root_uvs);
    writeAt(out, position, header.strand_thickness, widths);
    writeAt(out, position, header.vertex_colors, colors);
    return warnings;
}

StrandSet importTfx(const StrandFile& file) {
    const std::string_view text(
        reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    if (text.starts_with("version")) return TfxText(text).read();
    const TfxForm& form = formOf(file.bytes);
    const TfxHeader header = readHeader(file.bytes, form);
    std::vector<Array> arrays = arraysOf(header, form);
    const bool is_old = &form == &kTfx3;
    const auto guides = is_old ? valueAt<std::uint32_t>(file.bytes, kTfx3GuideStrands) : 0;
    if (guides != 0)
        arrays.push_back(
            {"guide strands", kTfx3GuideStrands, guides, std::uint64_t{4} * header.strands});
    checkPlaces(std::move(arrays), form.header_size, file.bytes.size());
    StrandSet strands{.ends = uniformEnds(header.strands, header.vertices_per_strand)};
    if (is_old) {
        readPositions3(header, file.bytes, strands);
        warnOfFollowers(
            valueAt<std::uint32_t>(file.bytes, kTfx3Followers),
            // AMD's exporter writes one byte, and leaves the three after it undefined.
            valueAt<std::uint8_t>(file.bytes, kTfx3BothEndsFixed) != 0, strands);
        if (guides != 0)
            strands.warnings.emplace_back("the numbers of strands' guides are left out");
    } else {
        readPositions(header, file.bytes, strands);
    }
    strands.widths = readWidths(header, file.bytes);
    readColors(header, file.bytes, strands);
    if (header.strand_uvs != 0) {
        strands.root_uvs = arrayAt<glm::vec2>(file.bytes, header.strand_uvs, header.strands);
    }
    if (header.vertex_uvs != 0)
        strands.warnings.emplace_back("the texture coordinates of vertices are left out");
    return strands;
}

}  // namespace hair::groom
