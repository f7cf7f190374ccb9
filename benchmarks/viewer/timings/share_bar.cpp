#include "benchmarks/viewer/timings/share_bar.h"

#include <algorithm>
#include <array>

#include "benchmarks/table.h"

namespace benchmarks {

ImU32 seriesColor(std::size_t index) {
    // Told apart by people with any color vision: Okabe and Ito 2008, Color universal design, but
    // for black.
    static constexpr std::array<ImU32, 8> kColors{
        IM_COL32(86, 180, 233, 255), IM_COL32(230, 159, 0, 255),   IM_COL32(0, 158, 115, 255),
        IM_COL32(213, 94, 0, 255),   IM_COL32(204, 121, 167, 255), IM_COL32(0, 114, 178, 255),
        IM_COL32(200, 188, 40, 255), IM_COL32(140, 140, 140, 255)};
    return kColors[index % kColors.size()];
}

void shareBar(double share, ImU32 color) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 0.2f);
    const float length = static_cast<float>(std::clamp(share, 0.0, 1.0)) * size.x;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(
        corner, {corner.x + size.x, corner.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    draw.AddRectFilled(corner, {corner.x + length, corner.y + size.y}, color);
    ImGui::Dummy(size);
}

void stackedBar(const char* id, std::span<const Share> shares, const char* unit) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 0.8f);
    ImGui::InvisibleButton(id, size);
    const bool hovered = ImGui::IsItemHovered();
    double sum = 0.0;
    for (const Share& share : shares) sum += share.amount;
    if (sum <= 0.0) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float mouse = ImGui::GetIO().MousePos.x;
    float left = corner.x;
    for (const Share& share : shares) {
        const float right = left + static_cast<float>(share.amount / sum) * size.x;
        draw.AddRectFilled({left, corner.y}, {right, corner.y + size.y}, share.color);
        if (hovered && mouse >= left && mouse < right)
            ImGui::SetTooltip(
                "%s: %s %s, %.0f %%", share.name.c_str(), shortNumber(share.amount).c_str(), unit,
                100.0 * share.amount / sum);
        left = right;
    }
}

}  // namespace benchmarks
