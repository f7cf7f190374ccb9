#include "benchmarks/viewer/timings/sparkline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace benchmarks {

std::optional<std::size_t>
sparkline(const char* id, std::span<const double> values, ImVec2 size, ImU32 color) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, size);
    if (values.empty()) return std::nullopt;
    const double most = std::max(std::ranges::max(values), 1e-9);
    const float line = std::max(1.0f, ImGui::GetFontSize() / 15.0f);
    const float step =
        values.size() > 1 ? (size.x - line) / static_cast<float>(values.size() - 1) : 0.0f;
    const auto point = [&](std::size_t i) {
        const float height = static_cast<float>(values[i] / most) * (size.y - 2.0f * line);
        return ImVec2(
            corner.x + 0.5f * line + step * static_cast<float>(i),
            corner.y + size.y - line - height);
    };
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < values.size(); ++i) points.push_back(point(i));
    draw.AddPolyline(points.data(), static_cast<int>(points.size()), color, ImDrawFlags_None, line);
    if (points.size() == 1) draw.AddCircleFilled(points.front(), line, color);
    if (!ImGui::IsItemHovered()) return std::nullopt;

    const float place = step > 0.0f ? (ImGui::GetIO().MousePos.x - corner.x) / step : 0.0f;
    const auto last = static_cast<float>(values.size() - 1);
    const auto index = static_cast<std::size_t>(std::clamp(std::round(place), 0.0f, last));
    draw.AddCircleFilled(points[index], 2.5f * line, ImGui::GetColorU32(ImGuiCol_Text));
    return index;
}

}  // namespace benchmarks
