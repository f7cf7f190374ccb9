#include "benchmarks/viewer/shaders/shader_panel.h"

#include <ctime>

#include <imgui.h>

#include "benchmarks/viewer/shaders/selectable_text.h"

namespace benchmarks {

namespace {

ImVec4 textColor() { return ImGui::GetStyleColorVec4(ImGuiCol_Text); }

// Red, and readable on dark as on light.
ImVec4 problemColor() {
    const ImVec4 text = textColor();
    return {
        0.3f * text.x + 0.7f * 0.9f, 0.3f * text.y + 0.7f * 0.25f, 0.3f * text.z + 0.7f * 0.2f,
        1.0f};
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string timeOfDay(std::chrono::system_clock::time_point when) {
    const std::time_t time = std::chrono::system_clock::to_time_t(when);
    std::tm local{};
    localtime_r(&time, &local);
    char text[16];
    return {text, std::strftime(text, sizeof text, "%H:%M:%S", &local)};
}

std::string heading(const ShaderProblem& problem) {
    if (problem.file.empty()) return problem.text;
    const std::string line = problem.line > 0 ? ":" + std::to_string(problem.line) : "";
    return problem.file + line + " " + problem.text;
}

void showReloaded(const ReloadedShaders& reloaded) {
    if (reloaded.paths.empty()) return;
    const std::string title = "Reloaded at " + timeOfDay(reloaded.when) + "###reloaded";
    if (!ImGui::CollapsingHeader(title.c_str(), ImGuiTreeNodeFlags_DefaultOpen)) return;
    ImGui::TextDisabled(
        "%s, %.1f s", counted(reloaded.paths.size(), "shader").c_str(), reloaded.seconds);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("From the change of a file to the picture with it.");
    std::string paths;
    for (const std::string& path : reloaded.paths) paths += (paths.empty() ? "" : "\n") + path;
    selectableText("##paths", paths, textColor());
}

void showProblems(const std::vector<ShaderProblem>& problems) {
    if (problems.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, problemColor());
    ImGui::TextWrapped(
        "%s. The last good code is drawn.", counted(problems.size(), "problem").c_str());
    ImGui::PopStyleColor();
    std::string all;
    for (std::size_t i = 0; i < problems.size(); ++i) {
        const ShaderProblem& problem = problems[i];
        const std::string text = heading(problem);
        ImGui::PushID(static_cast<int>(i));
        selectableText("##problem", text, problemColor());
        ImGui::Indent();
        const std::size_t first = problem.source.find_first_not_of(" \t");
        if (first != std::string::npos)
            selectableText("##source", problem.source.substr(first), textColor());
        ImGui::Unindent();
        ImGui::PopID();
        all += text + '\n' + (problem.source.empty() ? "" : problem.source + '\n');
    }
    if (ImGui::Button("Copy problems")) ImGui::SetClipboardText(all.c_str());
}

void showChanged(const std::vector<std::string>& changed) {
    if (changed.empty()) {
        ImGui::TextWrapped("All files are as the program was built with them.");
        return;
    }
    ImGui::TextDisabled("Changed since the build");
    ImGui::TextWrapped("The runner draws with what the program was built with.");
    for (std::size_t i = 0; i < changed.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const bool needs_rebuild = ShaderReload::needsRebuild(changed[i]);
        selectableText(
            "##changed",
            changed[i] + (needs_rebuild ? " is shared with C++: not reloaded, build anew" : ""),
            needs_rebuild ? problemColor() : textColor());
        ImGui::PopID();
    }
}

}  // namespace

void shaderPanel(const ShaderReload& reload) {
    ImGui::TextDisabled("Watched folder");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("GLSL files that are saved here are compiled and drawn with at once.");
    selectableText("##folder", reload.folder().string(), textColor());
    showProblems(reload.problems());
    if (reload.watches())
        showChanged(reload.changed());
    else if (reload.problems().empty())
        ImGui::TextWrapped("There is no such folder: shaders stay as they were built.");
    showReloaded(reload.reloaded());
}

}  // namespace benchmarks
