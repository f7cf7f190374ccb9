#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/verbs.h"

// Steps about time.
namespace benchmarks {

Act readWait(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const auto pictures = static_cast<int>(countOf(value, pointer));
    return [=](Driver& driver) { driver.wait(pictures); };
}

Act readFrames(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t frames = countOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().playing = false;
        for (std::uint32_t i = 0; i < frames; ++i)
            driver.then([&driver] { driver.viewer.play().step = true; });
        driver.settle();
    };
}

Act readPlay(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const bool playing = flagOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().playing = playing;
        if (!playing) driver.settle();
    };
}

Act readSeek(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t frame = countOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().seek = frame;
        driver.settle();
    };
}

}  // namespace benchmarks
