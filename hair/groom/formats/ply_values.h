#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "hair/groom/formats/ply_header.h"

// The values of a PLY file's elements one after the other, from text and from bytes. A value is a
// double, which holds each of the format's types. A position is where the value that was taken last
// begins; place() says it in words.
namespace hair {

class PlyText {
public:
    PlyText(std::string_view body, std::size_t lines_before) : rest_(body), line_(lines_before) {}

    // Throws where the file is too short for them.
    void expect(const PlyElement& element) const;
    void expectList(double length, PlyType type) const;

    void beginElement();  // each is a line
    double take(PlyType type);
    void endElement();
    void skip(const PlyElement& element);  // as many as there are
    void finish() const;

    std::size_t position() const { return line_; }
    std::size_t nextPosition() const { return line_ + 1; }
    // From one element without lists to the next.
    std::size_t stepOf(const PlyElement&) const { return 1; }
    static std::string place(std::size_t position) { return "line " + std::to_string(position); }

private:
    std::string_view rest_;  // of the file
    std::string_view line_rest_;
    std::size_t line_;
};

template <std::endian order>
class PlyBytes {
public:
    PlyBytes(std::span<const std::byte> file, std::size_t start)
        : file_(file), next_(start), position_(start) {}

    void expect(const PlyElement& element) const;
    void expectList(double length, PlyType type) const;

    void beginElement() {}
    double take(PlyType type);
    void endElement() {}
    void skip(const PlyElement& element);
    void finish() const;

    std::size_t position() const { return position_; }
    std::size_t nextPosition() const { return next_; }
    std::size_t stepOf(const PlyElement& element) const { return element.leastSize(); }
    static std::string place(std::size_t position) { return "byte " + std::to_string(position); }

private:
    std::size_t room() const { return file_.size() - next_; }

    template <class Value>
    double load() const {
        std::array<std::byte, sizeof(Value)> bytes;
        std::memcpy(bytes.data(), file_.data() + position_, sizeof(Value));
        if constexpr (order != std::endian::native) std::ranges::reverse(bytes);
        return static_cast<double>(std::bit_cast<Value>(bytes));
    }

    std::span<const std::byte> file_;
    std::size_t next_;
    std::size_t position_;
};

// Takes a list's length, which the file is then known to be long enough for.
template <class Source>
std::size_t takeLength(Source& source, const PlyProperty& list) {
    const double length = source.take(*list.count_type);
    source.expectList(length, list.type);
    return static_cast<std::size_t>(length);
}

template <class Source>
void skipProperty(Source& source, const PlyProperty& property) {
    const std::size_t values = property.count_type ? takeLength(source, property) : 1;
    for (std::size_t i = 0; i < values; ++i) source.take(property.type);
}

}  // namespace hair
