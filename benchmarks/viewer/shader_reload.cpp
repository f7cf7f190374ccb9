#include "benchmarks/viewer/shader_reload.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include <imgui.h>

#include "benchmarks/report/text.h"
#include "engine/pipeline.h"
#include "engine/shaders.h"
#include "engine/system/machine.h"

namespace benchmarks::viewer {
namespace {

// ---- Selectable text ----------------------------------------------------------------------------

// Inserts line breaks where text wraps.
std::string wrapped(const std::string& text, float width) {
    std::string lines;
    const char* const end = text.data() + text.size();
    for (const char* from = text.data(); from < end;) {
        const char* const line_end = std::find(from, end, '\n');
        const char* to = ImGui::GetFont()->CalcWordWrapPositionA(
            ImGui::GetFontSize() / ImGui::GetFont()->FontSize, from, line_end, width);
        if (to == from && to < line_end) ++to;  // no room for even one letter
        lines.append(from, to);
        from = to;
        if (from < end) lines += '\n';
        if (from == line_end && from < end)
            ++from;
        else
            while (from < line_end && *from == ' ') ++from;
    }
    return lines;
}

// Text wrapped to the window's width, parts of which can be selected and copied.
void selectableText(const char* id, const std::string& text, const ImVec4& color) {
    std::string lines = wrapped(text, ImGui::GetContentRegionAvail().x - ImGui::GetFontSize());
    const auto count = static_cast<float>(1 + std::ranges::count(lines, '\n'));
    ImGui::PushStyleColor(ImGuiCol_FrameBg, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
    // Slightly taller than its lines; otherwise it gets a scroll bar.
    ImGui::InputTextMultiline(
        id, lines.data(), lines.size() + 1,
        ImVec2(-1.0f, (count + 0.2f) * ImGui::GetTextLineHeight()),
        ImGuiInputTextFlags_ReadOnly | ImGuiInputTextFlags_NoHorizontalScroll);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor(2);
}

// ---- Reload -------------------------------------------------------------------------------------

using Clock = std::chrono::steady_clock;

constexpr auto kBetweenLooks = std::chrono::milliseconds(250);

std::string lineOf(const WatchedFiles::Text& text, int line) {
    std::istringstream lines(text.value_or(""));
    std::string found;
    for (int i = 0; i < line; ++i)
        if (!std::getline(lines, found)) return {};
    return found;
}

// ---- The panel ----------------------------------------------------------------------------------

ImVec4 textColor() { return ImGui::GetStyleColorVec4(ImGuiCol_Text); }

// A red that is readable on dark and light backgrounds.
ImVec4 problemColor() {
    const ImVec4 text = textColor();
    return {
        0.3f * text.x + 0.7f * 0.9f, 0.3f * text.y + 0.7f * 0.25f, 0.3f * text.z + 0.7f * 0.2f,
        1.0f};
}

std::string timeOfDay(std::chrono::system_clock::time_point when) {
    const std::tm local = engine::system::localTime(std::chrono::system_clock::to_time_t(when));
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
        "%s, %.1f s", report::countText(reloaded.paths.size(), "shader").c_str(), reloaded.seconds);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Time from the change of a file to the first picture with it.");
    std::string paths;
    for (const std::string& path : reloaded.paths) paths += (paths.empty() ? "" : "\n") + path;
    selectableText("##paths", paths, textColor());
}

void showProblems(const std::vector<ShaderProblem>& problems) {
    if (problems.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, problemColor());
    ImGui::TextWrapped(
        "%s. The last good code is drawn.", report::countText(problems.size(), "problem").c_str());
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
        ImGui::TextWrapped("All files are the same as in the build.");
        return;
    }
    ImGui::TextDisabled("Changed since the build");
    ImGui::TextWrapped("The runner draws with the shaders of the build.");
    for (std::size_t i = 0; i < changed.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const bool needs_rebuild = ShaderReload::needsRebuild(changed[i]);
        selectableText(
            "##changed",
            changed[i] +
                (needs_rebuild ? " is shared with C++: not reloaded; rebuild the program" : ""),
            needs_rebuild ? problemColor() : textColor());
        ImGui::PopID();
    }
}

}  // namespace

// ---- Watched files ------------------------------------------------------------------------------

void WatchedFiles::watch(const std::string& file, Text text) {
    files_.try_emplace(file, File{.text = std::move(text)});
}

const WatchedFiles::Text& WatchedFiles::text(const std::string& file) {
    const auto [found, is_new] = files_.try_emplace(file);
    if (is_new) {
        found->second.read = found->second.seen = stampOf(file);
        found->second.text = read(file);
    }
    return found->second.text;
}

bool WatchedFiles::look() {
    bool changed = false;
    for (auto& [name, file] : files_) {
        const Stamp stamp = stampOf(name);
        const bool rests = file.seen == stamp;
        file.seen = stamp;
        if (!rests || file.read == stamp) continue;
        file.read = stamp;
        Text now = read(name);
        if (now == file.text) continue;
        file.text = std::move(now);
        changed = true;
    }
    return changed;
}

WatchedFiles::Stamp WatchedFiles::stampOf(const std::string& file) const {
    const std::filesystem::path path = folder_ / file;
    std::error_code time_error, size_error;
    const auto time = std::filesystem::last_write_time(path, time_error);
    const auto size = std::filesystem::file_size(path, size_error);
    if (time_error || size_error) return {};
    return {.exists = true, .time = time, .size = size};
}

WatchedFiles::Text WatchedFiles::read(const std::string& file) const {
    std::ifstream stream(folder_ / file, std::ios::binary);
    if (!stream) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

// ---- Reload -------------------------------------------------------------------------------------

struct ShaderReload::Parts {
    Parts(const engine::Device& device, const std::filesystem::path& folder);

    bool tryReload();
    bool differs(const std::string& file);
    bool isAsBuilt(const std::string& path);
    void compile(const std::string& path, engine::ShaderLibrary::Replacements& replacements);
    WatchedFiles::Text textFor(const std::string& file);
    void addProblem(const std::string& file, int line, const std::string& text);
    void findChanged();

    const engine::Device& device;
    engine::ShaderCompiler compiler;
    WatchedFiles files;
    bool watches = false;
    Clock::time_point next_look;
    std::vector<ShaderProblem> problems;
    std::vector<std::string> changed;
    ReloadedShaders reloaded;

    engine::ShaderSources built;  // the texts of all files when the program was built
    // By entry point: its file and includes, when the program was built and now. While new code is
    // not accepted yet, the latter also has the includes of the code in use.
    using Files = std::map<std::string, std::set<std::string>>;
    Files built_files;
    Files now_files;
    std::map<std::string, WatchedFiles::Text> used;  // of files that differ from `built`

    // New code that is neither accepted nor rejected, and the previous state.
    struct Attempt {
        engine::ShaderLibrary::Replacements before;
        std::map<std::string, WatchedFiles::Text> used;
        Files files;  // of the new code only
        Clock::time_point start;
    };
    std::optional<Attempt> attempt;
};

ShaderReload::Parts::Parts(const engine::Device& on, const std::filesystem::path& folder)
    : device(on), files(folder) {
    for (const std::string_view path : engine::shaderPaths()) {
        for (const auto& [file, text] : engine::shaderSources(engine::shaderCode(path))) {
            built_files[std::string(path)].insert(file);
            built.try_emplace(file, text);
            files.watch(file, text);
            watches = watches || std::filesystem::exists(folder / file);
        }
    }
    now_files = built_files;
    if (!watches && std::filesystem::exists(folder))
        addProblem("", 0, "This folder has none of the program's shaders.");
}

void ShaderReload::Parts::addProblem(const std::string& file, int line, const std::string& text) {
    const bool known = std::ranges::any_of(problems, [&](const ShaderProblem& problem) {
        return problem.file == file && problem.line == line && problem.text == text;
    });
    if (known) return;  // an included file fails in every shader that includes it
    problems.push_back({file, line, text, line > 0 ? lineOf(textFor(file), line) : ""});
}

WatchedFiles::Text ShaderReload::Parts::textFor(const std::string& file) {
    if (!needsRebuild(file)) return files.text(file);
    const auto found = built.find(file);
    return found == built.end() ? std::nullopt : WatchedFiles::Text(found->second);
}

// Whether a file differs from its version in the code in use.
bool ShaderReload::Parts::differs(const std::string& file) {
    if (needsRebuild(file)) return false;
    if (const auto other = used.find(file); other != used.end())
        return files.text(file) != other->second;
    const auto found = built.find(file);
    return found == built.end() || files.text(file) != found->second;
}

bool ShaderReload::Parts::isAsBuilt(const std::string& path) {
    return std::ranges::all_of(built_files.at(path), [&](const std::string& file) {
        return needsRebuild(file) || files.text(file) == built.at(file);
    });
}

void ShaderReload::Parts::compile(
    const std::string& path, engine::ShaderLibrary::Replacements& replacements) {
    if (isAsBuilt(path)) {
        replacements.erase(path);
        attempt->files[path] = built_files.at(path);
        return;
    }
    engine::CompiledShader compiled =
        compiler.compile(path, [&](const std::string& file) { return textFor(file); });
    if (compiled.error)
        addProblem(compiled.error->file, compiled.error->line, compiled.error->text);
    for (const std::string& file : compiled.files)
        if (needsRebuild(file) && !built.contains(file))
            addProblem(file, 0, "is shared with C++ and new: rebuild the program");
    attempt->files[path] = {compiled.files.begin(), compiled.files.end()};
    // Any of these files may contain the fix of an error.
    now_files[path].insert(compiled.files.begin(), compiled.files.end());
    if (compiled.error) return;

    const std::set<engine::ShaderBinding> had = engine::shaderBindings(engine::shaderCode(path));
    for (const engine::ShaderBinding& binding : engine::shaderBindings(compiled.code))
        if (!had.contains(binding))
            addProblem(
                std::string(engine::shaderFile(path)), 0,
                "has an image at binding " + std::to_string(binding.binding) + " of set " +
                    std::to_string(binding.set) + " that the program does not bind");
    replacements[path] = std::move(compiled.code);
}

bool ShaderReload::Parts::tryReload() {
    problems.clear();
    std::vector<std::string> paths;
    for (const auto& [path, its_files] : now_files)
        if (std::ranges::any_of(its_files, [&](const std::string& file) { return differs(file); }))
            paths.push_back(path);
    if (paths.empty()) return false;

    engine::ShaderLibrary& library = device.shaders();
    attempt = Attempt{.before = library.replacements(), .used = used, .start = Clock::now()};
    engine::ShaderLibrary::Replacements replacements = attempt->before;
    for (const std::string& path : paths) compile(path, replacements);
    if (!problems.empty()) {
        attempt.reset();
        return false;
    }
    for (const auto& [path, its_files] : attempt->files)
        for (const std::string& file : its_files) used[file] = files.text(file);
    library.replace(std::move(replacements));
    return true;
}

void ShaderReload::Parts::findChanged() {
    std::set<std::string> all;
    for (const auto& [path, its_files] : now_files) all.insert(its_files.begin(), its_files.end());
    changed.clear();
    for (const std::string& file : all) {
        const auto found = built.find(file);
        if (found == built.end() || files.text(file) != found->second) changed.push_back(file);
    }
}

ShaderReload::ShaderReload(const engine::Device& device, const std::filesystem::path& folder)
    : parts_(std::make_unique<Parts>(device, folder)) {}
ShaderReload::~ShaderReload() = default;

bool ShaderReload::poll() {
    Parts& parts = *parts_;
    const Clock::time_point now = Clock::now();
    if (!parts.watches || parts.attempt || now < parts.next_look) return false;
    parts.next_look = now + kBetweenLooks;
    if (!parts.files.look()) return false;
    const bool is_new = parts.tryReload();
    parts.findChanged();
    return is_new;
}

void ShaderReload::accept() {
    Parts& parts = *parts_;
    if (!parts.attempt) return;
    const std::chrono::duration<double> took = Clock::now() - parts.attempt->start;
    parts.reloaded = {.seconds = took.count(), .when = std::chrono::system_clock::now()};
    for (auto& [path, its_files] : parts.attempt->files) {
        const std::string_view file = engine::shaderFile(path);  // of adjacent variants
        std::vector<std::string>& reloaded = parts.reloaded.paths;
        if (reloaded.empty() || reloaded.back() != file) reloaded.emplace_back(file);
        parts.now_files[path] = std::move(its_files);
    }
    parts.attempt.reset();
}

void ShaderReload::reject(const std::string& reason) {
    Parts& parts = *parts_;
    if (!parts.attempt) return;
    std::set<std::string_view> tried;
    for (const auto& [path, its_files] : parts.attempt->files)
        tried.insert(engine::shaderFile(path));
    std::string file(tried.size() == 1 ? *tried.begin() : "");
    parts.device.shaders().replace(std::move(parts.attempt->before));
    parts.used = std::move(parts.attempt->used);
    parts.attempt.reset();
    parts.problems = {{std::move(file), 0, reason, ""}};
}

const std::vector<ShaderProblem>& ShaderReload::problems() const { return parts_->problems; }

const std::vector<std::string>& ShaderReload::changed() const { return parts_->changed; }
const ReloadedShaders& ShaderReload::reloaded() const { return parts_->reloaded; }
bool ShaderReload::watches() const { return parts_->watches; }
const std::filesystem::path& ShaderReload::folder() const { return parts_->files.folder(); }

ShaderStatus ShaderReload::status() const {
    ShaderStatus status{
        .watches = watches(),
        .folder = folder(),
        .problems = problems(),
        .changed = changed(),
        .reloaded = reloaded()};
    for (const auto& [path, code] : parts_->device.shaders().replacements())
        status.replaced.push_back(path);
    return status;
}

// ---- The panel ----------------------------------------------------------------------------------

void shaderPanel(const ShaderStatus& status) {
    ImGui::TextDisabled("Watched folder");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("GLSL files that are saved here are compiled and drawn with at once.");
    selectableText("##folder", status.folder.string(), textColor());
    showProblems(status.problems);
    if (status.watches)
        showChanged(status.changed);
    else if (status.problems.empty())
        ImGui::TextWrapped("There is no such folder: shaders stay as they were built.");
    showReloaded(status.reloaded);
}

}  // namespace benchmarks::viewer
