#include "hair/groom/formats/usd_export.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <glm/common.hpp>

#include "engine/error.h"
#include "hair/groom/formats/text.h"
#include "hair/groom/formats/usd_import.h"

namespace hair::groom {
namespace {

void line(UsdaText& text, std::string_view name, const auto& value) {
    text.text(name);
    text.text(" = ");
    text.value(value);
    text.text("\n");
}

template <class Value>
void attribute(
    UsdaText& text, std::string_view declaration, std::span<const Value> values,
    std::string_view interpolation) {
    text.text("    ");
    text.text(declaration);
    text.text(" = ");
    text.array(values);
    if (!interpolation.empty()) {
        text.text(" (\n        interpolation = \"");
        text.text(interpolation);
        text.text("\"\n    )");
    }
    text.text("\n");
}

template <class Value>
void attribute(
    UsdaText& text, std::string_view declaration, const PointAttribute<Value>& attribute_values) {
    if (!attribute_values.known()) return;
    const bool varies = !attribute_values.values.empty();
    const auto values = varies ? std::span<const Value>(attribute_values.values)
                               : std::span<const Value>(&*attribute_values.everywhere, 1);
    attribute(text, declaration, values, varies ? "vertex" : "constant");
}

void stage(
    UsdaText& text, const StrandSet& strands, const std::optional<FrameTiming>& timing,
    std::vector<std::string>& warnings) {
    text.text("#usda 1.0\n(\n    defaultPrim = \"hair\"\n");
    if (!strands.comment.empty()) {
        text.text("    doc = ");
        const bool readable = isUtf8(strands.comment);
        if (!readable) warnings.emplace_back("the comment is not UTF-8: taken as Latin-1");
        text.string(readable ? strands.comment : utf8FromLatin1(strands.comment));
        text.text("\n");
    }
    if (strands.metres_per_unit)
        line(text, "    metersPerUnit", *strands.metres_per_unit);
    else
        warnings.emplace_back(
            "the unit of length is not known, so the file states none; other programs take it as "
            "cm");
    if (strands.up == 0) throw engine::Error("USD has no +x up: use --up y or z");
    if (strands.up) text.text(strands.up == 2 ? "    upAxis = \"Z\"\n" : "    upAxis = \"Y\"\n");
    if (timing) {
        // With the float next to 1/60 s as frame time, the rate is exactly 60.
        const double rate = 1.0 / timing->frame_time;
        const double whole = std::round(rate);
        const double rounded = std::abs(rate - whole) < 1e-6 * rate ? whole : rate;
        line(text, "    framesPerSecond", rounded);
        line(text, "    timeCodesPerSecond", rounded);
        text.text("    startTimeCode = 0\n");
        line(text, "    endTimeCode", timing->frames - 1);
    }
    text.text(")\n\n");
}

PointAttribute<float>
opacities(const PointAttribute<float>& transparencies, std::vector<std::string>& warnings) {
    PointAttribute<float> result = transparencies;
    bool rounded = false;
    const auto invert = [&](float& value) {
        const float opacity = 1.0f - value;
        rounded = rounded || 1.0f - opacity != value;
        value = opacity;
    };
    if (result.everywhere) invert(*result.everywhere);
    std::ranges::for_each(result.values, invert);
    if (rounded) warnings.emplace_back("the transparencies are rounded: USD holds opacities");
    return result;
}

// Writes the file up to the points of its one prim, with all other data of the strands. Returns a
// warning for all data that is not written equal to the last bit. Throws engine::Error for more
// points than USD counts.
std::vector<std::string> beginUsdaCurves(
    UsdaText& text, const StrandSet& strands, const std::optional<FrameTiming>& timing,
    const ExportExtras& extras = {}) {
    if (strands.points.size() > std::numeric_limits<std::int32_t>::max())
        throw engine::Error("usda", "more points than an int can hold");
    std::vector<std::string> warnings;
    stage(text, strands, timing, warnings);
    text.text("def BasisCurves \"hair\"\n{\n"
              "    uniform token type = \"linear\"\n"
              "    uniform token wrap = \"nonperiodic\"\n");
    std::vector<std::uint32_t> sizes(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) sizes[i] = strands.size(i);
    attribute(text, "int[] curveVertexCounts", std::span<const std::uint32_t>(sizes), "");
    attribute(text, "float[] widths", strands.widths);
    attribute(text, "color3f[] primvars:displayColor", strands.colors);
    attribute(text, "float[] primvars:displayOpacity", opacities(strands.transparencies, warnings));
    if (!strands.root_uvs.empty()) {
        attribute(
            text, "texCoord2f[] primvars:st", std::span<const glm::vec2>(strands.root_uvs),
            "uniform");
    }
    if (extras.groom_names && !strands.root_uvs.empty()) {
        attribute(
            text, "float2[] primvars:groom_root_uv", std::span<const glm::vec2>(strands.root_uvs),
            "uniform");
    }
    if (extras.groom_names) attribute(text, "float[] primvars:groom_width", strands.widths);
    if (extras.ids) {
        std::vector<std::int32_t> ids(strands.strandCount());
        std::iota(ids.begin(), ids.end(), 0);
        attribute(text, "int[] primvars:groom_id", std::span<const std::int32_t>(ids), "uniform");
    }
    if (!strands.groups.empty()) {
        attribute(
            text, "int[] primvars:groom_group_id", std::span<const std::int32_t>(strands.groups),
            "uniform");
    }
    if (!strands.guides.empty()) {
        const std::vector<std::int32_t> guides(strands.guides.begin(), strands.guides.end());
        attribute(
            text, "int[] primvars:groom_guide", std::span<const std::int32_t>(guides), "uniform");
    }
    if (!strands.root_triangles.empty()) {
        attribute(
            text, "custom int3[] hairbench:rootTriangles",
            std::span<const std::array<std::uint32_t, 3>>(strands.root_triangles), "");
    }
    return warnings;
}

void endUsdaCurves(UsdaText& text) {
    text.text("}\n");
    text.flush();
}

// Returns the lowest and the highest corner of the space that the curves cover, as UsdGeomCurves
// computes it.
std::array<glm::vec3, 2> usdExtent(std::span<const glm::vec3> points, float greatest_width) {
    if (points.empty()) return {glm::vec3(0.0f), glm::vec3(0.0f)};
    std::array extent{points.front(), points.front()};
    for (const glm::vec3& point : points) {
        extent[0] = glm::min(extent[0], point);
        extent[1] = glm::max(extent[1], point);
    }
    return {extent[0] - 0.5f * greatest_width, extent[1] + 0.5f * greatest_width};
}

float greatestWidth(const StrandSet& strands) {
    if (strands.widths.values.empty()) return strands.widths.everywhere.value_or(0.0f);
    return std::ranges::max(strands.widths.values);
}

}  // namespace

template <class Number>
void UsdaText::decimal(Number number) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    buffer_.append(digits.data(), end.ptr);
}

void UsdaText::value(std::uint32_t number) { decimal(number); }

void UsdaText::value(std::int32_t number) { decimal(number); }

void UsdaText::value(float number) {
    // Decimals are read as doubles, which are then rounded to floats. Among the shortest decimals
    // of all floats (tried one by one), this rounds one wrong: 7.038531e-26.
    constexpr float kRoundedWrong = 0x1.5c87fap-84f;
    if (std::abs(number) == kRoundedWrong) return decimal(double{number});
    decimal(number);
}

void UsdaText::value(double number) { decimal(number); }

void UsdaText::string(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    buffer_ += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n') {
            buffer_ += "\\n";
        } else if (byte < 0x20 || byte == 0x7f) {
            buffer_ += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
        } else {
            if (c == '"' || c == '\\') buffer_ += '\\';
            buffer_ += c;
        }
    }
    buffer_ += '"';
}

void UsdaText::flush() {
    out_->write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
}

std::vector<std::string> exportUsda(const StrandSet& strands, std::ostream& out) {
    return exportUsdaWith(strands, {}, out);
}

std::vector<std::string>
exportUsdaWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out) {
    UsdaText text(out);
    std::vector<std::string> warnings = beginUsdaCurves(text, strands, {}, extras);
    text.text("    point3f[] points = ");
    text.array(std::span<const glm::vec3>(strands.points));
    text.text("\n    float3[] extent = ");
    const auto extent = usdExtent(strands.points, greatestWidth(strands));
    text.array(std::span<const glm::vec3>(extent));
    text.text("\n");
    endUsdaCurves(text);
    return warnings;
}

UsdBinary::UsdBinary() : text_(folder_.path() / "strands.usda", std::ios::binary) {
    requireScripts("USD");
    text_.exceptions(std::ios::badbit | std::ios::failbit);
}

void UsdBinary::write(std::ostream& out) {
    text_.close();
    const std::filesystem::path binary = folder_.path() / "strands.usdc";
    runScript(
        {.script = "usd_binary.py", .what = "USD", .library = "usd-core"},
        {(folder_.path() / "strands.usda").string(), binary.string()}, {});
    out << std::ifstream(binary, std::ios::binary).rdbuf();
}

std::vector<std::string> exportUsdc(const StrandSet& strands, std::ostream& out) {
    return exportUsdcWith(strands, {}, out);
}

std::vector<std::string>
exportUsdcWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out) {
    UsdBinary binary;
    std::vector<std::string> warnings = exportUsdaWith(strands, extras, binary.text());
    binary.write(out);
    return warnings;
}

void UsdcAnimation::finish() {
    animation_.finish();
    binary_.write(*out_);
}

UsdaAnimation::UsdaAnimation(std::ostream& out, const StrandSet& strands, const FrameTiming& timing)
    : text_(out), point_count_(strands.points.size()), greatest_width_(greatestWidth(strands)),
      frames_(timing.frames), warnings_(beginUsdaCurves(text_, strands, timing)) {
    text_.text("    point3f[] points.timeSamples = {\n");
}

void UsdaAnimation::beginSample(std::uint32_t frame) {
    text_.text("        ");
    text_.value(frame);
    text_.text(": ");
}

void UsdaAnimation::frame(std::span<const glm::vec3> points) {
    assert(points.size() == point_count_ && extents_.size() < frames_);
    beginSample(static_cast<std::uint32_t>(extents_.size()));
    text_.array(points);
    text_.text(",\n");
    extents_.push_back(usdExtent(points, greatest_width_));
}

void UsdaAnimation::finish() {
    assert(extents_.size() == frames_);
    text_.text("    }\n    float3[] extent.timeSamples = {\n");
    for (std::uint32_t i = 0; i < extents_.size(); ++i) {
        beginSample(i);
        text_.array(std::span<const glm::vec3>(extents_[i]));
        text_.text(",\n");
    }
    text_.text("    }\n");
    endUsdaCurves(text_);
}

}  // namespace hair::groom
