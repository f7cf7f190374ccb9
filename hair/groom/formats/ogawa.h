#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Archives of Alembic 1.5 and later (Ogawa): the objects, properties and samples of a file, without
// their meaning. The layout is that of Alembic's AbcCoreOgawa and Ogawa (Sony Pictures Imageworks,
// Lucasfilm), all little-endian:
//   file        "Ogawa", 0xff if it was written to its end, 0, 1, the offset of the root group
//   group       uint64 count, then an offset for each child; the top bit marks data. Offset 0
//               stands for an empty child
//   data        uint64 size, then bytes
//   root        int32 0, int32 version of the library, the top object, metadata, time samplings,
//               metadata by number (a byte's length and a text each)
//   object      a group: its properties, its child objects, data with the children's headers
//   compound    a group: its properties, data with their headers
//   scalar      a group: data of each sample that differs from the one before
//   array       a group: data of each such sample and data of its dimensions
//   sample      16 bytes of a hash, then numbers, or texts that each end in NUL
namespace hair::groom {

enum class AlembicType : std::uint8_t {
    boolean,
    uint8,
    int8,
    uint16,
    int16,
    uint32,
    int32,
    uint64,
    int64,
    float16,
    float32,
    float64,
    text,
    wide_text
};

std::string_view nameOf(AlembicType type);
std::size_t sizeOf(AlembicType type);  // bytes of a number; 0: texts

// Returns a key's value in an object's or property's "key=value;..."; empty if it has none.
std::string_view alembicValue(std::string_view metadata, std::string_view key);

enum class AlembicKind : std::uint8_t { compound, scalar, array };

struct AlembicProperty {
    std::string_view name;
    std::string_view metadata;
    AlembicKind kind = AlembicKind::compound;
    AlembicType type = AlembicType::boolean;
    std::uint8_t extent = 1;  // numbers of an element
    std::uint32_t samples = 0;
    std::uint64_t stored = 0;  // samples that are in the file
    std::uint32_t first_change = 1;  // sample; those before it are equal to the first
    std::uint32_t time_sampling = 0;  // number
    std::uint64_t group = 0;  // byte; 0: empty
    std::uint64_t header = 0;  // byte, for messages
    std::uint32_t depth = 0;  // of compounds

    bool isOf(AlembicType wanted, std::uint8_t wanted_extent) const {
        return kind != AlembicKind::compound && type == wanted && extent == wanted_extent;
    }
};

struct AlembicObject {
    std::string_view name;  // empty: the top object
    std::string_view metadata;
    std::uint64_t group = 0;  // byte; 0: empty
    std::uint32_t depth = 0;
};

struct AlembicContents {
    std::vector<AlembicProperty> properties;
    std::vector<AlembicObject> children;
};

// Elements of a sample, known to be complete in the file.
struct AlembicElements {
    std::uint64_t start = 0;  // byte of the first
    std::uint64_t count = 0;  // number of elements; for texts, of their bytes
};

// Throws engine::Error "byte N: path: reason", without the path if it is empty.
[[noreturn]] void failIn(std::uint64_t byte, const std::string& path, const std::string& reason);

// Reads the requested parts and refuses malformed ones: counts and offsets beyond the file, groups
// that are part of two others or of themselves, chunks that overlap, more than 64 levels. Its
// functions throw engine::Error "byte N: path: reason".
class AlembicArchive {
public:
    // `sample`: number of the sample that sampleOf() returns; after a property's last it is that.
    explicit AlembicArchive(std::span<const std::byte> bytes, std::uint32_t sample = 0);

    // Returns the times of a time sampling's first samples, in s, ascending. Throws if it has
    // fewer.
    std::vector<double> timesOf(std::uint32_t time_sampling, std::uint32_t samples) const;

    const AlembicObject& top() const { return top_; }

    // Each function may be called once for an object, compound or other property, because it
    // claims the parts that it reads. `path` is the path of its argument, for messages, such as
    // "/hair/strands/.geom".
    AlembicContents contentsOf(const AlembicObject& object, const std::string& path);
    std::vector<AlembicProperty>
    propertiesOf(const AlembicProperty& compound, const std::string& path);
    // Returns the archive's sample of a scalar or array; absent if it has none.
    std::optional<AlembicElements>
    sampleOf(const AlembicProperty& property, const std::string& path);

    std::span<const std::byte> bytes() const { return bytes_; }

private:
    struct Group {
        std::uint64_t start;  // byte of the first child's offset
        std::uint64_t count;
    };
    struct Data {
        std::uint64_t start;
        std::uint64_t size;
    };
    struct Claim {
        std::uint64_t end;
        bool is_group;
    };

    void claim(std::uint64_t byte, const Claim& wanted, const std::string& path);
    Group openGroup(std::uint64_t byte, const std::string& path);
    std::uint64_t offsetOf(const Group& group, std::uint64_t child) const;
    std::uint64_t groupOf(const Group& group, std::uint64_t child, const std::string& path) const;
    Data dataOf(const Group& group, std::uint64_t child, const std::string& path);
    std::string_view textOf(const Data& data) const;
    void readMetadata(const Data& data);
    std::vector<AlembicProperty>
    readProperties(std::uint64_t byte, const std::string& path, std::uint32_t depth);
    std::vector<AlembicObject>
    readChildren(const Group& group, const AlembicObject& object, const std::string& path);

    std::span<const std::byte> bytes_;
    std::map<std::uint64_t, Claim> claims_;  // by their first byte
    std::vector<std::string_view> metadata_;  // by number
    std::uint32_t sample_;
    Data time_samplings_{};
    AlembicObject top_;
};

}  // namespace hair::groom
