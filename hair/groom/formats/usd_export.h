#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/process.h"
#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Strands as Universal Scene Description, text (.usda) or binary (.usdc), at rest or frame by
// frame.
namespace hair::groom {

// Writes text of Universal Scene Description: one linear BasisCurves, "/hair". It holds all data
// that strands may have, so nothing is left out. Throws engine::Error if +x is up, which USD can't
// state.
std::vector<std::string> exportUsda(const StrandSet& strands, std::ostream& out);
std::vector<std::string>
exportUsdaWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out);

// The same as binary Universal Scene Description (.usdc): usd-core rewrites the text by
// usd_binary.py. Throws engine::Error also if the project's Python environment is missing.
std::vector<std::string> exportUsdc(const StrandSet& strands, std::ostream& out);
std::vector<std::string>
exportUsdcWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out);

// Writes values in the text format of Universal Scene Description. Floats are the shortest
// decimals that read back as the same floats. Data may not be in the stream before flush().
class UsdaText {
public:
    explicit UsdaText(std::ostream& out) : out_(&out) { buffer_.reserve(2 * kBlock); }

    void text(std::string_view text) { buffer_ += text; }
    void string(std::string_view text);  // quoted, UTF-8

    void value(std::uint32_t number);
    void value(std::int32_t number);
    void value(float number);
    void value(double number);
    void value(const glm::vec2& values) { tuple(std::array{values.x, values.y}); }
    void value(const glm::vec3& values) { tuple(std::array{values.x, values.y, values.z}); }
    void value(const std::array<std::uint32_t, 3>& values) { tuple(values); }

    template <class Value>
    void array(std::span<const Value> values) {
        text("[");
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i > 0) text(", ");
            value(values[i]);
            if (buffer_.size() > kBlock) flush();
        }
        text("]");
    }

    void flush();

private:
    static constexpr std::size_t kBlock = 1 << 16;

    template <class Values>
    void tuple(const Values& values) {
        text("(");
        value(values[0]);
        for (std::size_t i = 1; i < values.size(); ++i) {
            text(", ");
            value(values[i]);
        }
        text(")");
    }
    template <class Number>
    void decimal(Number number);

    std::ostream* out_;
    std::string buffer_;
};

// Writes moving strands as time-sampled BasisCurves, a frame at a time, without keeping them. Frame
// i is at time code i.
class UsdaAnimation {
public:
    // Every frame has the data of `strands`, except for the points. Throws as exportUsda does.
    UsdaAnimation(std::ostream& out, const StrandSet& strands, const FrameTiming& timing);

    // Writes the points of the next frame, as many as the strands have.
    void frame(std::span<const glm::vec3> points);
    // Ends the file, after the last frame.
    void finish();

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    void beginSample(std::uint32_t frame);

    UsdaText text_;
    std::size_t point_count_;
    float greatest_width_;
    std::uint32_t frames_;
    std::vector<std::array<glm::vec3, 2>> extents_;  // [frame], of the frames written so far
    std::vector<std::string> warnings_;
};

// A text of USD that becomes binary: it is in a temporary folder until write().
class UsdBinary {
public:
    UsdBinary();

    std::ostream& text() { return text_; }
    // Writes the text in binary form. Throws engine::Error like exportUsdc().
    void write(std::ostream& out);

private:
    engine::ScratchFolder folder_;
    std::ofstream text_;
};

// The same as UsdaAnimation as a .usdc. The whole text is in a temporary file before finish().
class UsdcAnimation {
public:
    UsdcAnimation(std::ostream& out, const StrandSet& strands, const FrameTiming& timing)
        : out_(&out), animation_(binary_.text(), strands, timing) {}

    void frame(std::span<const glm::vec3> points) { animation_.frame(points); }
    // Ends the file. Throws engine::Error like exportUsdc().
    void finish();

    const std::vector<std::string>& warnings() const { return animation_.warnings(); }

private:
    std::ostream* out_;
    UsdBinary binary_;
    UsdaAnimation animation_;
};

}  // namespace hair::groom
