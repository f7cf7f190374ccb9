#include "benchmarks/viewer/files_panel.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include <imgui.h>

#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/viewer/preferences.h"
#include "benchmarks/viewer/scene_file.h"
#include "benchmarks/viewer/settings_panel.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/run_tool.h"
#include "engine/system/files.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks::viewer {

namespace fs = std::filesystem;

namespace {

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

// "portraits/braid" for a shipped scene, otherwise the file's name without its ending.
std::string nameOf(const fs::path& file) {
    static const fs::path shipped = sameName(engine::programFile("scenes"));
    const fs::path inside = sameName(file).lexically_relative(shipped);
    if (inside.empty() || *inside.begin() == "..") return file.stem().string();
    return (inside.parent_path() / inside.stem()).generic_string();
}

}  // namespace

// ---- Scenes -------------------------------------------------------------------------------------

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

std::vector<SceneGroup> sceneGroups(const fs::path& folder) {
    const fs::path shipped = engine::programFile("scenes");
    std::vector<SceneGroup> groups;
    for (const std::string& name : scene::shippedScenes()) {
        std::string title = fs::path(name).parent_path().generic_string();
        if (!title.empty()) title[0] = static_cast<char>(std::toupper(title[0]));
        const auto same = std::ranges::find(groups, title, &SceneGroup::title);
        SceneGroup& group =
            same == groups.end() ? groups.emplace_back(SceneGroup{title, {}}) : *same;
        group.files.push_back(shipped / (name + ".json"));
    }
    std::ranges::stable_sort(groups, {}, [](const SceneGroup& group) { return group.title; });
    if (!groups.empty() && groups.front().title.empty()) groups.front().title = "Scenes";
    const fs::path here = sameName(folder);
    const auto is_here = [&](const SceneGroup& group) {
        return sameName(group.files.front().parent_path()) == here;
    };
    if (std::ranges::none_of(groups, is_here))
        if (std::vector<fs::path> files = sceneFilesIn(folder); !files.empty())
            groups.insert(groups.begin(), {"In " + here.filename().string(), std::move(files)});
    return groups;
}

// ---- Thumbnails ---------------------------------------------------------------------------------

namespace {

// Thrown by a poll to end the process that draws.
struct Unwanted {};

// Half a second: wind has begun to move hair.
constexpr std::uint32_t kThumbnailFrame = 30;

// Fewer and wider strands for fewer pixels: a quarter of both, as in previews.
constexpr float kThumbnailLevel = 2.0f;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;
constexpr std::string_view kEnding = ".thumbnail.png";

// Size and time of a file, which tell whether it changed.
std::string stampOf(const fs::path& file) {
    std::error_code error;
    const auto bytes = fs::file_size(file, error);
    const auto time = fs::last_write_time(file, error);
    return file.string() + ' ' + std::to_string(bytes) + ' ' +
           std::to_string(time.time_since_epoch().count()) + '\n';
}

// Throws engine::Error for a scene that can't be opened.
std::string thumbnailName(const fs::path& path) {
    const scene::Scene opened = scene::loadScene(path, scene::Outside::allowed);
    std::string key = stampOf(engine::system::thisProgram()) +
                      sceneText(opened.settings, opened.directory, opened.directory);
    hair::Settings settings = opened.settings;
    scene::forEachFileName(settings, [&](const std::string&, const std::string& name) {
        key += stampOf(opened.directory / name);
    });
    return report::hashText(key) + std::string(kEnding);
}

}  // namespace

Thumbnails::Thumbnails(const engine::Device& device, Options options)
    : device_(device), options_(std::move(options)) {
    if (options_.folder.empty()) options_.folder = scratch_.emplace().path();
    // The process ends with the thread that started it, and has its priority.
    worker_.emplace(
        [this, first = true](const std::vector<std::string>& command, const Stop& stop) mutable {
            if (std::exchange(first, false)) engine::lowerPriority();
            std::string problem;
            try {
                engine::runTool(
                    command, [](std::string_view) {},
                    [&] {
                        if (ends_ || stop()) throw Unwanted();
                    });
            } catch (const Unwanted&) {
            } catch (const engine::Error& error) {
                problem = error.what();
            } catch (const std::system_error& error) {
                problem = error.what();
            } catch (const engine::Interrupted&) {
            }
            return problem;
        },
        [this] {
            if (options_.drawn) options_.drawn();
        });
}

Thumbnails::~Thumbnails() { ends_ = true; }

// Reads a picture that was drawn. A damaged one is drawn again.
void Thumbnails::load(Entry& entry) const {
    std::error_code none;
    if (!fs::exists(entry.file, none)) return;
    try {
        entry.pixels = engine::readImage(entry.file);
    } catch (const engine::Error&) {
        return;
    }
    if (entry.pixels.width == kThumbnailWidth && entry.pixels.height == kThumbnailHeight)
        entry.state = State::there;
}

Thumbnails::Picture Thumbnails::of(const fs::path& scene) {
    const auto [found, is_new] = entries_.try_emplace(scene.string());
    Entry& entry = found->second;
    if (is_new) {
        entry.scene = scene;
        try {
            entry.file = options_.folder / thumbnailName(scene);
            load(entry);
        } catch (const engine::Error& error) {
            entry.state = State::failed;
            entry.problem = error.what();
        }
    }
    entry.wanted = true;
    const ShownPicture* const shown =
        entry.shown && entry.shown->isThere() ? entry.shown.get() : nullptr;
    return {entry.state, shown, entry.problem};
}

void Thumbnails::begin(Entry& entry) {
    std::error_code none;
    fs::create_directories(options_.folder, none);
    std::vector<std::string> command = options_.program;
    command.insert(command.begin() + 1, {"render", entry.scene.string()});
    const auto set = [&](const std::string& field) {
        command.insert(command.end(), {"--set", field});
    };
    set("/render/width=" + std::to_string(kThumbnailWidth));
    set("/render/height=" + std::to_string(kThumbnailHeight));
    set("/lod/mode=forced");
    set("/lod/level=" + std::to_string(kThumbnailLevel));
    command.insert(
        command.end(), {"--frame", std::to_string(kThumbnailFrame), "-o", entry.file.string()});
    entry.state = State::drawing;
    drawing_ = entry.scene.string();
    worker_->begin(std::move(command));
}

void Thumbnails::work(Draw draw) {
    if (const std::optional<std::string> problem = worker_->take()) {
        Entry& entry = entries_.at(std::exchange(drawing_, {}));
        entry.state = State::waiting;
        load(entry);
        if (entry.state == State::waiting && !problem->empty()) {
            entry.state = State::failed;
            entry.problem = *problem;
        }
        engine::trimCache(options_.folder, kMostBytes, [](std::string_view name) {
            return name.ends_with(kEnding);
        });
    }
    missing_ = 0;
    Entry* next = nullptr;
    for (auto& [key, entry] : entries_) {
        if (!std::exchange(entry.wanted, false)) continue;
        if (entry.state != State::waiting && entry.state != State::drawing) continue;
        ++missing_;
        if (!next && entry.state == State::waiting) next = &entry;
    }
    draw_ = options_.program.empty() ? Draw::never : draw;
    ends_ = draw_ == Draw::never || draw_ == Draw::later || missing_ == 0;
    if (next && draw_ == Draw::wanted && !worker_->busy()) begin(*next);
}

std::string Thumbnails::message() const {
    if (missing_ == 0 || draw_ == Draw::never) return {};
    const std::string pictures =
        std::to_string(missing_) + (missing_ == 1 ? " picture" : " pictures");
    return draw_ == Draw::later ? "Pause to draw " + pictures : pictures + " left";
}

bool Thumbnails::copy(engine::Commands& commands) {
    bool any = false;
    for (auto& [key, entry] : entries_) {
        if (entry.pixels.rgba.empty()) continue;
        entry.shown = std::make_unique<ShownPicture>(device_);
        const VkExtent2D size{entry.pixels.width, entry.pixels.height};
        entry.shown->copy(commands, 1, entry.pixels.rgba, size, size);
        entry.pixels = {};
        any = true;
    }
    return any;
}

// ---- The panel ----------------------------------------------------------------------------------

namespace {

constexpr float kWidestTile = 12.0f;  // letters

void tooltip(const ListedScene& scene, const fs::path& path, const std::string& not_drawn) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled) ||
        !ImGui::BeginTooltip())
        return;
    ImGui::PushTextWrapPos(30.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(path.string().c_str());
    if (!scene.description.empty()) ImGui::TextUnformatted(scene.description.c_str());
    if (!scene.problem.empty()) ImGui::TextUnformatted(scene.problem.c_str());
    if (scene.problem.empty() && !not_drawn.empty())
        ImGui::TextUnformatted(("It has no picture: " + not_drawn).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void textInMiddle(const char* text, ImVec2 from, ImVec2 to) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    if (size.x > to.x - from.x) return;
    ImGui::GetWindowDrawList()->AddText(
        {std::floor((from.x + to.x - size.x) / 2.0f), std::floor((from.y + to.y - size.y) / 2.0f)},
        ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
}

}  // namespace

void SceneList::setFolder(const fs::path& folder) {
    folder_ = folder;
    groups_ = sceneGroups(folder);
    scenes_.clear();
}

// A picture with the scene's name below it.
bool SceneList::showTile(const fs::path& file, bool is_open, float width, Thumbnails& thumbnails) {
    const std::string name = nameOf(file);
    const float height = std::floor(width * kThumbnailHeight / kThumbnailWidth);
    const float line = ImGui::GetTextLineHeight();
    const float padding = std::floor(0.15f * line);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{width, height + line + 3.0f * padding};
    const ImVec2 to{from.x + size.x, from.y + size.y};
    if (!ImGui::IsRectVisible(from, to)) {
        ImGui::Dummy(size);
        return false;
    }
    const auto [found, is_new] = scenes_.try_emplace(file);
    if (is_new) found->second = listedScene(file);
    const ListedScene& scene = found->second;
    const bool works = scene.problem.empty();
    ImGui::BeginDisabled(!works);
    const bool chosen = ImGui::InvisibleButton(("##" + name).c_str(), size);
    ImGui::EndDisabled();
    const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemFocused();
    const auto picture = works ? thumbnails.of(file) : Thumbnails::Picture{};
    tooltip(scene, file, picture.problem);

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    const ImVec2 low{from.x + width, from.y + height};
    if (hovered || is_open)
        list.AddRectFilled(
            from, to,
            ImGui::GetColorU32(hovered && works ? ImGuiCol_HeaderHovered : ImGuiCol_Header),
            rounding);
    if (picture.shown) {
        list.AddImageRounded(
            picture.shown->id(), from, low, {0, 0}, {1, 1}, IM_COL32_WHITE, rounding);
    } else {
        list.AddRectFilled(from, low, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
        const bool draws = picture.state == Thumbnails::State::drawing;
        textInMiddle(
            !works                                       ? "not one scene"
            : draws                                      ? "drawing..."
            : picture.state == Thumbnails::State::failed ? "no picture"
                                                         : "",
            from, low);
    }
    if (is_open)
        list.AddRect(
            from, to, ImGui::GetColorU32(ImGuiCol_CheckMark), rounding, 0,
            std::max(std::floor(0.12f * line), 1.0f));
    list.AddText(
        {from.x + 2.0f * padding, low.y + padding},
        ImGui::GetColorU32(works ? ImGuiCol_Text : ImGuiCol_TextDisabled),
        shortened(file.stem().string(), width - 4.0f * padding).c_str());
    return chosen;
}

std::optional<fs::path> SceneList::show(const fs::path& open, Thumbnails& thumbnails) {
    std::optional<fs::path> chosen;
    leaveRoomFor("Refresh");
    ImGui::InputTextWithHint("##filter", "Filter by name", filter_.data(), filter_.size());
    ImGui::SameLine();
    if (ImGui::Button("Refresh")) setFolder(folder_);
    ImGui::SetItemTooltip("Read the folders again");
    if (const std::string message = thumbnails.message(); !message.empty())
        ImGui::TextDisabled("%s", message.c_str());
    if (!ImGui::BeginChild("scenes")) {
        ImGui::EndChild();
        return chosen;
    }
    const fs::path marked = sameName(open);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x;
    const float columns =
        std::max(std::ceil((room + gap) / (kWidestTile * ImGui::GetFontSize() + gap)), 1.0f);
    const float width = std::floor((room - (columns - 1.0f) * gap) / columns);
    bool any = false;
    for (const SceneGroup& group : groups_) {
        std::vector<const fs::path*> shown;
        for (const fs::path& file : group.files)
            if (contains(nameOf(file), filter_.data())) shown.push_back(&file);
        if (shown.empty()) continue;
        any = true;
        ImGui::SeparatorText(group.title.c_str());
        for (std::size_t i = 0; i < shown.size(); ++i) {
            if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0.0f, gap);
            const bool is_open = sameName(*shown[i]) == marked;
            if (showTile(*shown[i], is_open, width, thumbnails)) chosen = *shown[i];
        }
    }
    if (!any) ImGui::TextDisabled("No name matches");
    ImGui::EndChild();
    return chosen;
}

std::optional<fs::path> recentScenes(std::span<const fs::path> scenes) {
    std::optional<fs::path> chosen;
    ImGui::SetNextItemWidth(-1.0f);
    if (!ImGui::BeginCombo("##recent", "Recent scenes", ImGuiComboFlags_HeightLarge)) return chosen;
    for (const fs::path& scene : scenes) {
        const std::string path = scene.string();
        ImGui::PushID(path.c_str());
        if (ImGui::Selectable(scene.filename().string().c_str())) chosen = scene;
        if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort))
            ImGui::SetTooltip("%s", path.c_str());
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen;
}

// ---- The dialog ---------------------------------------------------------------------------------

namespace {

const char* titleOf(FileDialog::Use use) {
    return use == FileDialog::Use::open ? "Open" : "Save scene as";
}

// Whether the window takes files of this ending.
bool isOffered(const std::string& name, FileDialog::Use use) {
    const std::string extension = hair::groom::lowerCaseExtension(name);
    if (extension == ".json") return !name.ends_with(".schema.json");
    if (use == FileDialog::Use::save) return false;
    if (extension == ".png" || extension == ".exr" || extension == ".hdr") return true;
    const auto reads = [&](const auto& importer) {
        return std::ranges::count(importer.extensions, extension) > 0;
    };
    return std::ranges::any_of(hair::groom::strandImporters(), reads) ||
           std::ranges::any_of(hair::groom::meshImporters(), reads);
}

struct NamedPlace {
    std::string name;
    fs::path folder;
};

// Returns folders to start from: on Windows also its drives.
std::vector<NamedPlace> places() {
    std::error_code error;
    std::vector<NamedPlace> found{
        {"Shipped scenes", engine::programFile("scenes")},
        {"Current folder", fs::current_path(error)}};
    for (const char* const variable : {"HOME", "USERPROFILE"})
        if (const char* const home = std::getenv(variable); home && fs::path(home).is_absolute()) {
            found.push_back({"Home", home});
            break;
        }
    for (char drive = 'A'; drive <= 'Z'; ++drive) {
        const std::string name{drive, ':'};
        const fs::path root = name + '/';
        if (root.is_absolute() && fs::exists(root, error)) found.push_back({name, root});
    }
    std::erase_if(found, [](const NamedPlace& place) {
        std::error_code none;
        return !fs::is_directory(place.folder, none);
    });
    return found;
}

}  // namespace

void FileDialog::open(Use use, const fs::path& suggested) {
    use_ = use;
    opens_ = true;
    all_ = false;
    std::error_code error;
    const fs::path absolute = fs::absolute(suggested, error);
    const bool is_folder = fs::is_directory(absolute, error);
    typed_ = is_folder ? "" : absolute.filename().string();
    enter(is_folder ? absolute : absolute.parent_path());
}

void FileDialog::enter(const fs::path& folder) {
    folder_ = sameName(folder);
    read();
}

void FileDialog::read() {
    entries_.clear();
    problem_.clear();
    std::error_code error;
    for (fs::directory_iterator each(folder_, error), end; !error && each != end;
         each.increment(error)) {
        std::error_code ignored;
        const std::string name = each->path().filename().string();
        const bool is_folder = each->is_directory(ignored);
        if (name.starts_with('.') || (!is_folder && !each->is_regular_file(ignored))) continue;
        entries_.push_back({name, is_folder, is_folder ? 0 : each->file_size(ignored)});
    }
    if (error) problem_ = "The folder can't be read: " + error.message();
    std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
        if (a.is_folder != b.is_folder) return a.is_folder;
        return std::ranges::lexicographical_compare(a.name, b.name, {}, lowered, lowered);
    });
}

fs::path FileDialog::typedPath() const {
    if (typed_.empty()) return {};
    fs::path path = folder_ / fs::path(typed_);
    std::error_code none;
    if (use_ == Use::save && !path.has_extension() && !fs::is_directory(path, none))
        path += ".json";
    return path.lexically_normal();
}

// The folders down to the present one, as buttons.
void FileDialog::showFolders() {
    fs::path there;
    std::optional<fs::path> chosen;
    int index = 0;
    for (const fs::path& part : folder_) {
        there /= part;
        std::string name = part.string();
        // A drive's name and its root are two parts on Windows.
        if (there == folder_.root_name() && folder_.has_root_directory()) continue;
        if (there == folder_.root_path()) name = there.string();
        if (index > 0) sameLineIfItFits(name.c_str());
        ImGui::PushID(index++);
        if (ImGui::Button(name.c_str())) chosen = there;
        ImGui::PopID();
    }
    if (chosen) enter(*chosen);
}

void FileDialog::showPlaces() {
    for (const NamedPlace& place : places()) {
        const bool is_here = sameName(place.folder) == folder_;
        if (ImGui::Selectable(place.name.c_str(), is_here)) enter(place.folder);
        ImGui::SetItemTooltip("%s", place.folder.string().c_str());
    }
}

// Returns whether a file was chosen by a double click.
bool FileDialog::showEntries() {
    bool accepted = false;
    std::optional<fs::path> entered;
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    if (!ImGui::BeginTable("entries", 2, kFlags)) return false;
    const float letter = ImGui::GetFontSize();
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 5.0f * letter);
    std::size_t shown = 0;
    for (const Entry& entry : entries_) {
        if (!entry.is_folder && !all_ && !isOffered(entry.name, use_)) continue;
        ++shown;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name = entry.is_folder ? entry.name + '/' : entry.name;
        const float room = ImGui::GetContentRegionAvail().x;
        constexpr ImGuiSelectableFlags kRow = ImGuiSelectableFlags_SpanAllColumns |
                                              ImGuiSelectableFlags_AllowDoubleClick |
                                              ImGuiSelectableFlags_DontClosePopups;
        ImGui::PushID(entry.name.c_str());
        if (ImGui::Selectable(("##" + name).c_str(), entry.name == typed_, kRow)) {
            const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
            typed_ = entry.name;
            if (entry.is_folder && twice) entered = folder_ / entry.name;
            accepted |= !entry.is_folder && twice;
        }
        ImGui::PopID();
        ImGui::SameLine(0.0f, 0.0f);
        ImGui::TextUnformatted(shortened(name, room).c_str());
        ImGui::TableNextColumn();
        if (entry.is_folder) continue;
        const std::string size = report::sizeText(entry.bytes);
        const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(size.c_str()).x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(free, 0.0f));
        ImGui::TextDisabled("%s", size.c_str());
    }
    if (shown == 0) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextDisabled(entries_.empty() ? "Empty" : "No file that can be opened");
    }
    ImGui::EndTable();
    if (entered) {
        typed_.clear();
        enter(*entered);
    }
    return accepted;
}

// Takes the typed path, or enters it if it is a folder.
std::optional<FileDialog::Chosen> FileDialog::accept() {
    const fs::path path = typedPath();
    if (path.empty()) return std::nullopt;
    std::error_code error;
    if (fs::is_directory(path, error)) {
        typed_.clear();
        enter(path);
        return std::nullopt;
    }
    if (use_ == Use::open && !fs::exists(path, error)) {
        problem_ = path.string() + ": no such file";
        return std::nullopt;
    }
    ImGui::CloseCurrentPopup();
    return Chosen{use_, path};
}

std::optional<FileDialog::Chosen> FileDialog::show() {
    const char* const title = titleOf(use_);
    if (opens_) ImGui::OpenPopup(title);
    const bool first = std::exchange(opens_, false);
    const ImVec2 window = ImGui::GetMainViewport()->Size;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowSize(
        {std::min(48.0f * letter, window.x - 2.0f * letter),
         std::min(32.0f * letter, window.y - 2.0f * letter)});
    ImGui::SetNextWindowPos({window.x * 0.5f, window.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(
            title, nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings))
        return std::nullopt;
    showFolders();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float below = 2.0f * ImGui::GetFrameHeightWithSpacing() +
                        ImGui::GetTextLineHeightWithSpacing() + style.ItemSpacing.y;
    const float height = std::max(ImGui::GetContentRegionAvail().y - below, 3.0f * letter);
    if (ImGui::BeginChild("places", {9.0f * letter, height})) showPlaces();
    ImGui::EndChild();
    ImGui::SameLine();
    bool accepted = false;
    if (ImGui::BeginChild("files", {0.0f, height})) accepted = showEntries();
    ImGui::EndChild();

    ImGui::SetNextItemWidth(-1.0f);
    if (first) ImGui::SetKeyboardFocusHere();
    if (textInput("##path", typed_, "Name or path")) problem_.clear();
    accepted |= ImGui::IsItemDeactivated() &&
                (ImGui::IsKeyPressed(ImGuiKey_Enter) || ImGui::IsKeyPressed(ImGuiKey_KeypadEnter));
    const fs::path path = typedPath();
    std::error_code none;
    const bool replaces = use_ == Use::save && !path.empty() && fs::is_regular_file(path, none);
    const std::string note =
        !problem_.empty() ? problem_
        : replaces        ? path.filename().string() + " exists and will be replaced."
        : use_ == Use::save
            ? "The scene, as JSON."
            : "Scenes and screenshots open; hair, meshes and environments go into this scene.";
    ImGui::PushStyleColor(
        ImGuiCol_Text, ImGui::GetStyleColorVec4(
                           problem_.empty() ? ImGuiCol_TextDisabled : ImGuiCol_PlotHistogram));
    ImGui::TextUnformatted(shortened(note, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
    const char* const label = use_ == Use::open ? "Open###accept"
                              : replaces        ? "Replace###accept"
                                                : "Save###accept";
    ImGui::BeginDisabled(typed_.empty());
    accepted |= ImGui::Button(label);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
    if (use_ == Use::open) {
        ImGui::SameLine();
        ImGui::Checkbox("All files", &all_);
    }
    std::optional<Chosen> chosen;
    if (accepted) chosen = accept();
    ImGui::EndPopup();
    return chosen;
}

}  // namespace benchmarks::viewer
