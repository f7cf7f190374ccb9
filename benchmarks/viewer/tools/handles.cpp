#include "benchmarks/viewer/tools/handles.h"

#include <algorithm>
#include <vector>

#include <imgui.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace benchmarks {

namespace {

constexpr ImU32 kOutline = IM_COL32(0, 0, 0, 190);
constexpr ImU32 kBox = IM_COL32(0, 0, 0, 190);

// In font sizes.
constexpr float kLine = 0.13f;
constexpr float kBorder = 0.09f;  // of the outline, on each side
constexpr float kDot = 0.36f;
constexpr float kHead = 0.75f;  // of an arrow
constexpr float kPadding = 0.3f;

float sized(float fonts) { return fonts * ImGui::GetFontSize(); }
ImVec2 at(glm::vec2 point) { return {point.x, point.y}; }

}  // namespace

Handles::Handles(const PictureRect& seen) : seen_(seen), list_(ImGui::GetWindowDrawList()) {
    list_->PushClipRect(at(seen.corner), at(seen.corner + seen.size), true);
}

Handles::~Handles() { list_->PopClipRect(); }

float Handles::reach() { return sized(0.6f); }

void Handles::line(glm::vec2 a, glm::vec2 b, Color color) {
    list_->AddLine(at(a), at(b), kOutline, sized(kLine + 2.0f * kBorder));
    list_->AddLine(at(a), at(b), color, sized(kLine));
}

void Handles::path(std::span<const glm::vec2> points, Color color) {
    std::vector<ImVec2> line;
    for (const glm::vec2& point : points) line.push_back(at(point));
    const auto count = static_cast<int>(line.size());
    list_->AddPolyline(line.data(), count, kOutline, 0, sized(kLine + 2.0f * kBorder));
    list_->AddPolyline(line.data(), count, color, 0, sized(kLine));
}

void Handles::circle(glm::vec2 center, float radius, Color color) {
    list_->AddCircle(at(center), radius, kOutline, 0, sized(kLine + 2.0f * kBorder));
    list_->AddCircle(at(center), radius, color, 0, sized(kLine));
}

void Handles::dot(glm::vec2 center, Color color) {
    list_->AddCircleFilled(at(center), sized(kDot + kBorder), kOutline);
    list_->AddCircleFilled(at(center), sized(kDot), color);
}

void Handles::arrow(glm::vec2 from, glm::vec2 tip, Color color) {
    const float length = glm::length(tip - from);
    if (length < 1.0f) {
        dot(tip, color);
        return;
    }
    const glm::vec2 along = (tip - from) / length;
    const glm::vec2 across{-along.y, along.x};
    const auto head = [&](float border, ImU32 with) {
        const glm::vec2 foot = tip - along * sized(kHead + border);
        const glm::vec2 side = across * sized(0.5f * kHead + 1.5f * border);
        list_->AddTriangleFilled(
            at(tip + along * sized(2.0f * border)), at(foot + side), at(foot - side), with);
    };
    const glm::vec2 neck = tip - along * std::min(length, sized(kHead));
    list_->AddLine(at(from), at(neck), kOutline, sized(kLine + 2.0f * kBorder));
    head(kBorder, kOutline);
    list_->AddLine(at(from), at(neck), color, sized(kLine));
    head(0.0f, color);
}

void Handles::label(glm::vec2 beside, const std::string& text) { box(beside + sized(0.8f), text); }

void Handles::hint(const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    box(seen_.corner + glm::vec2{(seen_.size.x - size.x) / 2.0f, sized(0.5f)}, text);
}

void Handles::box(glm::vec2 corner, const std::string& text) {
    const glm::vec2 padding(sized(kPadding));
    const ImVec2 measured = ImGui::CalcTextSize(text.c_str());
    const glm::vec2 size{measured.x, measured.y};
    const glm::vec2 low = seen_.corner + padding;
    const glm::vec2 high = seen_.corner + seen_.size - size - padding;
    corner = glm::max(glm::min(corner, high), low);
    list_->AddRectFilled(at(corner - padding), at(corner + size + padding), kBox, sized(kPadding));
    list_->AddText(at(corner), kPlain, text.c_str());
}

}  // namespace benchmarks
