#include "benchmarks/frame_path.h"

#include "engine/error.h"

namespace benchmarks {

FramePaths::FramePaths(const std::filesystem::path& pattern) {
    const std::string text = pattern.string();
    const auto refuse = [&](const char* reason) { throw engine::Error(text, reason); };
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string& part = has_number_ ? after_ : before_;
        if (text[i] != '%') {
            part += text[i];
            continue;
        }
        ++i;
        if (text.compare(i, 1, "%") == 0) {
            part += '%';
            continue;
        }
        if (has_number_) refuse("has more than one number");
        has_number_ = true;
        // "%4d" would pad with spaces.
        if (text.compare(i, 1, "0") == 0 && i + 1 < text.size() && text[i + 1] >= '1' &&
            text[i + 1] <= '9') {
            digits_ = static_cast<std::size_t>(text[i + 1] - '0');
            i += 2;
        }
        if (text.compare(i, 1, "d") != 0) refuse("a % begins neither %d, %04d nor %%");
    }
}

std::filesystem::path FramePaths::of(std::uint32_t frame) const {
    if (!has_number_) return before_;
    std::string number = std::to_string(frame);
    if (number.size() < digits_) number.insert(0, digits_ - number.size(), '0');
    return before_ + number + after_;
}

}  // namespace benchmarks
