#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace hair {

// Writes values as Universal Scene Description's text has them. Floats are the shortest decimals
// that read back as the same floats. Nothing is for sure in the stream before flush().
class UsdaText {
public:
    explicit UsdaText(std::ostream& out) : out_(&out) { buffer_.reserve(2 * kBlock); }

    void text(std::string_view text) { buffer_ += text; }
    void string(std::string_view text);  // quoted, UTF-8

    void value(std::uint32_t number);
    void value(float number);
    void value(double number);
    void value(const glm::vec2& values) { tuple(std::array{values.x, values.y}); }
    void value(const glm::vec3& values) { tuple(std::array{values.x, values.y, values.z}); }
    void value(const std::array<std::uint32_t, 3>& values) { tuple(values); }

    template <class Value>
    void array(std::span<const Value> values) {
        text("[");
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i > 0) text(", ");
            value(values[i]);
            if (buffer_.size() > kBlock) flush();
        }
        text("]");
    }

    void flush();

private:
    static constexpr std::size_t kBlock = 1 << 16;

    template <class Values>
    void tuple(const Values& values) {
        text("(");
        value(values[0]);
        for (std::size_t i = 1; i < values.size(); ++i) {
            text(", ");
            value(values[i]);
        }
        text(")");
    }
    template <class Number>
    void decimal(Number number);

    std::ostream* out_;
    std::string buffer_;
};

}  // namespace hair
