#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

// Writes little-endian files as format descriptions have them, value after value, on machines of
// any byte order.
class Bytes {
public:
    Bytes& text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    Bytes& zeros(std::size_t count) {
        bytes_.append(count, '\0');
        return *this;
    }
    Bytes& u8(std::uint32_t value) { return unsignedOf(value, 1); }
    Bytes& u16(std::uint32_t value) { return unsignedOf(value, 2); }
    Bytes& u32(std::uint32_t value) { return unsignedOf(value, 4); }
    Bytes& u64(std::uint64_t value) { return unsignedOf(value, 8); }
    template <class... Floats>
    Bytes& f32(Floats... values) {
        (one(static_cast<float>(values)), ...);
        return *this;
    }
    template <class... Doubles>
    Bytes& f64(Doubles... values) {
        (u64(std::bit_cast<std::uint64_t>(static_cast<double>(values))), ...);
        return *this;
    }
    const std::string& str() const { return bytes_; }

private:
    Bytes& unsignedOf(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
        return *this;
    }
    void one(float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, 4);
        u32(bits);
    }

    std::string bytes_;
};

template <class Value>
std::string patched(std::string bytes, std::size_t offset, Value value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return bytes;
}

constexpr float kNotFinite[] = {
    std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::signaling_NaN(),
    std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

// Wrong values for counts and offsets: zero, one, the greatest numbers, negative numbers.
constexpr std::uint32_t kWrongCounts[] = {0, 1, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
