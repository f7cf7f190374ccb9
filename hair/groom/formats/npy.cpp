#include "hair/groom/formats/npy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <zlib.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

using namespace std::string_view_literals;

// ---- An array's header --------------------------------------------------------------------------

constexpr auto kNpyMagic = "\x93NUMPY"sv;

struct NpyTypeRow {
    NpyType type;
    std::string_view name;  // NumPy's `descr`
    std::size_t size;
};

constexpr std::array kNpyTypes{
    NpyTypeRow{NpyType::float32, "<f4", 4}, NpyTypeRow{NpyType::float64, "<f8", 8},
    NpyTypeRow{NpyType::int32, "<i4", 4},   NpyTypeRow{NpyType::int64, "<i8", 8},
    NpyTypeRow{NpyType::uint8, "|u1", 1},   NpyTypeRow{NpyType::boolean, "|b1", 1},
};

const NpyTypeRow& rowOf(NpyType type) { return kNpyTypes[static_cast<std::size_t>(type)]; }

bool isFloat(NpyType type) { return type == NpyType::float32 || type == NpyType::float64; }

// An array in memory, known to be complete in the file.
struct NpyArray {
    NpyType type = NpyType::float32;
    bool is_fortran = false;
    std::vector<std::uint64_t> shape;
    std::uint64_t count = 1;  // of numbers
    std::span<const std::byte> bytes;  // of the whole .npy
    std::uint64_t start = 0;  // byte of the first number

    bool hasShape(std::span<const std::uint64_t> wanted) const {
        return std::ranges::equal(shape, wanted);
    }
};

std::string shapeText(std::span<const std::uint64_t> shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

// Reads the dictionary of a header, which is a literal of Python: 'descr': a string,
// 'fortran_order': True or False, 'shape': a tuple of integers, in any order, each once.
class NpyDictionary {
public:
    NpyDictionary(std::string_view text, std::uint64_t start) : text_(text), start_(start) {}

    void read(NpyArray& array) {
        expect("{");
        std::array<bool, 3> known{};
        while (!skip("}")) {
            const std::string_view key = takeString();
            expect(":");
            const std::size_t which = key == "descr"           ? 0
                                      : key == "fortran_order" ? 1
                                      : key == "shape"         ? 2
                                                               : 3;
            if (which == 3 || known[which])
                fail("the key " + inQuotes(key) + ", expected descr, fortran_order, shape, once");
            known[which] = true;
            if (which == 0) array.type = takeType();
            if (which == 1) array.is_fortran = takeBool();
            if (which == 2) array.shape = takeShape();
            if (!skip(",") && !text_.substr(at_).starts_with('}')) fail("',' or '}' is expected");
        }
        if (!std::ranges::all_of(known, std::identity{}))
            fail("descr, fortran_order and shape are expected");
        if (at_ != text_.size()) fail("the header's dictionary has ended");
    }

private:
    [[noreturn]] void fail(const std::string& reason) const { failAt(start_ + at_, reason); }

    void skipSpace() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    }

    bool skip(std::string_view word) {
        skipSpace();
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        skipSpace();
        return true;
    }

    void expect(std::string_view word) {
        if (!skip(word)) fail(inQuotes(word) + " is expected");
    }

    std::string_view takeString() {
        const char quote = at_ < text_.size() ? text_[at_] : ' ';
        const std::size_t end =
            quote == '\'' || quote == '"' ? text_.find(quote, at_ + 1) : std::string_view::npos;
        if (end == std::string_view::npos) fail("a string in quotes is expected");
        const std::string_view taken = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return taken;
    }

    NpyType takeType() {
        if (text_.substr(at_).starts_with('['))
            fail("an array of records, expected one of numbers");
        const std::size_t start = at_;
        const std::string_view name = takeString();
        for (const NpyTypeRow& row : kNpyTypes)
            if (row.name == name) return row.type;
        at_ = start;
        if (name.starts_with("|O"))
            fail("an array of Python objects (a pickle): write each array of numbers with "
                 "numpy.savez");
        fail(
            "numbers of type " + inQuotes(name) +
            ", expected '<f4' or '<f8': convert them with astype(numpy.float32)");
    }

    bool takeBool() {
        if (skip("True")) return true;
        expect("False");
        return false;
    }

    std::vector<std::uint64_t> takeShape() {
        constexpr std::size_t kMostDimensions = 32;  // of NumPy
        std::vector<std::uint64_t> shape;
        expect("(");
        while (!skip(")")) {
            const std::size_t end =
                std::min(text_.find_first_not_of("0123456789", at_), text_.size());
            const auto size = integerFrom(text_.substr(at_, end - at_));
            if (!size) fail("a size is expected");
            if (shape.size() == kMostDimensions) fail("more than 32 dimensions");
            shape.push_back(static_cast<std::uint64_t>(*size));
            at_ = end;
            if (!skip(",") && !text_.substr(at_).starts_with(')')) fail("',' or ')' is expected");
        }
        return shape;
    }

    std::string_view text_;
    std::uint64_t start_;
    std::size_t at_ = 0;
};

NpyArray readNpy(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::size_t kFixed = 8;  // bytes: the magic and the version
    if (text.size() >= kNpyMagic.size() && !text.starts_with(kNpyMagic))
        failAt(0, "an array of NumPy begins with \"\\x93NUMPY\"");
    if (text.size() < kFixed + 2) failAt(text.size(), "truncated: the header is expected");
    const auto version = static_cast<unsigned char>(text[6]);
    if (version < 1 || version > 3 || text[7] != 0)
        failAt(6, "version " + std::to_string(version) + " of NumPy's format, expected 1 to 3");
    const std::size_t dictionary = kFixed + (version == 1 ? 2 : 4);
    if (text.size() < dictionary) failAt(text.size(), "truncated: the header is expected");
    const std::uint64_t length = version == 1 ? valueAt<std::uint16_t>(bytes, kFixed)
                                              : valueAt<std::uint32_t>(bytes, kFixed);
    if (length > text.size() - dictionary)
        failAt(kFixed, "truncated: a header of " + std::to_string(length) + " bytes is expected");
    NpyArray array{.bytes = bytes, .start = dictionary + length};
    NpyDictionary(text.substr(dictionary, length), dictionary).read(array);

    // The rest of the file has room for this many numbers, so that no product overflows.
    const std::uint64_t room = (text.size() - array.start) / rowOf(array.type).size;
    bool is_empty = false;
    for (const std::uint64_t size : array.shape) is_empty = is_empty || size == 0;
    if (is_empty) array.count = 0;
    for (const std::uint64_t size : array.shape) {
        if (is_empty) break;
        if (size > room / array.count)
            failAt(
                text.size(), "truncated: an array of shape " + shapeText(array.shape) +
                                 " is expected, but there is room for " + std::to_string(room) +
                                 " numbers");
        array.count *= size;
    }
    const std::uint64_t end = array.start + array.count * rowOf(array.type).size;
    if (end < text.size())
        failAt(end, std::to_string(text.size() - end) + " trailing bytes after the array");
    return array;
}

// ---- An array's numbers -------------------------------------------------------------------------

double numberAt(const NpyArray& array, std::uint64_t index) {
    const std::uint64_t byte = array.start + index * rowOf(array.type).size;
    switch (array.type) {
    case NpyType::float32:
        return valueAt<float>(array.bytes, byte);
    case NpyType::float64:
        return valueAt<double>(array.bytes, byte);
    case NpyType::int32:
        return valueAt<std::int32_t>(array.bytes, byte);
    case NpyType::int64:
        return static_cast<double>(valueAt<std::int64_t>(array.bytes, byte));
    default:
        return valueAt<std::uint8_t>(array.bytes, byte);
    }
}

// Returns the place of the number with this index in C's order.
std::uint64_t placeOf(const NpyArray& array, std::uint64_t index) {
    if (!array.is_fortran) return index;
    // The last subscript runs fastest in C's order, the first one in Fortran's.
    std::uint64_t place = 0;
    std::uint64_t step = array.count;
    for (std::size_t i = array.shape.size(); i-- > 0;) {
        step /= array.shape[i];
        place += index % array.shape[i] * step;
        index /= array.shape[i];
    }
    return place;
}

// Fills `numbers` with those of the array, in C's order.
void readFloats(const NpyArray& array, std::span<float> numbers) {
    const bool as_it_lies = array.type == NpyType::float32 && !array.is_fortran;
    if (as_it_lies) {
        std::memcpy(numbers.data(), array.bytes.data() + array.start, numbers.size_bytes());
    } else {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = static_cast<float>(numberAt(array, placeOf(array, i)));
    }
}

// Returns the array as strands.
StrandSet strandsOf(const NpyArray& array) {
    if (!isFloat(array.type) || array.shape.size() != 3 || array.shape[2] != 3) {
        failAt(
            0, "an array " + shapeText(array.shape) + " of '" +
                   std::string(rowOf(array.type).name) +
                   "', expected one of floats of shape (strands, points of each, 3)");
    }
    const std::uint64_t strands = array.shape[0];
    const std::uint64_t size = array.shape[1];
    if (array.count == 0) failAt(0, "there are no strands with points");
    if (strands * size > std::numeric_limits<std::uint32_t>::max())
        failAt(0, "the strands have 2^32 points, or more");
    StrandSet set{
        .ends = uniformEnds(static_cast<std::uint32_t>(strands), static_cast<std::uint32_t>(size))};
    set.points.resize(strands * size);
    readFloats(array, {&set.points.front().x, 3 * set.points.size()});
    if (array.type == NpyType::float64)
        set.warnings.emplace_back("the points are doubles and are rounded to floats");
    return set;
}

// ---- Archives -----------------------------------------------------------------------------------

constexpr std::uint32_t kLocalSignature = 0x04034b50;
constexpr std::uint32_t kCentralSignature = 0x02014b50;
constexpr std::uint32_t kEndSignature = 0x06054b50;
constexpr std::size_t kLocalSize = 30;  // bytes, without name and extra field
constexpr std::size_t kCentralSize = 46;
constexpr std::size_t kEndSize = 22;
constexpr std::uint32_t kZip64 = 0xffffffff;  // a size or an offset that is stored elsewhere
constexpr auto kNpyExtension = ".npy"sv;

enum ZipMethod : std::uint16_t { kStored = 0, kDeflated = 8 };

// A file in an archive.
struct ZipMember {
    std::string name;
    std::uint16_t method = kStored;
    std::uint32_t checksum = 0;
    std::uint64_t size = 0;  // inflated
    std::uint64_t start = 0;  // byte of its contents
    std::span<const std::byte> contents;  // as they lie in the archive
};

// The directory of an archive: its place and its number of members.
struct ZipDirectory {
    std::uint64_t start;
    std::uint64_t end;
    std::uint16_t members;
};

ZipDirectory readDirectory(std::span<const std::byte> bytes) {
    if (bytes.size() < kEndSize)
        failAt(bytes.size(), "truncated: a zip archive ends with its directory");
    // A comment may follow the directory. Its length is in the last two bytes.
    const std::size_t longest = std::min<std::size_t>(bytes.size() - kEndSize, 0xffff);
    for (std::size_t comment = 0; comment <= longest; ++comment) {
        const std::uint64_t at = bytes.size() - kEndSize - comment;
        if (valueAt<std::uint32_t>(bytes, at) != kEndSignature ||
            valueAt<std::uint16_t>(bytes, at + 20) != comment)
            continue;
        const auto disk = valueAt<std::uint32_t>(bytes, at + 4);
        const auto members_here = valueAt<std::uint16_t>(bytes, at + 8);
        const auto members = valueAt<std::uint16_t>(bytes, at + 10);
        const auto size = valueAt<std::uint32_t>(bytes, at + 12);
        const auto start = valueAt<std::uint32_t>(bytes, at + 16);
        if (disk != 0 || members_here != members) failAt(at + 4, "an archive of several parts");
        if (start == kZip64 || size == kZip64 || members == 0xffff)
            failAt(at, "an archive in the ZIP64 form, for 4 GiB or more, is not read");
        if (std::uint64_t{start} + size != at)
            failAt(at + 12, "the directory doesn't end where this record begins");
        return {start, at, members};
    }
    failAt(bytes.size(), "truncated: a zip archive ends with its directory");
}

// Returns the member with its directory record at `at`, and moves `at` past the record.
ZipMember
readMember(std::span<const std::byte> bytes, const ZipDirectory& directory, std::uint64_t& at) {
    if (directory.end - at < kCentralSize || valueAt<std::uint32_t>(bytes, at) != kCentralSignature)
        failAt(at, "a record of the directory is expected");
    const auto flags = valueAt<std::uint16_t>(bytes, at + 8);
    const auto packed_size = valueAt<std::uint32_t>(bytes, at + 20);
    const auto size = valueAt<std::uint32_t>(bytes, at + 24);
    const auto name_size = valueAt<std::uint16_t>(bytes, at + 28);
    const std::uint64_t record = kCentralSize + name_size + valueAt<std::uint16_t>(bytes, at + 30) +
                                 valueAt<std::uint16_t>(bytes, at + 32);
    const auto local = valueAt<std::uint32_t>(bytes, at + 42);
    if (record > directory.end - at) failAt(at + 28, "the record is longer than the directory");
    ZipMember member{
        .name =
            std::string(reinterpret_cast<const char*>(bytes.data()) + at + kCentralSize, name_size),
        .method = valueAt<std::uint16_t>(bytes, at + 10),
        .checksum = valueAt<std::uint32_t>(bytes, at + 16),
        .size = size};
    if ((flags & 1u) != 0) failAt(at + 8, inQuotes(member.name) + " is encrypted");
    if (member.method != kStored && member.method != kDeflated)
        failAt(
            at + 10, inQuotes(member.name) + " is compressed by method " +
                         std::to_string(member.method) + ", expected 0 (stored) or 8 (deflated)");
    if (packed_size == kZip64 || size == kZip64 || local == kZip64)
        failAt(at + 20, inQuotes(member.name) + " is in the ZIP64 form, which is not read");
    if (std::uint64_t{local} + kLocalSize > directory.start ||
        valueAt<std::uint32_t>(bytes, local) != kLocalSignature)
        failAt(at + 42, inQuotes(member.name) + " is not at byte " + std::to_string(local));
    const auto local_name = valueAt<std::uint16_t>(bytes, local + 26);
    member.start =
        std::uint64_t{local} + kLocalSize + local_name + valueAt<std::uint16_t>(bytes, local + 28);
    if (member.start + packed_size > directory.start)
        failAt(at + 20, inQuotes(member.name) + " is truncated");
    const auto contents = bytes.subspan(local + kLocalSize, local_name);
    if (valueAt<std::uint16_t>(bytes, local + 8) != member.method ||
        !std::ranges::equal(contents, std::as_bytes(std::span(member.name))))
        failAt(local, "this differs from the directory for " + inQuotes(member.name));
    member.contents = bytes.subspan(member.start, packed_size);
    at += record;
    return member;
}

std::vector<ZipMember> readMembers(std::span<const std::byte> bytes) {
    const ZipDirectory directory = readDirectory(bytes);
    std::vector<ZipMember> members;
    std::uint64_t at = directory.start;
    std::uint64_t packed = 0;
    for (std::uint16_t i = 0; i < directory.members; ++i) {
        const std::uint64_t record = at;
        members.push_back(readMember(bytes, directory, at));
        packed += kLocalSize + members.back().contents.size();
        if (packed > directory.start)
            failAt(
                record + 42,
                inQuotes(members.back().name) +
                    " shares its bytes with others: all members together exceed the archive");
    }
    if (at != directory.end) failAt(at, "the directory has more records than it says");
    return members;
}

std::uint32_t checksumOf(std::span<const std::byte> bytes, uLong before = 0) {
    return static_cast<std::uint32_t>(
        crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// Ends an inflation, also after errors.
struct MemberInflation {
    z_stream stream{};
    ~MemberInflation() { inflateEnd(&stream); }
};

// Bytes that are not filled with zeros before they are written.
struct InflatedBytes {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
};

InflatedBytes inflatedOf(const ZipMember& member) {
    // Two bits, a length and a distance, stand for at most 258 bytes, so a byte stands for at most
    // 1032.
    if (member.size / 1032 > member.contents.size() + 1)
        failAt(member.start, "the compressed bytes are too few for the expected size");
    InflatedBytes inflated{
        std::make_unique_for_overwrite<std::byte[]>(member.size),
        static_cast<std::size_t>(member.size)};
    MemberInflation inflation;
    z_stream& stream = inflation.stream;
    constexpr int kNoZlibHeader = -15;
    if (inflateInit2(&stream, kNoZlibHeader) != Z_OK) throw engine::Error("zlib can't be started");
    // Both sizes have 32 bits, like zlib's counts.
    stream.next_in = const_cast<Bytef*>(  // zlib's type; it only reads
        reinterpret_cast<const Bytef*>(member.contents.data()));
    stream.avail_in = static_cast<uInt>(member.contents.size());
    stream.next_out = reinterpret_cast<Bytef*>(inflated.bytes.get());
    stream.avail_out = static_cast<uInt>(inflated.size);
    if (::inflate(&stream, Z_FINISH) != Z_STREAM_END || stream.avail_out != 0 ||
        stream.avail_in != 0)
        failAt(member.start, inQuotes(member.name) + ": the compressed bytes are damaged");
    return inflated;
}

// Calls `read` with the member's array. Errors begin with the byte of the member.
template <class Read>
void withArray(const ZipMember& member, ExpansionLimit& unfolding, const Read& read) {
    try {
        unfolding.add(member.size, "the archive's arrays");
    } catch (const engine::Error& error) {
        failAt(member.start, error.what());
    }
    InflatedBytes inflated;
    std::span<const std::byte> bytes = member.contents;
    if (member.method == kDeflated) {
        inflated = inflatedOf(member);
        bytes = {inflated.bytes.get(), inflated.size};
    }
    if (bytes.size() != member.size)
        failAt(member.start, inQuotes(member.name) + " is not as long as the directory says");
    if (checksumOf(bytes) != member.checksum)
        failAt(member.start, "the checksum of " + inQuotes(member.name) + " is wrong");
    try {
        read(readNpy(bytes));
    } catch (const engine::Error& error) {
        failAt(member.start, inQuotes(member.name) + ": " + error.what());
    }
}

// ---- Strands of an archive ----------------------------------------------------------------------

constexpr auto kPositions = "positions"sv;

struct NpzSource {
    StrandSet& set;
    std::uint64_t strands;
    std::uint64_t points;  // of a strand
};

void expectShape(const NpyArray& array, bool is_type, std::span<const std::uint64_t> shape) {
    if (is_type && array.hasShape(shape)) return;
    failAt(
        0, "an array " + shapeText(array.shape) + " of '" + std::string(rowOf(array.type).name) +
               "', expected one " + shapeText(shape) + " to go with the positions");
}

void readRootUvs(const NpyArray& array, NpzSource source) {
    expectShape(array, isFloat(array.type), std::array{source.strands, std::uint64_t{2}});
    source.set.root_uvs.resize(source.strands);
    readFloats(array, {&source.set.root_uvs.front().x, 2 * source.strands});
}

void readWidths(const NpyArray& array, NpzSource source) {
    expectShape(array, isFloat(array.type), std::array{source.strands, source.points});
    auto& widths = source.set.widths.values;
    widths.resize(source.set.points.size());
    readFloats(array, widths);
}

void readGroups(const NpyArray& array, NpzSource source) {
    const bool is_integer = array.type == NpyType::int32 || array.type == NpyType::int64;
    expectShape(array, is_integer, std::array{source.strands});
    for (std::uint64_t i = 0; i < source.strands; ++i) {
        const double number = numberAt(array, i);
        if (number < std::numeric_limits<std::int32_t>::min() ||
            number > std::numeric_limits<std::int32_t>::max())
            failAt(
                array.start + i * rowOf(array.type).size,
                "group " + std::to_string(i) + " is not an int32");
        source.set.groups.push_back(static_cast<std::int32_t>(number));
    }
}

void readGuides(const NpyArray& array, NpzSource source) {
    const bool is_flag = array.type == NpyType::uint8 || array.type == NpyType::boolean;
    expectShape(array, is_flag, std::array{source.strands});
    for (std::uint64_t i = 0; i < source.strands; ++i) {
        const auto flag = valueAt<std::uint8_t>(array.bytes, array.start + i);
        if (flag > 1) failAt(array.start + i, "guide " + std::to_string(i) + " is neither 0 nor 1");
        source.set.guides.push_back(flag);
    }
}

struct NpzRow {
    std::string_view name;
    void (*read)(const NpyArray& array, NpzSource source);
};

constexpr std::array kNpzRows{
    NpzRow{"root_uv", readRootUvs}, NpzRow{"widths", readWidths}, NpzRow{"groups", readGroups},
    NpzRow{"guides", readGuides}};

std::string_view keyOf(const ZipMember& member) {
    std::string_view name = member.name;
    if (name.ends_with(kNpyExtension)) name.remove_suffix(kNpyExtension.size());
    return name;
}

const ZipMember* memberNamed(std::span<const ZipMember> members, std::string_view key) {
    const auto at = std::ranges::find(members, key, keyOf);
    return at == members.end() ? nullptr : &*at;
}

bool isStrands(const ZipMember& member, ExpansionLimit& unfolding) {
    if (!member.name.ends_with(kNpyExtension)) return false;
    bool is_strands = false;
    withArray(member, unfolding, [&](const NpyArray& array) {
        is_strands = isFloat(array.type) && array.shape.size() == 3 && array.shape[2] == 3;
    });
    return is_strands;
}

// Returns the member with the positions: by its name, or the only one of their shape.
const ZipMember& positionsOf(std::span<const ZipMember> members, ExpansionLimit& unfolding) {
    if (const ZipMember* named = memberNamed(members, kPositions)) return *named;
    std::string names;
    const ZipMember* found = nullptr;
    std::size_t count = 0;
    for (const ZipMember& member : members) {
        names.append(names.empty() ? "" : ", ").append(inQuotes(keyOf(member)));
        if (!isStrands(member, unfolding)) continue;
        found = &member;
        ++count;
    }
    if (count == 1) return *found;
    failAt(
        0, "there is no array 'positions', and " + std::to_string(count) +
               " of (strands, points, 3) could replace it; the archive has " +
               (names.empty() ? "nothing" : names));
}

// ---- Writing ------------------------------------------------------------------------------------

// Strands resampled as arrays need them.
struct UniformStrands {
    std::optional<StrandSet> resampled;
    std::uint32_t points;  // of a strand
};

UniformStrands uniformStrandsOf(const StrandSet& strands, std::vector<std::string>& warnings) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    UniformStrands uniform{
        makeUniform(
            strands,
            {.least = 1,
             .most = std::numeric_limits<std::uint32_t>::max(),
             .wanted = std::max(greatestSize(strands), 2u)},
            warnings),
        0};
    uniform.points = (uniform.resampled ? *uniform.resampled : strands).ends.front();
    return uniform;
}

void write(std::ostream& out, std::span<const std::byte> bytes) {
    out.write(
        reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

template <class Value>
void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Writes members one after another, then their directory.
class ZipWriter {
public:
    explicit ZipWriter(std::ostream& out) : out_(out) {}

    void
    add(std::string_view key, NpyType type, std::span<const std::uint64_t> shape,
        std::span<const std::byte> numbers) {
        const std::string name = std::string(key).append(kNpyExtension);
        const std::string header = npyHeader(type, shape);
        const std::uint64_t size = header.size() + numbers.size();
        // Offsets have 32 bits, and the rest of the file takes less than 1 KiB.
        if (position_ + size > kZip64 - 1024)
            throw engine::Error("the archive would have 4 GiB or more");
        const std::uint32_t checksum =
            checksumOf(numbers, checksumOf(std::as_bytes(std::span(header))));
        std::string common;  // to both records
        put(common, std::uint16_t{20});  // needed version
        put(common, std::uint16_t{0});
        put(common, std::uint16_t{kStored});
        put(common, std::uint16_t{0});  // time and date: 1 January 1980
        put(common, std::uint16_t{0x21});
        put(common, checksum);
        put(common, static_cast<std::uint32_t>(size));
        put(common, static_cast<std::uint32_t>(size));
        put(common, static_cast<std::uint16_t>(name.size()));
        put(common, std::uint16_t{0});  // extra field

        put(directory_, kCentralSignature);
        put(directory_, std::uint16_t{20});
        directory_ += common;
        put(directory_, std::uint16_t{0});  // comment, disk, attributes
        put(directory_, std::uint16_t{0});
        put(directory_, std::uint16_t{0});
        put(directory_, std::uint32_t{0});
        put(directory_, static_cast<std::uint32_t>(position_));
        directory_ += name;
        ++members_;

        std::string local;
        put(local, kLocalSignature);
        local += common + name + header;
        write(out_, std::as_bytes(std::span(local)));
        write(out_, numbers);
        position_ += local.size() + numbers.size();
    }

    void finish() {
        std::string end;
        put(end, kEndSignature);
        put(end, std::uint32_t{0});
        put(end, members_);
        put(end, members_);
        put(end, static_cast<std::uint32_t>(directory_.size()));
        put(end, static_cast<std::uint32_t>(position_));
        put(end, std::uint16_t{0});
        write(out_, std::as_bytes(std::span(directory_)));
        write(out_, std::as_bytes(std::span(end)));
    }

private:
    std::ostream& out_;
    std::uint64_t position_ = 0;
    std::string directory_;
    std::uint16_t members_ = 0;
};

template <class Element>
std::span<const std::byte> bytesOf(const std::vector<Element>& elements) {
    return std::as_bytes(std::span(elements));
}

}  // namespace

std::string npyHeader(NpyType type, std::span<const std::uint64_t> shape) {
    std::string dictionary = "{'descr': '" + std::string(rowOf(type).name) +
                             "', 'fortran_order': False, 'shape': " + shapeText(shape) + ", }";
    constexpr std::size_t kBefore = 10;
    while ((kBefore + dictionary.size() + 1) % 64 != 0) dictionary += ' ';
    dictionary += '\n';
    std::string header(kNpyMagic);
    header +=
        {'\x01', '\0', static_cast<char>(dictionary.size() & 0xff),
         static_cast<char>(dictionary.size() >> 8)};
    return header + dictionary;
}

// ---- An archive in parts ------------------------------------------------------------------------

namespace {

constexpr std::uint16_t kZip64Version = 45;
constexpr std::uint16_t kChecksumFollows = 8;  // bit 3 of the flags
constexpr std::uint32_t kIn64Bits = 0xffffffff;  // a size or place is in the extra field

// The members that the local and the central record share, up to the length of the name.
std::string commonRecord(std::uint32_t checksum, std::size_t name_size, std::uint16_t extra_size) {
    std::string record;
    put(record, kZip64Version);
    put(record, kChecksumFollows);
    put(record, std::uint16_t{kStored});
    put(record, std::uint16_t{0});  // time and date: 1 January 1980
    put(record, std::uint16_t{0x21});
    put(record, checksum);
    put(record, kIn64Bits);
    put(record, kIn64Bits);
    put(record, static_cast<std::uint16_t>(name_size));
    put(record, extra_size);
    return record;
}

// The extra field that begins with the type 1: 64-bit numbers.
std::string zip64Extra(std::initializer_list<std::uint64_t> numbers) {
    std::string extra;
    put(extra, std::uint16_t{1});
    put(extra, static_cast<std::uint16_t>(8 * numbers.size()));
    for (const std::uint64_t number : numbers) put(extra, number);
    return extra;
}

}  // namespace

void NpzStream::write(std::string_view bytes) {
    hair::groom::write(out_, std::as_bytes(std::span(bytes)));
    position_ += bytes.size();
}

void NpzStream::begin(std::string_view key, NpyType type, std::span<const std::uint64_t> shape) {
    endArray();
    name_ = std::string(key).append(kNpyExtension);
    start_ = position_;
    const std::string extra = zip64Extra({0, 0});
    std::string local;
    put(local, kLocalSignature);
    local += commonRecord(0, name_.size(), static_cast<std::uint16_t>(extra.size()));
    write(local + name_ + extra);
    size_ = checksum_ = 0;
    const std::string header = npyHeader(type, shape);
    append(std::as_bytes(std::span(header)));
}

void NpzStream::append(std::span<const std::byte> numbers) {
    checksum_ = checksumOf(numbers, checksum_);
    hair::groom::write(out_, numbers);
    position_ += numbers.size();
    size_ += numbers.size();
}

void NpzStream::endArray() {
    if (name_.empty()) return;
    std::string descriptor;
    put(descriptor, std::uint32_t{0x08074b50});
    put(descriptor, checksum_);
    put(descriptor, size_);
    put(descriptor, size_);
    write(descriptor);
    const std::string extra = zip64Extra({size_, size_, start_});
    put(directory_, kCentralSignature);
    put(directory_, kZip64Version);
    directory_ += commonRecord(checksum_, name_.size(), static_cast<std::uint16_t>(extra.size()));
    put(directory_, std::uint16_t{0});  // comment, disk, attributes
    put(directory_, std::uint16_t{0});
    put(directory_, std::uint16_t{0});
    put(directory_, std::uint32_t{0});
    put(directory_, kIn64Bits);
    directory_ += name_ + extra;
    ++members_;
    name_.clear();
}

void NpzStream::finish() {
    endArray();
    const std::uint64_t start = position_;
    write(directory_);
    const std::uint64_t end_record = position_;
    std::string end;
    put(end, std::uint32_t{0x06064b50});
    put(end, std::uint64_t{44});  // bytes of this record that follow
    put(end, kZip64Version);
    put(end, kZip64Version);
    put(end, std::uint32_t{0});  // disks
    put(end, std::uint32_t{0});
    put(end, members_);
    put(end, members_);
    put(end, static_cast<std::uint64_t>(directory_.size()));
    put(end, start);
    put(end, std::uint32_t{0x07064b50});  // where that record is
    put(end, std::uint32_t{0});
    put(end, end_record);
    put(end, std::uint32_t{1});
    put(end, kEndSignature);
    put(end, std::uint32_t{0});
    put(end, std::uint16_t{0xffff});
    put(end, std::uint16_t{0xffff});
    put(end, kIn64Bits);
    put(end, kIn64Bits);
    put(end, std::uint16_t{0});
    write(end);
}

// ---- Files of strands ---------------------------------------------------------------------------

std::vector<std::string> exportNpy(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings = leftOut(strands, {});
    const UniformStrands uniform = uniformStrandsOf(strands, warnings);
    const StrandSet& set = uniform.resampled ? *uniform.resampled : strands;
    const std::string header = npyHeader(
        NpyType::float32,
        std::array<std::uint64_t, 3>{set.strandCount(), uniform.points, std::uint64_t{3}});
    write(out, std::as_bytes(std::span(header)));
    write(out, bytesOf(set.points));
    return warnings;
}

std::vector<std::string> exportNpz(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings =
        leftOut(strands, {Part::widths, Part::root_uvs, Part::groups, Part::guides});
    const UniformStrands uniform = uniformStrandsOf(strands, warnings);
    const StrandSet& set = uniform.resampled ? *uniform.resampled : strands;
    const std::uint64_t count = set.strandCount();
    const std::uint64_t points = uniform.points;
    ZipWriter zip(out);
    zip.add(
        kPositions, NpyType::float32, std::array{count, points, std::uint64_t{3}},
        bytesOf(set.points));
    if (!set.root_uvs.empty())
        zip.add(
            "root_uv", NpyType::float32, std::array{count, std::uint64_t{2}},
            bytesOf(set.root_uvs));
    if (set.widths.known()) {
        std::vector<float> everywhere;
        if (set.widths.values.empty()) everywhere.resize(set.points.size(), set.widths.at(0));
        zip.add(
            "widths", NpyType::float32, std::array{count, points},
            bytesOf(everywhere.empty() ? set.widths.values : everywhere));
    }
    if (!set.groups.empty())
        zip.add("groups", NpyType::int32, std::array{count}, bytesOf(set.groups));
    if (!set.guides.empty())
        zip.add("guides", NpyType::uint8, std::array{count}, bytesOf(set.guides));
    zip.finish();
    return warnings;
}

StrandSet importNpy(const StrandFile& file) { return strandsOf(readNpy(file.bytes)); }

StrandSet importNpz(const StrandFile& file) {
    const std::vector<ZipMember> members = readMembers(file.bytes);
    ExpansionLimit unfolding(file.bytes.size());
    const ZipMember& positions = positionsOf(members, unfolding);
    StrandSet set;
    withArray(positions, unfolding, [&](const NpyArray& array) { set = strandsOf(array); });
    std::string skipped;
    for (const ZipMember& member : members) {
        if (&member == &positions) continue;
        if (memberNamed(members, keyOf(member)) != &member)
            failAt(member.start, inQuotes(member.name) + " appears twice");
        const auto row = std::ranges::find(kNpzRows, keyOf(member), &NpzRow::name);
        if (row == kNpzRows.end()) {
            skipped.append(skipped.empty() ? "" : ", ").append(inQuotes(keyOf(member)));
            continue;
        }
        withArray(member, unfolding, [&](const NpyArray& array) {
            row->read(array, {set, set.strandCount(), set.ends.front()});
        });
    }
    if (!skipped.empty()) set.warnings.push_back("the arrays " + skipped + " are left out");
    return set;
}

}  // namespace hair::groom
