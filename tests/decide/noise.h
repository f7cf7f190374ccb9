#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

// Random numbers with the same sequence everywhere: the standard fixes the engine but not its
// distributions.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : engine_(seed) {}

    // Returns a number in (0, 1).
    double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

    // Returns a number of mean 0 and standard deviation 1 (Box and Muller 1958).
    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

private:
    std::mt19937_64 engine_;
};

// Returns the greatest number of `trials` that is consistent with a chance of `rate`: 4 standard
// deviations above the expected number, which a sound test exceeds about three times in 100,000.
inline double mostOf(double trials, double rate) {
    return trials * rate + 4.0 * std::sqrt(trials * rate * (1.0 - rate));
}
