#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <bit>
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

template <class Value>
void append(std::string& bytes, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Groups and data, each with its place in the file. Borrowed data must live until it is written.
class OgawaWriter {
public:
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

    void write(std::ostream& out, std::uint64_t top, const std::string& about) {
        std::string zero;
        append(zero, std::int32_t{0});
        std::string library;
        append(library, std::int32_t{10803});  // like archives of Alembic 1.8.3
        std::string sampling;  // one, with a sample at 0 s
        append(sampling, std::uint32_t{1});
        append(sampling, 1.0);
        append(sampling, std::uint32_t{1});
        append(sampling, 0.0);
        std::string all;
        for (const std::string& text : metadata_) {
            all += static_cast<char>(text.size());
            all += text;
        }
        const std::array children{data(zero),  data(library),  top,
                                  data(about), data(sampling), data(all)};
        const std::uint64_t root = group(children);
        out.write("Ogawa\xff\0\1", 8);
        writeValue(out, root);
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
    std::uint64_t position_ = 16;
    std::vector<std::string> metadata_;
};

// Properties of one sample each, of an object or a property.
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
    std::array<glm::dvec3, 2> bounds{};
    std::array<std::uint8_t, 4> kind{1, 0, 0, 0};  // linear, with two ends, no basis
    std::int16_t major = 1;
    std::int16_t minor = 5;
    std::uint8_t yes = 1;
    std::uint8_t up = 1;
    double metres_per_unit = 1.0;
    std::string comment;  // with the NUL that ends it
};

AlembicArrays arraysOf(const StrandSet& strands) {
    AlembicArrays arrays;
    arrays.sizes.reserve(strands.ends.size());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        if (strands.size(i) > std::numeric_limits<std::int32_t>::max())
            throw engine::Error("a strand has more points than an int32 can hold");
        arrays.sizes.push_back(static_cast<std::int32_t>(strands.size(i)));
    }
    arrays.guides.assign(strands.guides.begin(), strands.guides.end());
    glm::vec3 low = strands.points.front();
    glm::vec3 high = low;
    for (const glm::vec3& point : strands.points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    arrays.bounds = {glm::dvec3(low), glm::dvec3(high)};
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

OgawaObject writeCurves(
    OgawaWriter& writer, const StrandSet& strands, const AlembicArrays& arrays,
    const ExportExtras& extras) {
    OgawaCompound geometry(writer);
    geometry.scalar(
        ".selfBnds", "interpretation=box", AlembicType::float64, 6, bytesOfOne(arrays.bounds));
    geometry.array(
        "P", "geoScope=vtx;interpretation=point", AlembicType::float32, 3, bytesIn(strands.points));
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

}  // namespace

std::vector<std::string> exportAlembic(const StrandSet& strands, std::ostream& out) {
    return exportAlembicWith(strands, {}, out);
}

std::vector<std::string>
exportAlembicWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    std::vector<std::string> warnings = leftOut(
        strands, {Part::widths, Part::colors, Part::root_uvs, Part::groups, Part::guides,
                  Part::root_triangles, Part::unit, Part::comment});
    if (strands.comment.find('\0') != std::string::npos)
        warnings.emplace_back("the comment is written up to its first NUL");
    const AlembicArrays arrays = arraysOf(strands);
    OgawaWriter writer;
    const OgawaObject curves = writeCurves(writer, strands, arrays, extras);
    const OgawaObject transform = writeTransform(writer, arrays, curves);
    OgawaCompound nothing(writer);
    const OgawaObject top = writeObject(
        writer, nothing, &transform, "hair",
        "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
    writer.write(out, top.group, "_ai_Application=hairbench");
    return warnings;
}

}  // namespace hair::groom
