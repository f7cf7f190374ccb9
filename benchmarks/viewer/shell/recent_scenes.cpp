#include "benchmarks/viewer/shell/recent_scenes.h"

#include <imgui.h>

namespace benchmarks {

std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes) {
    std::optional<std::filesystem::path> chosen;
    ImGui::SetNextItemWidth(-1.0f);
    if (!ImGui::BeginCombo("##recent", "Recent scenes", ImGuiComboFlags_HeightLarge)) return chosen;
    for (const std::filesystem::path& scene : scenes) {
        ImGui::PushID(scene.c_str());
        if (ImGui::Selectable(scene.filename().c_str())) chosen = scene;
        if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort))
            ImGui::SetTooltip("%s", scene.c_str());
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen;
}

}  // namespace benchmarks
