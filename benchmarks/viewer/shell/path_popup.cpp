#include "benchmarks/viewer/shell/path_popup.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "benchmarks/viewer/settings/text_input.h"

namespace benchmarks {

namespace {

constexpr const char* kTitle = "Save scene as";

bool exists(const std::string& path) {
    std::error_code none;
    return std::filesystem::exists(path, none);
}

}  // namespace

void PathPopup::open(const std::filesystem::path& suggested) {
    typed_ = suggested.string();
    opens_ = true;
}

std::optional<std::filesystem::path> PathPopup::show() {
    if (opens_) ImGui::OpenPopup(kTitle);
    const bool first = std::exchange(opens_, false);
    const ImVec2 room = ImGui::GetMainViewport()->Size;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowSize({std::min(42.0f * letter, room.x - 2.0f * letter), 0.0f});
    ImGui::SetNextWindowPos({room.x * 0.5f, room.y * 0.4f}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(
            kTitle, nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings))
        return std::nullopt;
    std::optional<std::filesystem::path> accepted;
    ImGui::SetNextItemWidth(-1.0f);
    if (first) ImGui::SetKeyboardFocusHere();
    textInput("##path", typed_);
    const bool entered = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGuiKey_Enter);
    const bool replaces = exists(typed_);
    ImGui::TextDisabled(
        "%s", replaces ? "This file exists, and will be replaced." : "The scene, as JSON.");
    ImGui::BeginDisabled(typed_.empty());
    const bool pressed = ImGui::Button(replaces ? "Replace###save" : "Save###save");
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool leaves = ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape);
    if ((entered || pressed) && !typed_.empty()) accepted = typed_;
    if (accepted || leaves) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return accepted;
}

}  // namespace benchmarks
