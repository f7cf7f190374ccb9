#pragma once

#include <cstdint>

#include "engine/buffer.h"
#include "engine/pipeline.h"

namespace engine {
class Commands;
class Image;
}  // namespace engine

namespace benchmarks {

// How much two pictures differ, in steps of 1/255 of display colours. Exact.
struct DifferenceFigures {
    std::uint64_t pixels = 0;     // of a picture
    std::uint64_t different = 0;  // of them, in one channel at least
    std::uint32_t most = 0;       // of one channel
    std::uint64_t sum = 0;        // over red, green and blue of all pixels

    // Of a channel of a pixel.
    double mean() const { return static_cast<double>(sum) / (3.0 * static_cast<double>(pixels)); }
    // Of the pixels, that differ.
    double share() const { return static_cast<double>(different) / static_cast<double>(pixels); }

    bool operator==(const DifferenceFigures&) const = default;
};

// Makes the picture of the difference of two, and its figures.
class DifferencePass {
public:
    explicit DifferencePass(const engine::Device& device);

    // `a` and `b` are 8-bit RGBA of one size and in SHADER_READ_ONLY_OPTIMAL; `difference` is a
    // storage image of that size and in GENERAL, and gets |a - b| times `gain`. Their alpha does
    // not count. What was written before must be visible to compute.
    void record(
        engine::Commands& commands, const engine::Image& a, const engine::Image& b,
        const engine::Image& difference, std::uint32_t gain);

    // Of the pictures recorded last, once the device is done with them.
    DifferenceFigures figures() const;

private:
    engine::ComputePipeline pipeline_;
    engine::Buffer counts_;
    engine::Buffer readback_;
    std::uint64_t pixels_ = 0;
};

}  // namespace benchmarks
