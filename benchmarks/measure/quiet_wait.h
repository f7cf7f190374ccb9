#pragma once

#include <functional>
#include <optional>

// Waits a little for other programs to end before a case is measured.
namespace benchmarks::measure {

inline constexpr double kQuietLook = 0.2;  // s, 20 ticks of a processor's time or more
// Compilers and tests beside a measurement pause for seconds between their steps, so a longer wait
// seldom helps; and a machine that is always busy must not make a run much longer.
inline constexpr double kMostQuietWait = 5.0;  // s, for a case
inline constexpr double kMostQuietWaits = 10.0;  // s, for a run

class QuietWait {
public:
    // Returns the share of all processors' time that other programs use in the next `seconds`,
    // which it sleeps; absent if that is unknown.
    using Look = std::function<std::optional<double>(double seconds)>;

    // `tell` is called once a run, with the share, when a wait begins.
    QuietWait(Look look, std::function<void(double share)> tell);

    // Returns when others use at most report::kLittleLoad, or after the longest wait. That is never
    // longer than `max_time`, s, which the case may measure. Looks no more once the run's time for
    // waits is used up.
    void wait(double max_time);

private:
    Look look_;
    std::function<void(double share)> tell_;
    double left_ = kMostQuietWaits;
    bool told_ = false;
};

// Looks at /proc/stat. Throws Interrupted if the user asks to stop.
std::optional<double> otherLoad(double seconds);

}  // namespace benchmarks::measure
