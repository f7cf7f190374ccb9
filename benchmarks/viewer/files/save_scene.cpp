#include "benchmarks/viewer/files/save_scene.h"

#include <functional>

#include <nlohmann/json.hpp>

#include "benchmarks/viewer/files/readable_json.h"
#include "benchmarks/write_settings.h"
#include "engine/write_file.h"
#include "hair/fields.h"

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "scene.schema.json";

// Without links, so that ".." leads where it says.
fs::path folderOf(const fs::path& folder) {
    return fs::weakly_canonical(fs::absolute(folder.empty() ? fs::path(".") : folder));
}

using FileNameVisitor = std::function<void(std::string& name)>;

// Calls `visit` for every member that names a file, also within lists.
void forEachFileName(hair::SettingsRef settings, const FileNameVisitor& visit);

void visitFileNames(const hair::Place&, hair::SettingsRef, const FileNameVisitor&) {}

void visitFileNames(
    const hair::FileName& row, hair::SettingsRef settings, const FileNameVisitor& visit) {
    visit(row.in(settings));
}

void visitFileNames(
    const hair::Group& row, hair::SettingsRef settings, const FileNameVisitor& visit) {
    forEachFileName(row.in(settings), visit);
}

void visitFileNames(
    const hair::List& row, hair::SettingsRef settings, const FileNameVisitor& visit) {
    for (std::size_t i = 0; i < row.size(settings); ++i)
        forEachFileName(row.at(settings, i), visit);
}

void forEachFileName(hair::SettingsRef settings, const FileNameVisitor& visit) {
    for (const hair::Field& field : settings.fields())
        std::visit([&](const auto& row) { visitFileNames(row, settings, visit); }, field.kind);
}

}  // namespace

hair::Settings movedFiles(hair::Settings settings, const fs::path& from, const fs::path& to) {
    const fs::path old_folder = folderOf(from);
    const fs::path folder = folderOf(to);
    if (old_folder == folder) return settings;
    forEachFileName(settings, [&](std::string& name) {
        if (name.empty() || fs::path(name).is_absolute()) return;
        const fs::path old = old_folder / name;
        // A link that a name is itself stays one: what it leads to may change.
        const fs::path file = folderOf(old.parent_path()) / old.filename();
        name = file.lexically_relative(folder).generic_string();
    });
    return settings;
}

std::string sceneText(const hair::Settings& settings, const fs::path& from, const fs::path& to) {
    Json document = Json::object();
    std::error_code error;
    if (fs::exists(to / kSchema, error)) document["$schema"] = kSchema;
    document.update(changedFields(movedFiles(settings, from, to)));
    return readableJson(document);
}

void saveScene(const hair::Settings& settings, const fs::path& from, const fs::path& file) {
    engine::writeFileAtomically(file, sceneText(settings, from, file.parent_path()));
}

}  // namespace benchmarks
