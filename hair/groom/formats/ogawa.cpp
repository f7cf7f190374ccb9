#include "hair/groom/formats/ogawa.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t kDataBit = std::uint64_t{1} << 63;
constexpr std::uint64_t kFileHeader = 16;  // bytes
constexpr std::uint64_t kWord = sizeof(std::uint64_t);
constexpr std::uint64_t kSampleKey = 16;    // bytes before a sample's elements
constexpr std::uint64_t kObjectHashes = 32;  // bytes after the headers of an object's children
constexpr std::size_t kLongestName = 1024;
constexpr std::uint32_t kDeepest = 64;
constexpr std::uint8_t kMetadataFollows = 0xff;

struct AlembicTypeRow {
    std::string_view name;
    std::size_t size;
};

// In the order of the enumerators, which are the numbers in files.
constexpr std::array kAlembicTypes{
    AlembicTypeRow{"bool", 1},   AlembicTypeRow{"uint8", 1},    AlembicTypeRow{"int8", 1},
    AlembicTypeRow{"uint16", 2}, AlembicTypeRow{"int16", 2},    AlembicTypeRow{"uint32", 4},
    AlembicTypeRow{"int32", 4},  AlembicTypeRow{"uint64", 8},   AlembicTypeRow{"int64", 8},
    AlembicTypeRow{"half", 2},   AlembicTypeRow{"float", 4},    AlembicTypeRow{"double", 8},
    AlembicTypeRow{"text", 0},   AlembicTypeRow{"wide text", 0}};

// Takes values one after another from a part of the file.
class AlembicCursor {
public:
    AlembicCursor(
        std::span<const std::byte> bytes, std::uint64_t start, std::uint64_t size,
        const std::string& path)
        : bytes_(bytes), at_(start), end_(start + size), path_(path) {}

    std::uint64_t at() const { return at_; }
    bool atEnd() const { return at_ == end_; }
    [[noreturn]] void fail(const std::string& reason) const { failIn(at_, path_, reason); }

    // `size`: 1, 2 or 4 bytes.
    std::uint32_t number(std::uint64_t size, std::string_view what) {
        need(size, what);
        std::uint32_t value = 0;
        std::memcpy(&value, bytes_.data() + at_, size);
        at_ += size;
        return value;
    }

    std::string_view text(std::uint64_t size, std::string_view what) {
        need(size, what);
        const auto* const first = reinterpret_cast<const char*>(bytes_.data() + at_);
        at_ += size;
        return {first, size};
    }

    std::string_view name(std::uint64_t size) {
        if (size == 0 || size > kLongestName)
            fail("a name of " + std::to_string(size) + " bytes, expected 1 to 1024");
        const std::string_view taken = text(size, "a name");
        if (taken.find('\0') != std::string_view::npos) fail("a name with a NUL");
        return taken;
    }

private:
    void need(std::uint64_t size, std::string_view what) const {
        if (size <= end_ - at_) return;
        fail(
            std::string(what) + " of " + std::to_string(size) + " bytes is expected, but only " +
            std::to_string(end_ - at_) + " are left in the headers");
    }

    std::span<const std::byte> bytes_;
    std::uint64_t at_;
    std::uint64_t end_;
    const std::string& path_;
};

// The word before a property in the headers of a compound.
struct PropertyInfo {
    std::uint32_t word;

    AlembicKind kind() const {
        return (word & 3) == 0   ? AlembicKind::compound
               : (word & 3) == 1 ? AlembicKind::scalar
                                 : AlembicKind::array;
    }
    std::uint32_t sizeHint() const { return word >> 2 & 3; }  // numbers of 1, 2, 4 bytes
    std::uint32_t type() const { return word >> 4 & 15; }
    bool hasTimeSampling() const { return (word & 0x100) != 0; }
    bool hasChanges() const { return (word & 0x200) != 0; }
    bool isConstant() const { return (word & 0x800) != 0; }
    auto extent() const { return static_cast<std::uint8_t>(word >> 12 & 0xff); }
    auto metadata() const { return static_cast<std::uint8_t>(word >> 20 & 0xff); }
};

// Counts the samples that are stored: the first, and those from the first change to the last.
std::uint64_t storedSamples(
    AlembicCursor& cursor, const PropertyInfo& info, std::uint64_t number_size,
    std::uint32_t samples, std::uint32_t& first_change) {
    std::uint32_t first = 1;
    std::uint32_t last = samples == 0 ? 0 : samples - 1;
    if (info.hasChanges()) {
        first = cursor.number(number_size, "the first change");
        last = cursor.number(number_size, "the last change");
    } else if (info.isConstant()) {
        first = 0;
        last = 0;
    }
    first_change = first;
    if (samples == 0) return 0;
    if (last >= samples || (last != 0 && (first == 0 || first > last)))
        cursor.fail(
            "changes from sample " + std::to_string(first) + " to " + std::to_string(last) +
            " of " + std::to_string(samples));
    return last == 0 ? 1 : std::uint64_t{last} - first + 2;
}

}  // namespace

void failIn(std::uint64_t byte, const std::string& path, const std::string& reason) {
    failAt(byte, path.empty() ? reason : path + ": " + reason);
}

std::string_view nameOf(AlembicType type) {
    return kAlembicTypes[static_cast<std::size_t>(type)].name;
}

std::size_t sizeOf(AlembicType type) { return kAlembicTypes[static_cast<std::size_t>(type)].size; }

std::string_view alembicValue(std::string_view metadata, std::string_view key) {
    while (!metadata.empty()) {
        const std::size_t end = std::min(metadata.find(';'), metadata.size());
        const std::string_view token = metadata.substr(0, end);
        if (token.size() > key.size() && token.starts_with(key) && token[key.size()] == '=')
            return token.substr(key.size() + 1);
        metadata.remove_prefix(std::min(end + 1, metadata.size()));
    }
    return {};
}

// ---- Ogawa --------------------------------------------------------------------------------------

void AlembicArchive::claim(std::uint64_t byte, const Claim& wanted, const std::string& path) {
    const auto after = claims_.lower_bound(byte);
    if (after != claims_.end() && after->first == byte) {
        // Equal samples are often stored once.
        if (after->second.is_group || wanted.is_group)
            failIn(byte, path, "a group that is part of two, or of itself");
        return;
    }
    const bool is_into_next = after != claims_.end() && after->first < wanted.end;
    const bool is_in_last = after != claims_.begin() && std::prev(after)->second.end > byte;
    if (is_into_next || is_in_last) failIn(byte, path, "overlaps another part of the archive");
    claims_.emplace_hint(after, byte, wanted);
}

AlembicArchive::Group AlembicArchive::openGroup(std::uint64_t byte, const std::string& path) {
    if (byte == 0) return {0, 0};
    if (byte > bytes_.size() || bytes_.size() - byte < kWord)
        failIn(
            byte, path,
            "truncated: a group is expected, but the file ends at byte " +
                std::to_string(bytes_.size()));
    const auto count = valueAt<std::uint64_t>(bytes_, byte);
    const std::uint64_t start = byte + kWord;
    if (count == 0) failIn(byte, path, "a group is empty");
    if (count > (bytes_.size() - start) / kWord)
        failIn(byte, path, "truncated: a group of " + std::to_string(count) + " is expected");
    claim(byte, {start + count * kWord, true}, path);
    return {start, count};
}

std::uint64_t AlembicArchive::offsetOf(const Group& group, std::uint64_t child) const {
    return valueAt<std::uint64_t>(bytes_, group.start + child * kWord);
}

std::uint64_t
AlembicArchive::groupOf(const Group& group, std::uint64_t child, const std::string& path) const {
    const std::uint64_t offset = offsetOf(group, child);
    if ((offset & kDataBit) != 0)
        failIn(group.start + child * kWord, path, "data instead of the expected group");
    return offset;
}

AlembicArchive::Data
AlembicArchive::dataOf(const Group& group, std::uint64_t child, const std::string& path) {
    const std::uint64_t offset = offsetOf(group, child);
    const std::uint64_t here = group.start + child * kWord;
    if ((offset & kDataBit) == 0) failIn(here, path, "a group instead of the expected data");
    const std::uint64_t byte = offset & ~kDataBit;
    if (byte == 0) return {0, 0};
    if (byte > bytes_.size() || bytes_.size() - byte < kWord)
        failIn(
            here, path,
            "truncated: data at byte " + std::to_string(byte) +
                " are expected, but the file ends at byte " + std::to_string(bytes_.size()));
    const auto size = valueAt<std::uint64_t>(bytes_, byte);
    const std::uint64_t start = byte + kWord;
    if (size > bytes_.size() - start)
        failIn(byte, path, "truncated: " + std::to_string(size) + " bytes of data are expected");
    claim(byte, {start + size, false}, path);
    return {start, size};
}

std::string_view AlembicArchive::textOf(const Data& data) const {
    return {reinterpret_cast<const char*>(bytes_.data() + data.start), data.size};
}

AlembicArchive::AlembicArchive(std::span<const std::byte> bytes, std::uint32_t sample)
    : bytes_(bytes), sample_(sample) {
    constexpr auto kMagic = "Ogawa"sv;
    const auto head = textOf({0, std::min<std::uint64_t>(bytes.size(), kFileHeader)});
    if (!head.starts_with(kMagic.substr(0, std::min(kMagic.size(), head.size()))))
        failAt(0, "an Alembic archive begins with \"Ogawa\"");
    if (head.size() < kFileHeader) failAt(bytes.size(), "truncated: the header alone is 16 bytes");
    if (head[5] != '\xff') failAt(5, "the archive was not finished: export it once more");
    if (head[6] != 0 || head[7] != 1) failAt(6, "the version of Ogawa is not 1");
    claims_.emplace(0, Claim{kFileHeader, true});

    const auto root_byte = valueAt<std::uint64_t>(bytes, kWord);
    if ((root_byte & kDataBit) != 0 || root_byte == 0) failAt(kWord, "there is no root group");
    const Group root = openGroup(root_byte, "");
    if (root.count < 6)
        failAt(root_byte, "a root group of " + std::to_string(root.count) + ", expected 6");
    const auto versionAt = [&](std::uint64_t child) {
        const Data data = dataOf(root, child, "");
        if (data.size != sizeof(std::int32_t)) failAt(data.start, "a version is an int32");
        return std::pair{data.start, valueAt<std::int32_t>(bytes, data.start)};
    };
    const auto [layout_byte, layout] = versionAt(0);
    if (layout != 0)
        failAt(layout_byte, "version " + std::to_string(layout) + " of the layout, expected 0");
    const auto [library_byte, library] = versionAt(1);
    if (library < 9999)
        failAt(library_byte, "Alembic " + std::to_string(library) + ", expected 9999 or later");
    dataOf(root, 3, "");
    time_samplings_ = dataOf(root, 4, "");
    readMetadata(dataOf(root, 5, ""));
    top_.metadata = textOf(dataOf(root, 3, ""));
    top_.group = groupOf(root, 2, "");
}

// A time sampling is the greatest number of samples of a property with it, the seconds of a cycle,
// and the times of the samples in a cycle. A cycle of more than 10^300 s stands for none: then
// there is a time for each sample.
std::vector<double>
AlembicArchive::timesOf(std::uint32_t time_sampling, std::uint32_t samples) const {
    constexpr double kNoCycle = 1e300;
    const std::uint64_t end = time_samplings_.start + time_samplings_.size;
    std::uint64_t at = time_samplings_.start;
    const auto need = [&](std::uint64_t size) {
        if (size > end - at) failAt(at, "truncated: a time sampling is expected");
    };
    for (std::uint32_t i = 0;; ++i) {
        constexpr std::uint64_t kHead = 4 + 8 + 4;
        need(kHead);
        const auto cycle = valueAt<double>(bytes_, at + 4);
        const auto count = valueAt<std::uint32_t>(bytes_, at + 12);
        at += kHead;
        need(std::uint64_t{count} * 8);
        if (i < time_sampling) {
            at += std::uint64_t{count} * 8;
            continue;
        }
        const std::vector<double> own = arrayAt<double>(bytes_, at, count);
        const bool has_cycle = cycle < kNoCycle;
        if (own.empty() || (!has_cycle && own.size() < samples))
            failAt(
                at, std::to_string(own.size()) + " times, but there are " +
                        std::to_string(samples) + " samples");
        std::vector<double> times;
        for (std::uint32_t s = 0; s < samples; ++s) {
            const double cycles = has_cycle ? static_cast<double>(s / count) : 0.0;
            times.push_back(own[has_cycle ? s % count : s] + (has_cycle ? cycles * cycle : 0.0));
            const bool ascends = s == 0 || times[s] > times[s - 1];
            if (!std::isfinite(times[s]) || !ascends) failAt(at, "times of samples don't ascend");
        }
        return times;
    }
}

void AlembicArchive::readMetadata(const Data& data) {
    metadata_.emplace_back();  // number 0 is none
    const std::string path;
    AlembicCursor cursor(bytes_, data.start, data.size, path);
    while (!cursor.atEnd()) {
        const std::uint32_t size = cursor.number(1, "the length of metadata");
        metadata_.push_back(cursor.text(size, "metadata"));
        if (metadata_.size() > kMetadataFollows) cursor.fail("more than 254 numbered metadata");
    }
}

// ---- Properties and objects ---------------------------------------------------------------------

std::vector<AlembicProperty>
AlembicArchive::readProperties(std::uint64_t byte, const std::string& path, std::uint32_t depth) {
    const Group group = openGroup(byte, path);
    if (group.count == 0) return {};
    if (depth > kDeepest) failIn(byte, path, "more than 64 levels of properties");
    const std::uint64_t count = group.count - 1;  // without their headers
    const Data headers = dataOf(group, count, path);
    std::vector<AlembicProperty> properties;
    AlembicCursor cursor(bytes_, headers.start, headers.size, path);
    while (!cursor.atEnd()) {
        if (properties.size() == count)
            cursor.fail("more headers than the " + std::to_string(count) + " properties");
        AlembicProperty property{.header = cursor.at(), .depth = depth};
        const PropertyInfo info{cursor.number(4, "a property's header")};
        property.kind = info.kind();
        if (info.sizeHint() == 3) cursor.fail("numbers of an unknown size");
        const std::uint64_t number_size = std::uint64_t{1} << info.sizeHint();
        if (property.kind != AlembicKind::compound) {
            if (info.type() >= kAlembicTypes.size())
                cursor.fail("values of the unknown type " + std::to_string(info.type()));
            property.type = static_cast<AlembicType>(info.type());
            property.extent = info.extent();
            if (property.extent == 0) cursor.fail("elements with no numbers");
            property.samples = cursor.number(number_size, "the number of samples");
            property.stored =
                storedSamples(cursor, info, number_size, property.samples, property.first_change);
            if (info.hasTimeSampling())
                property.time_sampling = cursor.number(number_size, "the time sampling");
        }
        property.name = cursor.name(cursor.number(number_size, "the length of a name"));
        if (info.metadata() == kMetadataFollows) {
            const std::uint32_t size = cursor.number(number_size, "the length of metadata");
            property.metadata = cursor.text(size, "metadata");
        } else if (info.metadata() < metadata_.size()) {
            property.metadata = metadata_[info.metadata()];
        } else {
            cursor.fail("metadata of the unknown number " + std::to_string(info.metadata()));
        }
        property.group = groupOf(group, properties.size(), path);
        properties.push_back(property);
    }
    if (properties.size() != count)
        failIn(
            headers.start, path,
            "headers of " + std::to_string(properties.size()) + " properties, but there are " +
                std::to_string(count));
    return properties;
}

std::vector<AlembicObject> AlembicArchive::readChildren(
    const Group& group, const AlembicObject& object, const std::string& path) {
    if (group.count < 2) return {};
    const std::uint64_t count = group.count - 2;  // without properties and headers
    const Data headers = dataOf(group, group.count - 1, path);
    const bool has_hashes = headers.size >= kObjectHashes;
    if (!has_hashes && headers.size != 0)
        failIn(headers.start, path, "headers of objects end in 32 bytes of hashes");
    std::vector<AlembicObject> children;
    AlembicCursor cursor(
        bytes_, headers.start, has_hashes ? headers.size - kObjectHashes : 0, path);
    while (!cursor.atEnd()) {
        if (children.size() == count)
            cursor.fail("more headers than the " + std::to_string(count) + " objects");
        AlembicObject child{.depth = object.depth + 1};
        const std::uint32_t size = cursor.number(4, "the length of a name");
        child.name = cursor.name(size);
        if (child.name.find('/') != std::string_view::npos) cursor.fail("a name with a slash");
        if (child.depth > kDeepest) cursor.fail("more than 64 levels of objects");
        const auto metadata = static_cast<std::uint8_t>(cursor.number(1, "metadata"));
        if (metadata == kMetadataFollows) {
            const std::uint32_t length = cursor.number(4, "the length of metadata");
            child.metadata = cursor.text(length, "metadata");
        } else if (metadata < metadata_.size()) {
            child.metadata = metadata_[metadata];
        } else {
            cursor.fail("metadata of the unknown number " + std::to_string(metadata));
        }
        child.group = groupOf(group, children.size() + 1, path);
        children.push_back(child);
    }
    if (children.size() != count)
        failIn(
            headers.start, path,
            "headers of " + std::to_string(children.size()) + " objects, but there are " +
                std::to_string(count));
    return children;
}

AlembicContents AlembicArchive::contentsOf(const AlembicObject& object, const std::string& path) {
    const Group group = openGroup(object.group, path);
    if (group.count == 0) return {};
    AlembicContents contents;
    contents.properties = readProperties(groupOf(group, 0, path), path, 0);
    contents.children = readChildren(group, object, path);
    return contents;
}

std::vector<AlembicProperty>
AlembicArchive::propertiesOf(const AlembicProperty& compound, const std::string& path) {
    return readProperties(compound.group, path, compound.depth + 1);
}

// ---- Samples ------------------------------------------------------------------------------------

std::optional<AlembicElements>
AlembicArchive::sampleOf(const AlembicProperty& property, const std::string& path) {
    const Group group = openGroup(property.group, path);
    const bool is_array = property.kind == AlembicKind::array;
    const std::uint64_t each = is_array ? 2 : 1;
    if (group.count != property.stored * each)
        failIn(
            property.header, path,
            std::to_string(group.count) + " parts, but there are " +
                std::to_string(property.stored) + " samples of " + std::to_string(each));
    if (group.count == 0) return {};
    const std::uint64_t stored =
        sample_ < property.first_change || property.stored == 1
            ? 0
            : std::min<std::uint64_t>(sample_ - property.first_change + 1, property.stored - 1);
    const Data data = dataOf(group, stored * each, path);
    if (data.size != 0 && data.size < kSampleKey)
        failIn(data.start, path, "a sample begins with 16 bytes of a hash");
    const std::uint64_t key = data.size == 0 ? 0 : kSampleKey;
    const std::uint64_t size = data.size - key;
    const bool is_text = sizeOf(property.type) == 0;
    const std::uint64_t element = is_text ? 1 : sizeOf(property.type) * property.extent;
    if (size % element != 0)
        failIn(
            data.start, path,
            std::to_string(size) + " bytes, which is not a multiple of " + std::to_string(element));
    const AlembicElements elements{data.start + key, size / element};
    if (!is_array && !is_text && elements.count != 1)
        failIn(data.start, path, "a scalar of " + std::to_string(elements.count));
    if (!is_array || is_text) return elements;

    const Data dimensions = dataOf(group, stored * each + 1, path);
    if (dimensions.size % kWord != 0)
        failIn(dimensions.start, path, "dimensions are of 64 bits each");
    std::uint64_t product = 1;
    for (std::uint64_t i = 0; i < dimensions.size / kWord; ++i) {
        const auto length = valueAt<std::uint64_t>(bytes_, dimensions.start + i * kWord);
        if (length != 0 && product > elements.count / length)
            failIn(dimensions.start, path, "more elements than the sample has");
        product *= length;
    }
    if (dimensions.size > 0 && product != elements.count)
        failIn(
            dimensions.start, path,
            std::to_string(product) + " elements, but the sample has " +
                std::to_string(elements.count));
    return elements;
}

}  // namespace hair::groom
