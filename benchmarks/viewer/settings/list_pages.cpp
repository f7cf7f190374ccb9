#include "benchmarks/viewer/settings/list_pages.h"

#include <algorithm>

#include <imgui.h>

namespace benchmarks {

namespace {

constexpr std::size_t kElements = 10;  // of a page

std::size_t pages(std::size_t count) {
    return std::max<std::size_t>((count + kElements - 1) / kElements, 1);
}

}  // namespace

ElementRange elementsOf(std::size_t page, std::size_t count) {
    const std::size_t first = std::min(page, pages(count) - 1) * kElements;
    return {first, std::min(first + kElements, count)};
}

ElementRange turnPages(std::size_t count) {
    if (pages(count) < 2) return elementsOf(0, count);
    int& page = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("page"), 0);
    const int last = static_cast<int>(pages(count)) - 1;
    page = std::clamp(page, 0, last);
    if (ImGui::ArrowButton("##earlier", ImGuiDir_Left)) page = std::max(page - 1, 0);
    ImGui::SameLine();
    if (ImGui::ArrowButton("##later", ImGuiDir_Right)) page = std::min(page + 1, last);
    ImGui::SameLine();
    int shown = page + 1;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::SliderInt("##page", &shown, 1, last + 1, "page %d", ImGuiSliderFlags_AlwaysClamp);
    page = shown - 1;
    return elementsOf(static_cast<std::size_t>(page), count);
}

}  // namespace benchmarks
