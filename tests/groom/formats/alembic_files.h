#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/groom/formats/bytes.h"

// Alembic archives byte by byte, as hair/groom/formats/ogawa.h describes them and independent of
// hairbench's writer. Here, numbers in headers have 4 bytes and are followed by metadata. hairbench
// writes 1 byte and numbered metadata.

enum AlembicCode : std::uint32_t {  // Alembic's PlainOldDataType
    kBool = 0,
    kUint8 = 1,
    kInt16 = 4,
    kUint32 = 5,
    kInt32 = 6,
    kFloat = 10,
    kDouble = 11,
    kText = 12
};

struct MadeProperty {
    std::string name;
    std::uint32_t kind = 2;  // 0 compound, 1 scalar, 2 array
    std::uint32_t type = 0;
    std::uint32_t extent = 1;
    std::vector<std::string> samples;  // bytes of their elements
    std::string metadata;
    std::vector<MadeProperty> children;  // of a compound
};

struct MadeObject {
    std::string name;
    std::string metadata;
    std::vector<MadeProperty> properties;
    std::vector<MadeObject> children;
};

class MadeArchive {
public:
    static constexpr std::uint64_t kData = std::uint64_t{1} << 63;

    MadeArchive() : bytes_("Ogawa\xff\0\1________", 16) {}

    std::uint64_t data(const std::string& content) {
        const std::uint64_t at = bytes_.size();
        bytes_ += Bytes().u64(content.size()).str() + content;
        return at | kData;
    }
    std::uint64_t group(const std::vector<std::uint64_t>& children) {
        if (children.empty()) return 0;
        const std::uint64_t at = bytes_.size();
        Bytes bytes;
        bytes.u64(children.size());
        for (const std::uint64_t child : children) bytes.u64(child);
        bytes_ += bytes.str();
        return at;
    }
    std::uint64_t object(const MadeObject& object) {
        std::vector<std::uint64_t> groups{properties(object.properties)};
        Bytes headers;
        for (const MadeObject& child : object.children) {
            groups.push_back(this->object(child));
            headers.u32(static_cast<std::uint32_t>(child.name.size())).text(child.name).u8(0xff);
            headers.u32(static_cast<std::uint32_t>(child.metadata.size())).text(child.metadata);
        }
        groups.push_back(data(headers.zeros(32).str()));
        return group(groups);
    }
    // `sampling`: the one time sampling; by default a sample a second from 0.
    std::string finish(std::uint64_t top, const std::string& sampling = {}) {
        const std::uint64_t version = data(Bytes().u32(0).str());
        const std::uint64_t library = data(Bytes().u32(10703).str());
        const std::uint64_t about = data("_ai_Application=nothing");
        const std::uint64_t times =
            data(sampling.empty() ? Bytes().u32(1).f64(1.0).u32(1).f64(0.0).str() : sampling);
        const std::uint64_t root = group({version, library, top, about, times, kData});
        return patched(bytes_, 8, root);
    }

private:
    std::uint64_t properties(const std::vector<MadeProperty>& all) {
        if (all.empty()) return 0;
        std::vector<std::uint64_t> groups;
        Bytes headers;
        for (const MadeProperty& property : all) {
            groups.push_back(
                property.kind == 0 ? properties(property.children) : samples(property));
            const auto count = static_cast<std::uint32_t>(property.samples.size());
            constexpr std::uint32_t kFourBytes = 2 << 2;
            const std::uint32_t constant = count == 1 ? 0x800 : 0;
            headers.u32(
                property.kind | kFourBytes | property.type << 4 | constant | property.extent << 12 |
                0xffu << 20);
            if (property.kind != 0) headers.u32(count);
            headers.u32(static_cast<std::uint32_t>(property.name.size())).text(property.name);
            headers.u32(static_cast<std::uint32_t>(property.metadata.size()));
            headers.text(property.metadata);
        }
        groups.push_back(data(headers.str()));
        return group(groups);
    }
    std::uint64_t samples(const MadeProperty& property) {
        std::vector<std::uint64_t> parts;
        for (const std::string& sample : property.samples) {
            parts.push_back(data("0123456789abcdef" + sample));
            if (property.kind == 2) parts.push_back(kData);
        }
        return group(parts);
    }

    std::string bytes_;
};

// ---- Curves -------------------------------------------------------------------------------------

inline MadeProperty madeFloats(std::string name, std::uint32_t extent, std::vector<float> values) {
    Bytes bytes;
    for (const float value : values) bytes.f32(value);
    return {.name = std::move(name), .type = kFloat, .extent = extent, .samples = {bytes.str()}};
}

inline MadeProperty madeIntegers(std::string name, std::vector<std::int32_t> values) {
    Bytes bytes;
    for (const std::int32_t value : values) bytes.u32(static_cast<std::uint32_t>(value));
    return {.name = std::move(name), .type = kInt32, .samples = {bytes.str()}};
}

// Type (1 linear, 0 cubic), wrap and basis of curves.
inline MadeProperty madeKind(std::uint32_t type, std::uint32_t wrap, std::uint32_t basis) {
    return {
        .name = "curveBasisAndType",
        .kind = 1,
        .type = kUint8,
        .extent = 4,
        .samples = {Bytes().u8(type).u8(wrap).u8(basis).u8(basis).str()}};
}

inline MadeProperty madeCompound(std::string name, std::vector<MadeProperty> children) {
    return {.name = std::move(name), .kind = 0, .children = std::move(children)};
}

inline MadeObject madeCurves(std::string name, std::vector<MadeProperty> geometry) {
    return {
        .name = std::move(name),
        .metadata = "schema=AbcGeom_Curve_v2;schemaObjTitle=AbcGeom_Curve_v2:.geom",
        .properties = {madeCompound(".geom", std::move(geometry))}};
}

// Codes of operations (type * 16) and their numbers.
inline MadeObject madeTransform(
    std::string name, const std::string& operations, const std::vector<double>& numbers,
    std::vector<MadeObject> children, std::vector<MadeProperty> more = {}) {
    Bytes values;
    for (const double number : numbers) values.f64(number);
    std::vector<MadeProperty> properties = std::move(more);
    properties.push_back(
        {.name = ".ops",
         .kind = 1,
         .type = kUint8,
         .extent = static_cast<std::uint32_t>(operations.size()),
         .samples = {operations}});
    properties.push_back(
        {.name = ".vals",
         .kind = 1,
         .type = kDouble,
         .extent = static_cast<std::uint32_t>(numbers.size()),
         .samples = {values.str()}});
    return {
        .name = std::move(name),
        .metadata = "schema=AbcGeom_Xform_v3",
        .properties = {madeCompound(".xform", std::move(properties))},
        .children = std::move(children)};
}

inline std::string madeArchive(std::vector<MadeObject> children) {
    MadeArchive archive;
    return archive.finish(archive.object({.children = std::move(children)}));
}
