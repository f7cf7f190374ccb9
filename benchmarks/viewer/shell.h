#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/device.h"

namespace benchmarks::viewer {

// The last thing that the user was told.
class Message {
public:
    enum class Tone { told, problem };

    void tell(const std::string& text) { set(text, Tone::told); }
    void complain(const std::string& text) { set(text, Tone::problem); }

    const std::string& text() const { return text_; }
    Tone tone() const { return tone_; }
    // Counts what was said, so that the same again is new.
    unsigned count() const { return count_; }

    // What `work` throws, a lost device apart, becomes a complaint.
    template <class Work>
    void attempt(Work&& work) {
        try {
            work();
        } catch (const engine::DeviceLost&) {
            throw;
        } catch (const engine::Error& error) {
            complain(error.what());
        }
    }

private:
    void set(const std::string& text, Tone tone) {
        text_ = text;
        tone_ = tone;
        ++count_;
    }

    std::string text_;
    Tone tone_ = Tone::told;
    unsigned count_ = 0;
};

// Asks for the path of a file to write, over everything else.
class PathPopup {
public:
    // From the next picture of the window on, with a path to begin with.
    void open(const std::filesystem::path& suggested);

    // Shows it while it is open; the path that was accepted.
    std::optional<std::filesystem::path> show();

private:
    std::string typed_;
    bool opens_ = false;
};

}  // namespace benchmarks::viewer
