#include "benchmarks/viewer/scene_list.h"

#include <algorithm>

#include <imgui.h>

#include "benchmarks/scene/scene.h"
#include "engine/error.h"

namespace benchmarks::viewer {

namespace fs = std::filesystem;

namespace {

// Minimum number of visible lines, however little room there is.
constexpr float kFewestLines = 4.0f;

fs::path sameName(const fs::path& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path.empty() ? fs::path(".") : path, error);
    return error ? path : canonical;
}

float widthOf(const char* button) {
    return ImGui::CalcTextSize(button).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

// The next item takes the rest of the line beside a button.
void leaveRoomFor(const char* button) {
    ImGui::SetNextItemWidth(-widthOf(button) - ImGui::GetStyle().ItemSpacing.x);
}

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool contains(const std::string& text, const char* part) {
    const std::string wanted = part;
    return std::ranges::search(text, wanted, {}, lowered, lowered).begin() != text.end() ||
           wanted.empty();
}

void tooltip(const ListedScene& scene, const fs::path& path) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled) ||
        !ImGui::BeginTooltip())
        return;
    ImGui::PushTextWrapPos(30.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(path.c_str());
    if (!scene.description.empty()) ImGui::TextUnformatted(scene.description.c_str());
    if (!scene.problem.empty()) ImGui::TextUnformatted(scene.problem.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

// ---- Scenes of a folder -------------------------------------------------------------------------

std::vector<fs::path> sceneFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator each(folder.empty() ? fs::path(".") : folder, error), end;
         !error && each != end; each.increment(error)) {
        const std::string name = each->path().filename().string();
        std::error_code ignored;
        if (name.ends_with(".json") && !name.ends_with(".schema.json") &&
            each->is_regular_file(ignored))
            files.push_back(folder / name);
    }
    std::ranges::sort(files);
    return files;
}

ListedScene listedScene(const fs::path& path) {
    ListedScene listed{.name = path.stem().string()};
    try {
        listed.description = scene::loadScene(path).settings.description;
    } catch (const engine::Error& error) {
        listed.problem = error.what();
    }
    return listed;
}

// ---- The list -----------------------------------------------------------------------------------

SceneList::SceneList(const fs::path& folder) : folder_(folder) { refresh(); }

void SceneList::refresh() {
    files_ = sceneFilesIn(folder_);
    scenes_.assign(files_.size(), {});
}

std::optional<fs::path> SceneList::showPath() {
    leaveRoomFor("Open");
    bool chosen = ImGui::InputTextWithHint(
        "##path", "Path of a scene or screenshot", typed_.data(), typed_.size(),
        ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SetItemTooltip("A scene file (.json) or a screenshot of the viewer (.png).\n"
                          "Files can be dropped on the window too.");
    ImGui::SameLine();
    ImGui::BeginDisabled(typed_[0] == '\0');
    chosen |= ImGui::Button("Open");
    ImGui::EndDisabled();
    if (!chosen || typed_[0] == '\0') return std::nullopt;
    return fs::path(typed_.data());
}

bool SceneList::showRow(std::size_t index, bool is_open) {
    if (!scenes_[index]) scenes_[index] = listedScene(files_[index]);
    const ListedScene& scene = *scenes_[index];
    ImGui::PushID(static_cast<int>(index));
    ImGui::BeginDisabled(!scene.problem.empty());
    const bool chosen = ImGui::Selectable(scene.name.c_str(), is_open);
    ImGui::EndDisabled();
    tooltip(scene, files_[index]);
    ImGui::PopID();
    return chosen;
}

std::optional<fs::path> SceneList::show(const fs::path& open) {
    std::optional<fs::path> chosen = showPath();
    leaveRoomFor("Refresh");
    ImGui::InputTextWithHint("##filter", "Filter by name", filter_.data(), filter_.size());
    ImGui::SameLine();
    if (ImGui::Button("Refresh")) refresh();
    ImGui::SetItemTooltip("Read the folder again: %s", sameName(folder_).c_str());

    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < files_.size(); ++i)
        if (contains(files_[i].stem().string(), filter_.data())) shown.push_back(i);
    if (shown.empty()) {
        ImGui::TextDisabled(files_.empty() ? "No scenes in the folder" : "No name matches");
        return chosen;
    }
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float room = std::max(ImGui::GetContentRegionAvail().y, kFewestLines * line);
    const float rows = static_cast<float>(shown.size()) * line + ImGui::GetStyle().ItemSpacing.y;
    if (ImGui::BeginChild("scenes", {0.0f, std::min(rows, room)})) {
        const fs::path marked = sameName(open);
        const bool is_here = marked.parent_path() == sameName(folder_);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(shown.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const std::size_t index = shown[static_cast<std::size_t>(i)];
                const bool is_open = is_here && files_[index].filename() == marked.filename();
                if (showRow(index, is_open)) chosen = files_[index];
            }
    }
    ImGui::EndChild();
    return chosen;
}

// ---- Recent scenes ------------------------------------------------------------------------------

std::optional<fs::path> recentScenes(std::span<const fs::path> scenes) {
    std::optional<fs::path> chosen;
    ImGui::SetNextItemWidth(-1.0f);
    if (!ImGui::BeginCombo("##recent", "Recent scenes", ImGuiComboFlags_HeightLarge)) return chosen;
    for (const fs::path& scene : scenes) {
        ImGui::PushID(scene.c_str());
        if (ImGui::Selectable(scene.filename().c_str())) chosen = scene;
        if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort))
            ImGui::SetTooltip("%s", scene.c_str());
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen;
}

}  // namespace benchmarks::viewer
