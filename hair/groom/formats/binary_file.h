#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/error.h"

// Numbers and arrays of little-endian files in memory. Callers must have checked that they are
// within the file.
namespace hair::groom {

static_assert(std::endian::native == std::endian::little, "files are read as they lie in memory");

// Bounds the bytes that a file expands to, by shared or compressed data, in proportion to its size.
// Counted before they are made, so that a small file can't take all memory.
class ExpansionLimit {
public:
    // `file_size` is in bytes and includes the files that it names.
    explicit ExpansionLimit(std::uint64_t file_size) : most_(kAnyway + kTimes * file_size) {}

    // Raises the limit for arrays by the size of one more file.
    void allow(std::uint64_t file_size) { most_ += kTimes * file_size; }

    // Counts `bytes` more. `what` names them in the error, e.g. "the arrays". Throws engine::Error.
    void add(std::uint64_t bytes, std::string_view what) {
        bytes_ += std::min(bytes, most_ + 1);
        if (bytes_ <= most_) return;
        throw engine::Error(
            std::string(what) + " expand to more than " + std::to_string(most_ >> 20) +
            " MiB, the limit of " + std::to_string(kTimes) + " times the file's size plus " +
            std::to_string(kAnyway >> 20) + " MiB");
    }

private:
    static constexpr std::uint64_t kAnyway = std::uint64_t{32} << 20;
    static constexpr std::uint64_t kTimes = 16;

    std::uint64_t most_;
    std::uint64_t bytes_ = 0;
};

[[noreturn]] inline void failAt(std::uint64_t byte, const std::string& reason) {
    throw engine::Error("byte " + std::to_string(byte), reason);
}

template <class Value>
Value valueAt(std::span<const std::byte> bytes, std::uint64_t offset) {
    static_assert(std::is_trivially_copyable_v<Value>);
    assert(offset + sizeof(Value) <= bytes.size());
    Value value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class Element>
std::vector<Element>
arrayAt(std::span<const std::byte> bytes, std::uint64_t offset, std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<Element>);
    assert(offset + count * sizeof(Element) <= bytes.size());
    std::vector<Element> elements(count);
    if (count > 0) std::memcpy(elements.data(), bytes.data() + offset, count * sizeof(Element));
    return elements;
}

template <class Element>
void writeArray(std::ostream& out, const std::vector<Element>& elements) {
    static_assert(std::is_trivially_copyable_v<Element>);
    out.write(
        reinterpret_cast<const char*>(elements.data()),
        static_cast<std::streamsize>(elements.size() * sizeof(Element)));
}

template <class Value>
void writeValue(std::ostream& out, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns the index of the first number that is infinite or NaN. It checks tens of gigabytes a
// second if there is none.
std::optional<std::size_t> firstNotFinite(std::span<const float> numbers);

// Throws if an element of floats is not finite. The elements begin at `offset` in the file. `name`
// describes an element in the message.
template <class Element>
void requireFinite(
    const std::vector<Element>& elements, std::uint64_t offset, std::string_view name) {
    constexpr std::size_t kFloats = sizeof(Element) / sizeof(float);
    const auto wrong = firstNotFinite(
        {reinterpret_cast<const float*>(elements.data()), elements.size() * kFloats});
    if (!wrong) return;
    failAt(
        offset + *wrong * sizeof(float),
        std::string(name) + ' ' + std::to_string(*wrong / kFloats) + " is not finite");
}

// False for minus infinity, which is no number that is wrong but none.
bool isNegative(float width);

// Whether a diameter is negative.
bool anyNegative(std::span<const float> widths);

}  // namespace hair::groom
