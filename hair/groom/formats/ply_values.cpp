#include "hair/groom/formats/ply_values.h"

#include <optional>

#include "engine/error.h"
#include "hair/groom/formats/text_words.h"

namespace hair {
namespace {

std::string truncated(const PlyElement& element, std::size_t room) {
    return "truncated: " + std::to_string(element.count) + " of element " + inQuotes(element.name) +
           " are expected, " + std::to_string(room) + " bytes are left";
}

void checkLength(const std::string& place, double length, std::size_t most) {
    if (length < 0.0) {
        throw engine::Error(
            place, "the list's length is " + std::to_string(static_cast<std::int64_t>(length)) +
                       ", which is negative");
    }
    if (length > static_cast<double>(most)) {
        throw engine::Error(
            place, "truncated: a list of " + std::to_string(static_cast<std::int64_t>(length)) +
                       " values is expected, there is room for " + std::to_string(most));
    }
}

// Floats are read as such: through double they could be rounded twice.
std::optional<double> valueFrom(std::string_view word, PlyType type) {
    switch (type) {
    case PlyType::float32:
        return floatFrom(word);
    case PlyType::float64:
        return doubleFrom(word);
    default:
        const auto integer = integerFrom(word);
        if (!integer) return {};
        return static_cast<double>(*integer);
    }
}

}  // namespace

// A line has a character for each value and one after it, which may be missing at the file's end.
void PlyText::expect(const PlyElement& element) const {
    if (element.count <= (rest_.size() + 1) / (2 * element.properties.size())) return;
    throw engine::Error(place(line_ + 1), truncated(element, rest_.size()));
}

void PlyText::expectList(double length, PlyType) const {
    checkLength(place(line_), length, line_rest_.size() / 2);
}

void PlyText::beginElement() {
    ++line_;
    if (rest_.empty()) throw engine::Error(place(line_), "truncated: the file ends here");
    line_rest_ = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line_rest_.size() + 1));
}

double PlyText::take(PlyType type) {
    const std::string_view word = takeWord(line_rest_);
    const auto value = valueFrom(word, type);
    if (value) return *value;
    if (word.empty()) throw engine::Error(place(line_), "the line ends, more numbers are expected");
    throw engine::Error(
        place(line_), inQuotes(word) + " is no " + (isInteger(type) ? "integer" : "number"));
}

void PlyText::endElement() {
    const std::string_view word = takeWord(line_rest_);
    if (word.empty()) return;
    throw engine::Error(place(line_), inQuotes(word) + " is one value more than the header says");
}

void PlyText::skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) beginElement();
}

void PlyText::finish() const {
    std::string_view rest = rest_;
    const std::string_view word = takeWord(rest);
    if (word.empty()) return;
    throw engine::Error(
        place(line_ + 1), inQuotes(word) + " after the last element, the file is expected to end");
}

template <std::endian order>
void PlyBytes<order>::expect(const PlyElement& element) const {
    if (element.count <= room() / element.leastSize()) return;
    throw engine::Error(place(next_), truncated(element, room()));
}

template <std::endian order>
void PlyBytes<order>::expectList(double length, PlyType type) const {
    checkLength(place(position_), length, room() / sizeOf(type));
}

template <std::endian order>
double PlyBytes<order>::take(PlyType type) {
    const std::size_t size = sizeOf(type);
    if (size > room()) {
        throw engine::Error(
            place(file_.size()),
            "truncated: a value of " + std::to_string(size) + " bytes is expected");
    }
    position_ = next_;
    next_ += size;
    switch (type) {
    case PlyType::int8:
        return load<std::int8_t>();
    case PlyType::uint8:
        return load<std::uint8_t>();
    case PlyType::int16:
        return load<std::int16_t>();
    case PlyType::uint16:
        return load<std::uint16_t>();
    case PlyType::int32:
        return load<std::int32_t>();
    case PlyType::uint32:
        return load<std::uint32_t>();
    case PlyType::float32:
        return load<float>();
    default:
        return load<double>();
    }
}

template <std::endian order>
void PlyBytes<order>::skip(const PlyElement& element) {
    if (!element.hasLists()) {
        next_ += element.count * element.leastSize();
        return;
    }
    for (std::uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) skipProperty(*this, property);
}

template <std::endian order>
void PlyBytes<order>::finish() const {
    if (room() == 0) return;
    throw engine::Error(
        place(next_), std::to_string(room()) + " trailing bytes after the last element");
}

template class PlyBytes<std::endian::little>;
template class PlyBytes<std::endian::big>;

}  // namespace hair
