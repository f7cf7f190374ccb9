#include "benchmarks/scene/pattern.h"

#include <charconv>
#include <vector>

#include <re2/re2.h>

#include "engine/error.h"

namespace benchmarks::scene {

// ---- Patterns of names --------------------------------------------------------------------------

namespace {

re2::RE2::Options quietOptions() {
    re2::RE2::Options options;
    options.set_log_errors(false);
    return options;
}

}  // namespace

Pattern::Pattern(const std::string& regex)
    : expression_(std::make_shared<const re2::RE2>(regex, quietOptions())) {
    if (!expression_->ok()) throw engine::Error(expression_->error());
}

bool Pattern::isIn(std::string_view text) const {
    return re2::RE2::PartialMatch({text.data(), text.size()}, *expression_);
}

// ---- File names ---------------------------------------------------------------------------------

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
        // "%4d" is refused because it would pad with spaces.
        if (text.compare(i, 1, "0") == 0 && i + 1 < text.size() && text[i + 1] >= '1' &&
            text[i + 1] <= '9') {
            digits_ = static_cast<std::size_t>(text[i + 1] - '0');
            i += 2;
        }
        if (text.compare(i, 1, "d") != 0) refuse("'%' must begin %d, %04d (with any digit) or %%");
    }
}

std::filesystem::path FramePaths::of(std::uint32_t frame) const {
    if (!has_number_) return before_;
    std::string number = std::to_string(frame);
    if (number.size() < digits_) number.insert(0, digits_ - number.size(), '0');
    return before_ + number + after_;
}

namespace {

constexpr std::string_view kCasePlace = "{case}";

}  // namespace

bool hasCasePlace(const std::filesystem::path& pattern) {
    return pattern.string().find(kCasePlace) != std::string::npos;
}

std::filesystem::path
caseFile(const std::filesystem::path& pattern, std::string_view scene, std::string_view name) {
    if (name.starts_with(scene) && name.substr(scene.size()).starts_with('/'))
        name.remove_prefix(scene.size() + 1);
    std::string text(name);
    for (char& each : text) {
        if (each == '/') each = '_';
        if (std::string_view(":\\\"*?<>|").find(each) != std::string_view::npos) each = '-';
    }
    std::string file = pattern.string();
    for (std::size_t at = 0; (at = file.find(kCasePlace, at)) != file.npos; at += text.size())
        file.replace(at, kCasePlace.size(), text);
    return file;
}

// ---- Range --------------------------------------------------------------------------------------

FrameRange parseFrameRange(std::string_view text) {
    const auto refuse = [&](const char* reason) {
        throw engine::Error("--frames " + std::string(text), reason);
    };
    constexpr std::uint32_t kMost = 1'000'000;  // largest frame number
    std::vector<std::uint32_t> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        std::uint32_t number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || number > kMost)
            refuse("is not A:B or A:B:STEP with whole numbers from 0 to 1000000");
        numbers.push_back(number);
        if (after == end) break;
        if (*after != ':' || numbers.size() == 3)
            refuse("is not A:B or A:B:STEP with whole numbers from 0 to 1000000");
        at = after + 1;
    }
    if (numbers.size() < 2) refuse("is one frame; give it by --frame");
    const FrameRange range{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1};
    if (range.step == 0) refuse("has a step of 0");
    if (range.first >= range.end) refuse("contains no frame: B must be above A");
    return range;
}

}  // namespace benchmarks::scene
