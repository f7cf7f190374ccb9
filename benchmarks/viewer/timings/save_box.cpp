#include "benchmarks/viewer/timings/save_box.h"

#include <imgui.h>

#include "engine/error.h"

namespace benchmarks {

void SaveBox::save(const std::function<void(const std::filesystem::path&)>& write) {
    try {
        write(path_);
        told_ = "Written: " + path_;
        problem_.clear();
        ImGui::CloseCurrentPopup();
    } catch (const engine::Error& error) {
        problem_ = error.what();
    }
}

void SaveBox::show(
    const std::filesystem::path& suggested,
    const std::function<void(const std::filesystem::path&)>& write) {
    const std::string popup = "Save##" + button_;
    if (ImGui::Button(button_.c_str())) {
        path_ = suggested.string();
        problem_.clear();
        ImGui::OpenPopup(popup.c_str());
    }
    if (ImGui::BeginPopup(popup.c_str())) {
        char text[1024] = {};
        path_.copy(text, sizeof text - 1);
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 22.0f);
        const bool entered =
            ImGui::InputText("##path", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue);
        path_ = text;
        if (ImGui::Button("Save") || entered) save(write);
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
        std::error_code ignored;
        if (std::filesystem::exists(path_, ignored))
            ImGui::TextDisabled("This file is there already and will be replaced.");
        if (!problem_.empty()) {
            ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0f);
            ImGui::TextUnformatted(problem_.c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::EndPopup();
    }
    if (!told_.empty()) ImGui::TextWrapped("%s", told_.c_str());
}

}  // namespace benchmarks
