#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/viewer/picture_area.h"
#include "benchmarks/viewer/studio.h"
#include "engine/process.h"

// Files to open: the panel of scenes with their thumbnails, and the dialog for any file.

namespace benchmarks::viewer {

// ---- Scenes -------------------------------------------------------------------------------------

// A scene file in a folder.
struct ListedScene {
    std::string name;
    std::string description;
    std::string problem;  // why it cannot be opened; empty if it can
};
ListedScene listedScene(const std::filesystem::path& path);

// Returns the .json files of a folder except JSON Schemas, sorted by name; none if the folder
// cannot be read.
std::vector<std::filesystem::path> sceneFilesIn(const std::filesystem::path& folder);

// Scenes under one heading.
struct SceneGroup {
    std::string title;
    std::vector<std::filesystem::path> files;
};

// Returns the scenes of a folder, unless it has shipped scenes, and then all shipped scenes: a
// group for each folder, the top one first.
std::vector<SceneGroup> sceneGroups(const std::filesystem::path& folder);

// ---- Thumbnails ---------------------------------------------------------------------------------

inline constexpr std::uint32_t kThumbnailWidth = 256;  // px
inline constexpr std::uint32_t kThumbnailHeight = 144;

// Pictures of scenes, drawn one at a time by another process of this program and kept in a folder.
// The name of a picture's file is a hash of the scene, and of the names, sizes and times of its
// files and of the program.
class Thumbnails {
public:
    struct Options {
        // The program and its arguments that choose the device and read the scene; empty: no
        // thumbnail is drawn, but those of the folder are shown.
        std::vector<std::string> program{};
        std::filesystem::path folder{};  // empty: a temporary one
        std::function<void()> drawn{};  // called on another thread when a picture is there
    };
    Thumbnails(const engine::Device& device, Options options);
    // Ends the process.
    ~Thumbnails();
    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;

    // The state of a scene's picture.
    enum class State { waiting, drawing, there, failed };
    struct Picture {
        State state = State::waiting;
        const ShownPicture* shown = nullptr;  // null unless it is there
        std::string problem;  // why it can't be drawn
    };
    // Returns a scene's picture, and wants it if it is not there. To be called in each picture of
    // the window that shows it.
    Picture of(const std::filesystem::path& scene);

    // Goes on in the background, after of(), in each picture of the window: draws what is wanted,
    // ends only what was begun, or ends that too, for a while or because nothing is to be drawn.
    enum class Draw { never, later, begun, wanted };
    void work(Draw draw);
    // Records copies for widgets, before the window is rendered. Returns whether there are new
    // ones, which no widget shows yet.
    bool copy(engine::Commands& commands);

    // How many of the scenes asked for in the last picture of the window lack a picture.
    std::size_t missing() const { return missing_; }
    // "Pause to draw 3 pictures" or "3 pictures left"; empty if nothing is to be drawn.
    std::string message() const;

private:
    struct Drawn {
        std::filesystem::path file;
        std::string problem;
    };
    struct Entry {
        std::filesystem::path scene;
        std::filesystem::path file;
        State state = State::waiting;
        std::string problem;
        bool wanted = false;  // since the last work()
        engine::Pixels pixels;  // until it is copied
        std::unique_ptr<ShownPicture> shown;
    };
    void load(Entry& entry) const;
    void begin(Entry& entry);

    const engine::Device& device_;
    Options options_;
    std::optional<engine::ScratchFolder> scratch_;
    std::map<std::string, Entry> entries_;  // by the scene's path
    std::size_t missing_ = 0;
    Draw draw_ = Draw::never;  // in the last picture of the window
    std::atomic<bool> ends_ = false;
    std::optional<WorkerThread<std::vector<std::string>, std::string>> worker_;
    std::string drawing_;  // the key of the entry that is drawn; empty: none
};

// ---- The panel ----------------------------------------------------------------------------------

// Shows the shipped scenes and those beside the open one as tiles, within the current Dear ImGui
// window.
class SceneList {
public:
    explicit SceneList(const std::filesystem::path& folder) { setFolder(folder); }
    void setFolder(const std::filesystem::path& folder);

    // Returns the chosen scene, if any. Marks the scene `open`.
    std::optional<std::filesystem::path>
    show(const std::filesystem::path& open, Thumbnails& thumbnails);

private:
    bool
    showTile(const std::filesystem::path& file, bool is_open, float width, Thumbnails& thumbnails);

    std::filesystem::path folder_;
    std::vector<SceneGroup> groups_;
    std::map<std::filesystem::path, ListedScene> scenes_;  // read when first visible
    std::array<char, 64> filter_{};
};

// Shows recent scenes within the current Dear ImGui window. Returns the chosen one, if any.
std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes);

// ---- The dialog ---------------------------------------------------------------------------------

// A box above everything else that asks for a file: one to open, or one to write a scene to.
class FileDialog {
public:
    enum class Use { open, save };
    struct Chosen {
        Use use = Use::open;
        std::filesystem::path path;
    };

    // Opens the box in the window's next picture, with an initial path: a folder or a file, which
    // need not exist.
    void open(Use use, const std::filesystem::path& suggested);

    // Shows the box while it is open. Returns the accepted file, if any.
    std::optional<Chosen> show();

private:
    struct Entry {
        std::string name;
        bool is_folder = false;
        std::uintmax_t bytes = 0;
    };
    void enter(const std::filesystem::path& folder);
    void read();
    void showFolders();
    void showPlaces();
    bool showEntries();
    std::filesystem::path typedPath() const;
    std::optional<Chosen> accept();

    Use use_ = Use::open;
    bool opens_ = false;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;  // folders first, by name
    std::string typed_;
    std::string problem_;
    bool all_ = false;  // shows files that can't be opened, too
};

}  // namespace benchmarks::viewer
