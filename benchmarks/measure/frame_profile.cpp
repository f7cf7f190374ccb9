#include "benchmarks/measure/frame_profile.h"

#include "benchmarks/statistics.h"

namespace benchmarks {

std::vector<double> withoutProfile(const RoundTimes& rounds) {
    std::vector<double> relative = allTimes(rounds);
    if (rounds.empty()) return relative;
    const std::size_t frames = rounds.front().size();
    for (std::size_t frame = 0; frame < frames; ++frame) {
        std::vector<double> same;
        for (const std::vector<double>& round : rounds) same.push_back(round[frame]);
        const double usual = quantile(same, 0.5);
        // Times of 0 are below the clock's resolution, and like each other.
        for (std::size_t i = frame; i < relative.size(); i += frames)
            relative[i] = usual > 0.0 ? relative[i] / usual : 1.0;
    }
    return relative;
}

std::vector<double> roundLevels(const RoundTimes& rounds) {
    const std::vector<double> relative = withoutProfile(rounds);
    std::vector<double> levels;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const std::size_t frames = rounds[i].size();
        levels.push_back(quantile(std::span(relative).subspan(i * frames, frames), 0.5));
    }
    return levels;
}

std::vector<double> allTimes(std::span<const std::vector<double>> rounds) {
    std::vector<double> times;
    for (const std::vector<double>& round : rounds)
        times.insert(times.end(), round.begin(), round.end());
    return times;
}

}  // namespace benchmarks
