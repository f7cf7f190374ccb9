#pragma once

#include <cstddef>
#include <span>

namespace benchmarks {

// Order statistics of a sample. Everything here wants at least one value, all finite: none at all
// is an engine::Error. Results are in the samples' unit unless said otherwise.
struct Summary {
    std::size_t count;
    double minimum;
    double first_quartile;
    double median;
    double third_quartile;
    double maximum;
    double mean;
    // Median absolute deviation from the median, raw: multiply by 1.4826 for a normal sample's
    // sigma.
    double mad;
    // Sample standard deviation (n - 1) / |mean|, a ratio; 0 for a single value, infinite for a
    // mean of 0 with any spread.
    double relative_deviation;
};

Summary summarize(std::span<const double> samples);

// Quantile by linear interpolation, type 7 of Hyndman and Fan 1996, Sample quantiles in statistical
// packages: at position (n - 1) p of the sorted values, counted from 0. `p` is in [0, 1].
double quantile(std::span<const double> samples, double p);

// Frames per second: frames / total time, which is not the mean of the frames' rates.
double framesPerSecond(std::span<const double> frame_ms);

// The three things that are called "the 1 % low" (fraction 0.01), as rates in frames per second.
struct LowRates {
    double percentile;  // of the frame time at quantile 1 - fraction (MangoHud, CapFrameX)
    double mean;  // of the mean of the longest ceil(fraction n) frames (CapFrameX's average)
    double integral;  // of the frame at which the longest frames, summed, reach the fraction of all
                      // the time
};

LowRates lowRates(std::span<const double> frame_ms, double fraction);

}  // namespace benchmarks
