#include "benchmarks/viewer/picture/picture_tag.h"

#include <imgui.h>

namespace benchmarks {

void pictureTag(const std::string& text, const PictureRect& rect, Corner corner) {
    const float font = ImGui::GetFontSize();
    const float margin = font * 0.4f, padding = font * 0.35f;
    const float widest = rect.size.x - 2 * (margin + padding);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, widest);
    // Nothing is better than half of a word.
    if (widest < 2 * font || size.x > widest || size.y > rect.size.y - 2 * (margin + padding))
        return;
    const float left = corner == Corner::top_left
                           ? rect.corner.x + margin
                           : rect.corner.x + rect.size.x - margin - 2 * padding - size.x;
    const float top = rect.corner.y + margin;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(
        {left, top}, {left + size.x + 2 * padding, top + size.y + 2 * padding},
        IM_COL32(0, 0, 0, 190), padding);
    list.AddText(
        ImGui::GetFont(), font, {left + padding, top + padding}, IM_COL32_WHITE, text.c_str(),
        nullptr, widest);
}

}  // namespace benchmarks
