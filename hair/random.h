#pragma once

#include <cstdint>

// Stateless random numbers: a hash of (seed, index, purpose), the same on every machine and in any
// order. shaders/common/random.glsl has the same functions.
namespace hair {

// PCG as a hash: Jarzynski and Olano 2020, Hash functions for GPU rendering, JCGT 9(3).
constexpr std::uint32_t pcg(std::uint32_t value) {
    const std::uint32_t state = value * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// `index` numbers the objects of one kind. `purpose` separates the numbers that one object needs.
constexpr std::uint32_t hash(std::uint32_t seed, std::uint32_t index, std::uint32_t purpose) {
    return pcg(purpose + pcg(index + pcg(seed)));
}

// Returns a number in [0, 1): the hash's top 24 bits, which a float holds exactly.
constexpr float random01(std::uint32_t seed, std::uint32_t index, std::uint32_t purpose) {
    return static_cast<float>(hash(seed, index, purpose) >> 8u) * 0x1p-24f;
}

// All purposes in C++, so that no two are the same.
namespace purpose {
inline constexpr std::uint32_t root_triangle = 1;
inline constexpr std::uint32_t root_u = 2;
inline constexpr std::uint32_t root_v = 3;
inline constexpr std::uint32_t root_mask = 4;
inline constexpr std::uint32_t guide_length = 5;
inline constexpr std::uint32_t guide_choice = 6;
inline constexpr std::uint32_t clump_centre = 7;
inline constexpr std::uint32_t wave_phase = 8;
inline constexpr std::uint32_t curl_phase = 9;
inline constexpr std::uint32_t frizz_x = 10;  // also the next two, one for each component
inline constexpr std::uint32_t follower_angle = 13;
inline constexpr std::uint32_t follower_radius = 14;
inline constexpr std::uint32_t offset_phase = 15;
inline constexpr std::uint32_t offset_frequency = 16;
inline constexpr std::uint32_t offset_noise_x = 17;  // also the next two
inline constexpr std::uint32_t clump_strength = 20;
inline constexpr std::uint32_t wave_drift = 21;  // also the next two, as for every smoothNoise()
inline constexpr std::uint32_t curl_drift = 24;
inline constexpr std::uint32_t flyaway_choice = 27;
inline constexpr std::uint32_t flyaway_reach = 28;
inline constexpr std::uint32_t flyaway_x = 29;  // also the next two
inline constexpr std::uint32_t vellus_choice = 32;
inline constexpr std::uint32_t vellus_length = 33;
inline constexpr std::uint32_t vellus_turn = 34;
inline constexpr std::uint32_t braid_angle = 35;
inline constexpr std::uint32_t braid_radius = 36;
inline constexpr std::uint32_t cut_length = 37;
}  // namespace purpose

}  // namespace hair
