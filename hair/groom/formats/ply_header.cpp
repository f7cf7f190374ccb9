#include "hair/groom/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/error.h"
#include "hair/groom/formats/text_words.h"

namespace hair {
namespace {

struct TypeRow {
    PlyType type;
    std::string_view name;        // of the format's description
    std::string_view other_name;  // that later programs write
    std::size_t size;
};

constexpr std::array kTypes{
    TypeRow{PlyType::int8, "char", "int8", 1},
    TypeRow{PlyType::uint8, "uchar", "uint8", 1},
    TypeRow{PlyType::int16, "short", "int16", 2},
    TypeRow{PlyType::uint16, "ushort", "uint16", 2},
    TypeRow{PlyType::int32, "int", "int32", 4},
    TypeRow{PlyType::uint32, "uint", "uint32", 4},
    TypeRow{PlyType::float32, "float", "float32", 4},
    TypeRow{PlyType::float64, "double", "float64", 8},
};

struct FormatRow {
    PlyFormat format;
    std::string_view name;
};

constexpr std::array kFormats{
    FormatRow{PlyFormat::ascii, "ascii"},
    FormatRow{PlyFormat::little_endian, "binary_little_endian"},
    FormatRow{PlyFormat::big_endian, "binary_big_endian"},
};

PlyType typeNamed(std::string_view name) {
    for (const TypeRow& row : kTypes)
        if (row.name == name || row.other_name == name) return row.type;
    throw engine::Error("unknown type " + inQuotes(name) + "; expected one such as float or uchar");
}

PlyFormat formatNamed(std::string_view name) {
    for (const FormatRow& row : kFormats)
        if (row.name == name) return row.format;
    throw engine::Error(
        "unknown format " + inQuotes(name) +
        "; expected ascii, binary_little_endian or binary_big_endian");
}

// Without the line's end, which may be of Unix or of Windows.
std::string_view takeLine(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
        throw engine::Error("the file ends here, expected a header up to 'end_header'");
    }
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

PlyElement readElement(std::string_view rest) {
    const std::string_view name = takeWord(rest);
    const std::string_view text = takeWord(rest);
    const auto count = integerFrom(text);
    if (name.empty() || !count || *count < 0) {
        throw engine::Error(inQuotes(text) + " is no count: expected 'element NAME COUNT'");
    }
    return {std::string(name), static_cast<std::uint64_t>(*count), {}};
}

PlyProperty readProperty(std::string_view rest) {
    PlyProperty property{};
    std::string_view type = takeWord(rest);
    if (type == "list") {
        property.count_type = typeNamed(takeWord(rest));
        if (!isInteger(*property.count_type)) {
            throw engine::Error("a list's length has to be of an integer type");
        }
        type = takeWord(rest);
    }
    property.type = typeNamed(type);
    property.name = takeWord(rest);
    if (property.name.empty()) throw engine::Error("the property has no name");
    return property;
}

void checkElements(const std::vector<PlyElement>& elements) {
    for (const PlyElement& element : elements) {
        const std::string name = "element " + inQuotes(element.name);
        if (element.properties.empty()) throw engine::Error(name + " has no properties");
        if (std::ranges::count(elements, element.name, &PlyElement::name) > 1) {
            throw engine::Error(name + " is there twice");
        }
    }
}

class HeaderReader {
public:
    // Takes a line after the first; true at the last.
    bool read(std::string_view line) {
        std::string_view rest = line;
        const std::string_view keyword = takeWord(rest);
        std::vector<PlyElement>& elements = header_.elements;
        if (keyword == "end_header") {
            if (!has_format_) throw engine::Error("the header has no line 'format'");
            checkElements(elements);
            return true;
        }
        if (keyword == "format") {
            header_.format = formatNamed(takeWord(rest));
            has_format_ = true;
        } else if (keyword == "element") {
            elements.push_back(readElement(rest));
        } else if (keyword == "property") {
            if (elements.empty()) throw engine::Error("a property before the first element");
            elements.back().properties.push_back(readProperty(rest));
        } else if (keyword == "comment") {
            header_.comment.append(has_comment_ ? "\n" : "").append(rest, rest.empty() ? 0 : 1);
            has_comment_ = true;
        } else if (keyword != "obj_info") {
            throw engine::Error("unknown keyword " + inQuotes(keyword) + " in the header");
        }
        return false;
    }

    PlyHeader take() { return std::move(header_); }

private:
    PlyHeader header_{};
    bool has_format_ = false;
    bool has_comment_ = false;
};

}  // namespace

std::size_t sizeOf(PlyType type) { return kTypes[static_cast<std::size_t>(type)].size; }

bool isInteger(PlyType type) { return type < PlyType::float32; }

const PlyProperty* PlyElement::find(std::string_view property) const {
    const auto at = std::ranges::find(properties, property, &PlyProperty::name);
    return at == properties.end() ? nullptr : &*at;
}

bool PlyElement::hasLists() const {
    return std::ranges::any_of(
        properties, [](const PlyProperty& property) { return property.count_type.has_value(); });
}

std::size_t PlyElement::leastSize() const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += sizeOf(property.count_type.value_or(property.type));
    return size;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
    const auto at = std::ranges::find(elements, element, &PlyElement::name);
    return at == elements.end() ? nullptr : &*at;
}

PlyHeader readPlyHeader(std::string_view file) {
    HeaderReader reader;
    std::string_view rest = file;
    std::size_t line = 1;
    try {
        if (takeLine(rest) != "ply") throw engine::Error("not a PLY file, which begins with 'ply'");
        do ++line;
        while (!reader.read(takeLine(rest)));
    } catch (const engine::Error& error) {
        throw engine::Error("line " + std::to_string(line), error.what());
    }
    PlyHeader header = reader.take();
    header.lines = line;
    header.size = file.size() - rest.size();
    return header;
}

}  // namespace hair
