#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/ogawa.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- Hashes -------------------------------------------------------------------------------------

std::uint64_t murmurMix(std::uint64_t x) {
    x = (x ^ x >> 33) * 0xff51afd7ed558ccd;
    x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53;
    return x ^ x >> 33;
}

// MurmurHash3 x64 128 (Austin Appleby, public domain) with seed 0. Alembic's readers recognise
// equal samples by it.
std::string murmurOf(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kFirst = 0x87c37b91114253d5;
    constexpr std::uint64_t kSecond = 0x4cf5ad432745937f;
    std::uint64_t h1 = 0;
    std::uint64_t h2 = 0;
    const auto first = [&](std::uint64_t k) { return std::rotl(k * kFirst, 31) * kSecond; };
    const auto second = [&](std::uint64_t k) { return std::rotl(k * kSecond, 33) * kFirst; };
    const std::size_t blocks = bytes.size() / 16;
    for (std::size_t i = 0; i < blocks; ++i) {
        h1 ^= first(valueAt<std::uint64_t>(bytes, 16 * i));
        h1 = (std::rotl(h1, 27) + h2) * 5 + 0x52dce729;
        h2 ^= second(valueAt<std::uint64_t>(bytes, 16 * i + 8));
        h2 = (std::rotl(h2, 31) + h1) * 5 + 0x38495ab5;
    }
    std::array<std::uint64_t, 2> tail{};
    const auto rest = bytes.subspan(16 * blocks);
    if (!rest.empty()) std::memcpy(tail.data(), rest.data(), rest.size());
    h1 ^= first(tail[0]);
    h2 ^= second(tail[1]);
    h1 ^= bytes.size();
    h2 ^= bytes.size();
    h1 += h2;
    h2 += h1;
    h1 = murmurMix(h1);
    h2 = murmurMix(h2);
    h1 += h2;
    h2 += h1;
    const std::array hash{h1, h2};
    return {reinterpret_cast<const char*>(hash.data()), sizeof hash};
}

std::string murmurOf(std::string_view text) { return murmurOf(std::as_bytes(std::span(text))); }

// ---- The archive --------------------------------------------------------------------------------

constexpr std::uint64_t kOgawaData = std::uint64_t{1} << 63;
constexpr std::size_t kKeySize = 16;  // bytes of a sample's hash
constexpr std::uint64_t kOgawaHead = 16;  // bytes before the first group or data

template <class Value>
void append(std::string& bytes, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Groups and data, each with its place in the file. Borrowed data must live until it is written.
class OgawaWriter {
public:
    // `position`: where the first of them begins in the file.
    explicit OgawaWriter(std::uint64_t position = kOgawaHead) : position_(position) {}

    std::uint64_t data(std::string own, std::span<const std::byte> borrowed = {}) {
        const std::uint64_t size = own.size() + borrowed.size();
        if (size == 0) return kOgawaData;
        return add({size, std::move(own), borrowed}) | kOgawaData;
    }

    std::uint64_t group(std::span<const std::uint64_t> children) {
        if (children.empty()) return 0;
        const auto bytes = std::as_bytes(children);
        return add(
            {children.size(),
             std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
             {}});
    }

    // Returns the number of a text in the table of metadata.
    std::uint8_t metadata(std::string_view text) {
        if (text.empty()) return 0;
        const auto at = std::ranges::find(metadata_, text);
        const auto number = static_cast<std::uint8_t>(at - metadata_.begin() + 1);
        if (at == metadata_.end()) metadata_.emplace_back(text);
        return number;
    }

    // Adds the root, with samples at 0 s, and `frames` of them if there are any. Returns its place.
    std::uint64_t
    root(std::uint64_t top, const std::string& about, std::uint32_t frames, double frame_time) {
        std::string zero;
        append(zero, std::int32_t{0});
        std::string library;
        append(library, std::int32_t{10803});  // like archives of Alembic 1.8.3
        std::string sampling;
        append(sampling, std::uint32_t{1});
        append(sampling, 1.0);
        append(sampling, std::uint32_t{1});
        append(sampling, 0.0);
        if (frames > 0) {
            append(sampling, frames);
            append(sampling, frame_time);
            append(sampling, std::uint32_t{1});
            append(sampling, 0.0);
        }
        std::string all;
        for (const std::string& text : metadata_) {
            all += static_cast<char>(text.size());
            all += text;
        }
        const std::array children{data(zero),  data(library),  top,
                                  data(about), data(sampling), data(all)};
        return group(children);
    }

    void write(std::ostream& out) const {
        for (const Chunk& chunk : chunks_) {
            writeValue(out, chunk.head);
            out.write(chunk.own.data(), static_cast<std::streamsize>(chunk.own.size()));
            out.write(
                reinterpret_cast<const char*>(chunk.borrowed.data()),
                static_cast<std::streamsize>(chunk.borrowed.size()));
        }
    }

private:
    struct Chunk {
        std::uint64_t head;  // the size of data, the number of a group's children
        std::string own;
        std::span<const std::byte> borrowed;
    };

    std::uint64_t add(Chunk chunk) {
        const std::uint64_t place = position_;
        position_ += sizeof chunk.head + chunk.own.size() + chunk.borrowed.size();
        chunks_.push_back(std::move(chunk));
        return place;
    }

    std::vector<Chunk> chunks_;
    std::uint64_t position_;
    std::vector<std::string> metadata_;
};

// Begins a file with the place of its root.
void writeHead(std::ostream& out, std::uint64_t root) {
    out.write("Ogawa\xff\0\1", 8);
    writeValue(out, root);
}

// Properties of an object or a property.
class OgawaCompound {
public:
    explicit OgawaCompound(OgawaWriter& writer) : writer_(&writer) {}

    void scalar(
        std::string_view name, std::string_view metadata, AlembicType type, std::uint8_t extent,
        std::span<const std::byte> element) {
        const std::array children{sample(element)};
        header(name, metadata, 1, type, extent);
        children_.push_back(writer_->group(children));
    }

    // Adds an array of at least one number.
    void array(
        std::string_view name, std::string_view metadata, AlembicType type, std::uint8_t extent,
        std::span<const std::byte> elements) {
        const bool is_one = elements.size() == sizeOf(type) * extent;
        const std::array children{sample(elements), kOgawaData};  // dimensions follow from the size
        header(name, metadata, is_one ? 3 : 2, type, extent);
        children_.push_back(writer_->group(children));
    }

    // Adds a scalar or an array of a sample per frame, in the second time sampling. `places` are of
    // the samples, each of an array followed by that of its dimensions; `keys` are their hashes.
    void moving(
        std::string_view name, std::string_view metadata, AlembicKind kind, AlembicType type,
        std::uint8_t extent, std::uint32_t samples, std::span<const std::uint64_t> places,
        std::string_view keys) {
        constexpr std::uint32_t kWide = 2 << 2;  // numbers have 32 bits
        constexpr std::uint32_t kHasSampling = 0x100;
        constexpr std::uint32_t kOneSize = 0x400;
        const std::uint32_t constant = samples == 1 ? 0x800 : 0;
        append(
            headers_, (kind == AlembicKind::scalar ? 1u : 2u) | kWide |
                          static_cast<std::uint32_t>(type) << 4 | kHasSampling | kOneSize |
                          constant | std::uint32_t{extent} << 12 |
                          static_cast<std::uint32_t>(writer_->metadata(metadata)) << 20);
        append(headers_, samples);
        append(headers_, std::uint32_t{1});  // time sampling
        append(headers_, static_cast<std::uint32_t>(name.size()));
        headers_ += name;
        keys_.append(keys).append(name);
        children_.push_back(writer_->group(places));
    }

    // Adds a compound; `inner` must be complete.
    void compound(std::string_view name, std::string_view metadata, OgawaCompound& inner) {
        children_.push_back(inner.finish());
        keys_ += inner.keys_;
        append(headers_, static_cast<std::uint32_t>(writer_->metadata(metadata)) << 20);
        named(name);
    }

    std::uint64_t finish() {
        if (children_.empty()) return 0;
        children_.push_back(writer_->data(std::move(headers_)));
        return writer_->group(children_);
    }

    std::string hash() const { return murmurOf(keys_); }

private:
    std::uint64_t sample(std::span<const std::byte> elements) {
        const std::string key = murmurOf(elements);
        keys_ += key;
        return writer_->data(key, elements);
    }

    void header(
        std::string_view name, std::string_view metadata, std::uint32_t kind, AlembicType type,
        std::uint8_t extent) {
        constexpr std::uint32_t kOneSample = 0x400 | 0x800;  // one size, and the same value at all
                                                             // times
        append(
            headers_, kind | static_cast<std::uint32_t>(type) << 4 | kOneSample |
                          std::uint32_t{extent} << 12 |
                          static_cast<std::uint32_t>(writer_->metadata(metadata)) << 20);
        append(headers_, std::uint8_t{1});  // sample
        named(name);
    }

    void named(std::string_view name) {
        append(headers_, static_cast<std::uint8_t>(name.size()));
        headers_ += name;
        keys_ += name;
    }

    OgawaWriter* writer_;
    std::vector<std::uint64_t> children_;
    std::string headers_;
    std::string keys_;  // of its contents, for the hash
};

struct OgawaObject {
    std::uint64_t group;
    std::string hashes;
};

// Writes an object with one child, or with none if `child` is null.
OgawaObject writeObject(
    OgawaWriter& writer, OgawaCompound& properties, const OgawaObject* child = nullptr,
    std::string_view child_name = {}, std::string_view child_metadata = {}) {
    std::string headers;
    std::vector<std::uint64_t> children{properties.finish()};
    if (child) {
        children.push_back(child->group);
        append(headers, static_cast<std::uint32_t>(child_name.size()));
        headers += child_name;
        headers += static_cast<char>(writer.metadata(child_metadata));
    }
    const std::string hashes = properties.hash() + murmurOf(child ? child->hashes : "");
    children.push_back(writer.data(headers + hashes));
    return {writer.group(children), hashes};
}

// ---- Strands ------------------------------------------------------------------------------------

template <class Element>
std::span<const std::byte> bytesIn(const std::vector<Element>& elements) {
    return std::as_bytes(std::span(elements));
}

template <class Value>
std::span<const std::byte> bytesIn(const PointAttribute<Value>& attribute) {
    if (!attribute.values.empty()) return bytesIn(attribute.values);
    return std::as_bytes(std::span(&*attribute.everywhere, 1));
}

template <class Value>
std::span<const std::byte> bytesOfOne(const Value& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::string parameterMetadata(
    std::string_view scope, std::string_view type, int extent, std::string_view meaning = "") {
    std::string text = "arrayExtent=1;geoScope=" + std::string(scope);
    if (!meaning.empty()) text.append(";interpretation=").append(meaning);
    return text + ";isGeomParam=true;podExtent=" + std::to_string(extent) +
           ";podName=" + std::string(type);
}

template <class Value>
std::string_view scopeOf(const PointAttribute<Value>& attribute) {
    return attribute.values.empty() ? "con" : "vtx";
}

// Data that the archive borrows beside the strands themselves.
struct AlembicArrays {
    std::vector<std::int32_t> sizes;
    std::vector<std::int16_t> guides;
    std::vector<std::int32_t> ids;
    AlembicBounds bounds{};
    std::array<std::uint8_t, 4> kind{1, 0, 0, 0};  // linear, with two ends, no basis
    std::int16_t major = 1;
    std::int16_t minor = 5;
    std::uint8_t yes = 1;
    std::uint8_t up = 1;
    double metres_per_unit = 1.0;
    std::string comment;  // with the NUL that ends it
};

AlembicBounds boundsOf(std::span<const glm::vec3> points) {
    glm::vec3 low = points.front();
    glm::vec3 high = low;
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    return {glm::dvec3(low), glm::dvec3(high)};
}

AlembicArrays arraysOf(const StrandSet& strands) {
    AlembicArrays arrays;
    arrays.sizes.reserve(strands.ends.size());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        if (strands.size(i) > std::numeric_limits<std::int32_t>::max())
            throw engine::Error("a strand has more points than an int32 can hold");
        arrays.sizes.push_back(static_cast<std::int32_t>(strands.size(i)));
    }
    arrays.guides.assign(strands.guides.begin(), strands.guides.end());
    arrays.bounds = boundsOf(strands.points);
    arrays.metres_per_unit = strands.metres_per_unit.value_or(1.0);
    arrays.up = strands.up.value_or(1);
    arrays.ids.resize(strands.ends.size());
    std::iota(arrays.ids.begin(), arrays.ids.end(), 0);
    arrays.comment = strands.comment.substr(0, strands.comment.find('\0')) + '\0';
    return arrays;
}

void writeParameters(
    OgawaCompound& parameters, const StrandSet& strands, const AlembicArrays& arrays,
    const ExportExtras& extras) {
    if (extras.ids)
        parameters.array(
            "groom_id", parameterMetadata("uni", "int32_t", 1), AlembicType::int32, 1,
            bytesIn(arrays.ids));
    if (extras.groom_names && strands.widths.known())
        parameters.array(
            "groom_width", parameterMetadata(scopeOf(strands.widths), "float32_t", 1),
            AlembicType::float32, 1, bytesIn(strands.widths));
    if (!strands.groups.empty())
        parameters.array(
            "groom_group_id", parameterMetadata("uni", "int32_t", 1), AlembicType::int32, 1,
            bytesIn(strands.groups));
    if (!strands.guides.empty())
        parameters.array(
            "groom_guide", parameterMetadata("uni", "int16_t", 1), AlembicType::int16, 1,
            bytesIn(arrays.guides));
    if (!strands.root_uvs.empty())
        parameters.array(
            "groom_root_uv", parameterMetadata("uni", "float32_t", 2, "vector"),
            AlembicType::float32, 2, bytesIn(strands.root_uvs));
    if (strands.colors.known())
        parameters.array(
            "groom_color", parameterMetadata(scopeOf(strands.colors), "float32_t", 3, "rgb"),
            AlembicType::float32, 3, bytesIn(strands.colors));
}

void writeOwn(OgawaCompound& own, const StrandSet& strands, const AlembicArrays& arrays) {
    if (strands.metres_per_unit)
        own.scalar(
            "hairbench:metersPerUnit", "", AlembicType::float64, 1,
            bytesOfOne(arrays.metres_per_unit));
    if (strands.up)
        own.scalar("hairbench:upAxis", "", AlembicType::uint8, 1, bytesOfOne(arrays.up));
    if (!strands.root_triangles.empty())
        own.array(
            "hairbench:rootTriangles", "", AlembicType::uint32, 3, bytesIn(strands.root_triangles));
    if (!strands.comment.empty())
        own.scalar(
            "hairbench:comment", "", AlembicType::text, 1,
            std::as_bytes(std::span(arrays.comment)));
}

constexpr std::string_view kBounds = ".selfBnds";
constexpr std::string_view kBox = "interpretation=box";
constexpr std::string_view kPoints = "P";
constexpr std::string_view kVertexPoints = "geoScope=vtx;interpretation=point";

// Adds the points of all frames, which begin the file one after another, and their bounds.
void writeMotion(
    OgawaWriter& writer, OgawaCompound& geometry, std::size_t points, const AlembicMotion& motion) {
    const auto frames = static_cast<std::uint32_t>(motion.bounds.size());
    std::vector<std::uint64_t> boxes;
    std::vector<std::uint64_t> samples;
    std::string box_keys;
    for (std::uint32_t i = 0; i < frames; ++i) {
        const std::span<const std::byte> box = bytesOfOne(motion.bounds[i]);
        const std::string key = murmurOf(box);
        box_keys += key;
        boxes.push_back(writer.data(key, box));
        const std::uint64_t size = sizeof(std::uint64_t) + kKeySize + points * sizeof(glm::vec3);
        samples.push_back((kOgawaHead + i * size) | kOgawaData);
        samples.push_back(kOgawaData);  // dimensions follow from the size
    }
    geometry.moving(
        kBounds, kBox, AlembicKind::scalar, AlembicType::float64, 6, frames, boxes, box_keys);
    geometry.moving(
        kPoints, kVertexPoints, AlembicKind::array, AlembicType::float32, 3, frames, samples,
        motion.keys);
}

OgawaObject writeCurves(
    OgawaWriter& writer, const StrandSet& strands, const AlembicArrays& arrays,
    const ExportExtras& extras, const AlembicMotion* motion) {
    OgawaCompound geometry(writer);
    if (motion) {
        writeMotion(writer, geometry, strands.points.size(), *motion);
    } else {
        geometry.scalar(kBounds, kBox, AlembicType::float64, 6, bytesOfOne(arrays.bounds));
        geometry.array(kPoints, kVertexPoints, AlembicType::float32, 3, bytesIn(strands.points));
    }
    geometry.array("nVertices", "", AlembicType::int32, 1, bytesIn(arrays.sizes));
    geometry.scalar("curveBasisAndType", "", AlembicType::uint8, 4, bytesOfOne(arrays.kind));
    if (strands.widths.known())
        geometry.array(
            "width", parameterMetadata(scopeOf(strands.widths), "float32_t", 1),
            AlembicType::float32, 1, bytesIn(strands.widths));
    if (extras.curve_uvs && !strands.root_uvs.empty())
        geometry.array(
            "uv", parameterMetadata("uni", "float32_t", 2, "vector"), AlembicType::float32, 2,
            bytesIn(strands.root_uvs));
    OgawaCompound parameters(writer);
    writeParameters(parameters, strands, arrays, extras);
    geometry.compound(".arbGeomParams", "", parameters);
    OgawaCompound own(writer);
    writeOwn(own, strands, arrays);
    geometry.compound(".userProperties", "", own);
    OgawaCompound properties(writer);
    properties.compound(
        ".geom", "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1", geometry);
    return writeObject(writer, properties);
}

// Writes the transform above the curves, which changes nothing. Programs look for one, and Epic
// wants the version of the schema on the topmost object.
OgawaObject
writeTransform(OgawaWriter& writer, const AlembicArrays& arrays, const OgawaObject& curves) {
    OgawaCompound transform(writer);
    transform.scalar(".inherits", "", AlembicType::boolean, 1, bytesOfOne(arrays.yes));
    OgawaCompound parameters(writer);
    const std::string metadata = parameterMetadata("con", "int16_t", 1);
    parameters.array(
        "groom_version_major", metadata, AlembicType::int16, 1, bytesOfOne(arrays.major));
    parameters.array(
        "groom_version_minor", metadata, AlembicType::int16, 1, bytesOfOne(arrays.minor));
    transform.compound(".arbGeomParams", "", parameters);
    OgawaCompound properties(writer);
    properties.compound(".xform", "schema=AbcGeom_Xform_v3", transform);
    return writeObject(
        writer, properties, &curves, "strands",
        "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1;"
        "schemaObjTitle=AbcGeom_Curve_v2:.geom");
}

// Returns the place of the root.
std::uint64_t layOut(
    OgawaWriter& writer, const StrandSet& strands, const AlembicArrays& arrays,
    const ExportExtras& extras, const AlembicMotion* motion) {
    const OgawaObject curves = writeCurves(writer, strands, arrays, extras, motion);
    const OgawaObject transform = writeTransform(writer, arrays, curves);
    OgawaCompound nothing(writer);
    const OgawaObject top = writeObject(
        writer, nothing, &transform, "hair",
        "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
    const auto frames = motion ? static_cast<std::uint32_t>(motion->bounds.size()) : 0;
    return writer.root(
        top.group, "_ai_Application=hairbench", frames, motion ? motion->frame_time : 0.0);
}

std::vector<std::string> warningsOf(const StrandSet& strands) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    std::vector<std::string> warnings = leftOut(
        strands, {Part::widths, Part::colors, Part::root_uvs, Part::groups, Part::guides,
                  Part::root_triangles, Part::unit, Part::comment});
    if (strands.comment.find('\0') != std::string::npos)
        warnings.emplace_back("the comment is written up to its first NUL");
    return warnings;
}

}  // namespace

std::vector<std::string> exportAlembic(const StrandSet& strands, std::ostream& out) {
    return exportAlembicWith(strands, {}, out);
}

std::vector<std::string>
exportAlembicWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out) {
    std::vector<std::string> warnings = warningsOf(strands);
    const AlembicArrays arrays = arraysOf(strands);
    OgawaWriter writer;
    writeHead(out, layOut(writer, strands, arrays, extras, nullptr));
    writer.write(out);
    return warnings;
}

// ---- Frame by frame -----------------------------------------------------------------------------

// Sizes do not depend on numbers, so what follows the points is laid out for its place alone, then
// again with the numbers.
AlembicAnimation::AlembicAnimation(
    std::ostream& out, const StrandSet& strands, const FrameTiming& timing)
    : out_(&out), strands_(strands), timing_(timing), warnings_(warningsOf(strands)) {
    if (!(timing.frame_time > 0.0))
        throw engine::Error("/run/frame_time", "is 0, but samples of .abc need times that ascend");
    motion_.frame_time = timing.frame_time;
    AlembicMotion any = motion_;
    any.bounds.resize(timing.frames);
    any.keys.resize(timing.frames * kKeySize);
    OgawaWriter writer(end());
    root_ = layOut(writer, strands_, arraysOf(strands_), {}, &any);
    writeHead(out, root_);
}

std::uint64_t AlembicAnimation::end() const {
    return kOgawaHead + timing_.frames * (sizeof(std::uint64_t) + kKeySize +
                                          strands_.points.size() * sizeof(glm::vec3));
}

void AlembicAnimation::frame(std::span<const glm::vec3> points) {
    assert(points.size() == strands_.points.size() && motion_.bounds.size() < timing_.frames);
    const auto bytes = std::as_bytes(points);
    const std::string key = murmurOf(bytes);
    writeValue(*out_, std::uint64_t{key.size() + bytes.size()});
    out_->write(key.data(), static_cast<std::streamsize>(key.size()));
    out_->write(
        reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    motion_.keys += key;
    motion_.bounds.push_back(boundsOf(points));
}

void AlembicAnimation::finish() {
    assert(motion_.bounds.size() == timing_.frames);
    const AlembicArrays arrays = arraysOf(strands_);
    OgawaWriter writer(end());
    [[maybe_unused]] const std::uint64_t root = layOut(writer, strands_, arrays, {}, &motion_);
    assert(root == root_);
    writer.write(*out_);
}

}  // namespace hair::groom
