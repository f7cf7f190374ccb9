#include "benchmarks/viewer/shaders/shader_reload.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "benchmarks/viewer/shaders/watched_files.h"
#include "engine/shader_bindings.h"
#include "engine/shader_code.h"
#include "engine/shader_compiler.h"
#include "engine/shader_sources.h"

namespace benchmarks {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kBetweenLooks = std::chrono::milliseconds(250);

std::string lineOf(const WatchedFiles::Text& text, int line) {
    std::istringstream lines(text.value_or(""));
    std::string found;
    for (int i = 0; i < line; ++i)
        if (!std::getline(lines, found)) return {};
    return found;
}

}  // namespace

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
    // By entry point: itself and what it includes, when the program was built and as it is now.
    // While new code is not accepted, also what the code in use includes.
    using Files = std::map<std::string, std::set<std::string>>;
    Files built_files;
    Files now_files;
    std::map<std::string, WatchedFiles::Text> used;  // of files that differ from `built`

    // New code that is neither accepted nor rejected, and what was there before.
    struct Attempt {
        engine::ShaderLibrary::Replacements before;
        std::map<std::string, WatchedFiles::Text> used;
        Files files;  // of the new code alone
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

// From the code in use.
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
            addProblem(file, 0, "is shared with C++ and new: build the program anew");
    attempt->files[path] = {compiled.files.begin(), compiled.files.end()};
    // What makes up for an error may be in any of them.
    now_files[path].insert(compiled.files.begin(), compiled.files.end());
    if (compiled.error) return;

    const std::set<engine::ShaderBinding> had = engine::shaderBindings(engine::shaderCode(path));
    for (const engine::ShaderBinding& binding : engine::shaderBindings(compiled.code))
        if (!had.contains(binding))
            addProblem(
                path, 0,
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
    attempt =
        Attempt{.before = library.replacements(), .used = used, .files = {}, .start = Clock::now()};
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
    parts.reloaded = {
        .paths = {}, .seconds = took.count(), .when = std::chrono::system_clock::now()};
    for (auto& [path, its_files] : parts.attempt->files) {
        parts.reloaded.paths.push_back(path);
        parts.now_files[path] = std::move(its_files);
    }
    parts.attempt.reset();
}

void ShaderReload::reject(const std::string& reason) {
    Parts& parts = *parts_;
    if (!parts.attempt) return;
    std::string file = parts.attempt->files.size() == 1 ? parts.attempt->files.begin()->first : "";
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

}  // namespace benchmarks
