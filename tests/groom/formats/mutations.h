#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>

#include "hair/random.h"
#include "tests/groom/formats/bytes.h"

// Damage to files, identical in every run.
namespace hair::groom {

// A stream of hashes, the same on every machine.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : seed_(seed) {}
    std::uint32_t below(std::size_t count) {
        return hash(seed_, thrown_++, 0) %
               static_cast<std::uint32_t>(std::max<std::size_t>(count, 1));
    }

private:
    std::uint32_t seed_;
    std::uint32_t thrown_ = 0;
};

// The bytes with one change, or with some bytes from another file inserted.
inline std::string mutated(std::string bytes, const std::string& other, Dice& dice) {
    const std::size_t at = dice.below(bytes.size());
    switch (bytes.empty() ? 4 : dice.below(6)) {
    case 0:
        bytes[at] ^= static_cast<char>(1u << dice.below(8));
        break;
    case 1:
        bytes[at] = static_cast<char>(dice.below(256));
        break;
    case 2:
        bytes.resize(at);
        break;
    case 3:
        bytes.erase(at, dice.below(16));
        break;
    case 4:
        bytes.insert(at, other, dice.below(other.size()), dice.below(64));
        break;
    case 5:
        if (const std::size_t aligned = at / 4 * 4; aligned + 4 <= bytes.size())
            bytes = patched(bytes, aligned, kWrongCounts[dice.below(std::size(kWrongCounts))]);
        break;
    }
    return bytes;
}

}  // namespace hair::groom
