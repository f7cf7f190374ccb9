#include "benchmarks/viewer/shell.h"

#include <algorithm>
#include <exception>
#include <future>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <imgui.h>

#include "benchmarks/viewer/settings_panel.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/system/files.h"
#include "engine/transfer.h"

namespace benchmarks::viewer {
namespace {

constexpr double kAwake = 1.0;  // s of drawing the window after an event
constexpr double kAsleep = 0.25;  // s between pictures without events
constexpr double kKeeping = 2.0;  // s between checks whether preferences changed

// s between pictures of the window during motion without events, and while the scene is drawn: a
// software device needs the processors for that.
constexpr double kMoving = 1.0 / 60.0;
constexpr double kMovingBeside = 1.0 / 15.0;
constexpr double kHolding = 0.02;  // s between checks of events during a measurement
constexpr double kLooking = 0.25;  // s between checks of shader files

// Waits this long for a picture of the scene before it draws the window again, because so short a
// delay is not noticed.
constexpr std::chrono::milliseconds kSoon{8};
constexpr double kOfLate = 2.0;  // s in which pictures of the scene are counted
constexpr std::size_t kAnswers = 300;  // number of the window's pictures to remember

engine::DeviceOptions windowed(engine::DeviceOptions options) {
    options.window_extensions = engine::Window::instanceExtensions();
    return options;
}

bool computesOnProcessors(const engine::DeviceOptions& options) {
    const engine::Instance instance(engine::Validation::off);
    return engine::chooseDevice(instance, options.wanted).type == engine::DeviceType::cpu;
}

// A software device inherits the priority of the thread that creates it, so a new thread creates
// it.
std::unique_ptr<engine::Device>
makeSceneDevice(const engine::DeviceOptions& options, bool gives_way) {
    std::packaged_task<std::unique_ptr<engine::Device>()> make([&] {
        if (gives_way) engine::lowerPriority();
        return std::make_unique<engine::Device>(options);
    });
    std::future<std::unique_ptr<engine::Device>> made = make.get_future();
    std::thread(std::move(make)).join();
    return made.get();
}

std::filesystem::path preferencesOf(const ViewOptions& options) {
    if (!options.preferences.empty() || !options.script.empty()) return options.preferences;
    return usersPreferences().value_or("");
}

std::vector<std::string> thumbnailProgram(const ViewOptions& options) {
    if (options.program.empty()) return {};
    std::vector<std::string> program{options.program.string()};
    const engine::DeviceOptions& device = options.scene.device;
    if (!device.wanted.empty()) program.insert(program.end(), {"--device", device.wanted});
    if (!options.scene.cache) program.push_back("--no-cache");
    if (options.scene.outside == scene::Outside::allowed) program.push_back("--allow-outside");
    return program;
}

std::filesystem::path thumbnailFolder(const ViewOptions& options) {
    const std::filesystem::path cache = engine::userCacheFolder();
    return options.scene.cache && !cache.empty() ? cache / "thumbnails" : std::filesystem::path();
}

// Returns the size from the command line, or otherwise that of the last session.
engine::WindowDescription windowOf(const ViewOptions& options, const Preferences& preferences) {
    const ViewOptions unsaid;
    const bool as_it_was = options.width == unsaid.width && options.height == unsaid.height;
    return {
        .width = as_it_was ? preferences.width : options.width,
        .height = as_it_was ? preferences.height : options.height};
}

constexpr float kDragThreshold = 6.0f;  // px at scale 1 that make a drag of a click

}  // namespace

// ---- The window, picture by picture -------------------------------------------------------------

Shell::Shell(
    const ViewOptions& options, const SceneFile& file, const hair::Settings& settings,
    measure::HairCache cache)
    : outside(options.scene.outside), preferences(preferencesOf(options)),
      driven(!options.script.empty() || options.frames > 0), live(options.live),
      fixed_scale(static_cast<float>(options.scale)), window(windowOf(options, preferences.now)),
      gives_way(!waitsForDrawing() && computesOnProcessors(options.scene.device)),
      scene_device(makeSceneDevice(options.scene.device, gives_way)),
      device(windowed(options.scene.device)),
      presenter(device, window, preferences.now.present_mode), ui(device, window, 1.0f),
      area(device), scene(file, settings), scenes(file.directory),
      thumbnails(
          device, {.program = thumbnailProgram(options),
                   .folder = thumbnailFolder(options),
                   .drawn = &engine::Window::endWait}),
      draws_thumbnails(!waitsForDrawing()), timings(*scene_device, &engine::Window::endWait),
      previews(!driven),
      studio(
          *scene_device, options.shaders.empty() ? engine::programFile("shaders") : options.shaders,
          options.before_drawing, std::move(cache)),
      drawing(
          [this, first = true](const Order& order, const Stop& stop) mutable {
              if (std::exchange(first, false) && gives_way) engine::lowerPriority();
              return studio.perform(order, stop);
          },
          &engine::Window::endWait) {
    origin.command = options.command;
    origin.validation = options.scene.device.validation;
    // The scale on the command line is the total scale.
    if (options.scale > 0.0) preferences.now.zoom = 1.0f;
    window.setTitle("hairbench " + file.name);
    remember(preferences.now, file.path);
}

void Shell::start() {
    if (!waitsForDrawing()) return;
    orderWork();
    waitForWork();
}

double Shell::seconds() const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - opened_at;
    return passed.count();
}

// Returns how long the window may sleep, s. Events end the wait, including a finished picture of
// the scene.
double Shell::patience() const {
    if (waitsForDrawing() || unseen) return 0.0;
    if (timings.measuring().isMeasuring()) return kHolding;
    if (presenter.extent().width == 0) return kAsleep;
    const bool awake = driven || tools.isBusy() || ImGui::GetTime() < awake_until;
    if (drawing.busy()) return awake ? kMovingBeside : kAsleep;
    if (stopped) return awake ? kMoving : kAsleep;
    if (!scene.isFollowed() || state.scrub || (state.playing && !state.speed)) return 0.0;
    const bool refines = scene.side(0).shown().level > 0;
    return awake || state.playing || refines ? kMoving : kAsleep;
}

// Without events, the window is drawn a few times a second.
void Shell::waitForEvents() {
    window.poll(patience());
    looked_at = seconds();
    if (window.takeActivity()) awake_until = ImGui::GetTime() + kAwake;
}

// Sets the size of letters for the screen and the user's choice, with a matching style.
void Shell::followScale() {
    const float screen = fixed_scale > 0.0f ? fixed_scale : window.contentScale();
    const float wanted = screen * preferences.now.zoom;
    if (wanted == styled_scale && preferences.now.theme == styled_theme) return;
    if (wanted != ui.scale()) ui.setScale(wanted);
    ImGui::GetStyle() = styleOf(preferences.now.theme, wanted);
    ImGui::GetIO().MouseDragThreshold = kDragThreshold * wanted;
    styled_scale = wanted;
    styled_theme = preferences.now.theme;
}

void Shell::present() {
    presenter.frame(
        [&](engine::Commands& commands) {
            const bool all_seen = area.copy(
                commands, scene.side(0).shown(),
                scene.sideCount() > 1 ? &scene.side(1).shown() : nullptr);
            unseen |= !all_seen;
            unseen |= thumbnails.copy(commands);
        },
        [&](engine::Commands& commands) { ui.draw(commands); });
    disturbed |= drawing.busy();
}

// They would disturb frames that are timed, and compete with pictures of the scene.
Thumbnails::Draw Shell::thumbnailsToDraw() const {
    const bool times = timings.measuring().isMeasuring() || (state.playing && !stopped);
    if (!draws_thumbnails) return Thumbnails::Draw::never;
    if (times) return Thumbnails::Draw::later;
    return drawing.busy() ? Thumbnails::Draw::begun : Thumbnails::Draw::wanted;
}

void Shell::drawPicture() {
    const double start = looked_at.value_or(seconds());
    looked_at.reset();
    unseen = false;
    followScale();
    presenter.setMode(preferences.now.present_mode);
    ui.begin();
    due += double{ImGui::GetIO().DeltaTime};
    showWindow();
    thumbnails.work(thumbnailsToDraw());
    if (!ImGui::IsAnyItemActive() && !tools.isBusy())
        for (Side* const side : scene.sides()) side->settle();
    ui.end();
    present();
    if (answers.size() == kAnswers) answers.erase(answers.begin());
    answers.push_back(1000.0 * (seconds() - start));
}

void Shell::keepPreferences() {
    if (presenter.extent().width > 0) {
        // The desktop will enlarge the window again on a high-resolution screen, so its scale is
        // removed.
        const VkExtent2D size = window.size();
        const float scale = window.contentScale();
        preferences.now.width = static_cast<std::uint32_t>(static_cast<float>(size.width) / scale);
        preferences.now.height =
            static_cast<std::uint32_t>(static_cast<float>(size.height) / scale);
    }
    preferences.keep();
    if (!preferences.problem().empty() && preferences.problem() != reported_preferences) {
        reported_preferences = preferences.problem();
        message.complain(reported_preferences);
    }
}

bool Shell::frame() {
    waitForEvents();
    const double now = ImGui::GetTime();
    if (now > kept_at + kKeeping) {
        keepPreferences();
        kept_at = now;
    }
    if (window.wantsToClose()) return false;
    for (const std::filesystem::path& file : window.takeDropped()) drop(file);
    takeWork();
    const bool is_minimised = presenter.extent().width == 0;
    if (timings.measuring().isMeasuring()) {
        holdStill();
        return true;
    }
    if (is_minimised) return true;
    // While the scene is drawn, an untouched window does not change, except for its note about a
    // slow picture. That note is no reason to disturb frames being played.
    const bool untouched = !driven && !unseen && !tools.isBusy() && now >= awake_until;
    if (untouched && drawing.busy() && (state.playing || drawingNote() == shown_note)) return true;
    drawPicture();
    orderWork();
    if (waitsForDrawing()) waitForWork();
    return true;
}

// ---- The thread that draws ----------------------------------------------------------------------

// Returns the level of the next picture.
unsigned Shell::levelFor(const Order& order) {
    const bool moves = order.frames > 0 || order.seek || !scene.isFollowed() || scene.isDragged() ||
                       tools.isBusy();
    if (moves) moved_at = seconds();
    const bool exact = std::ranges::any_of(
        waiting, [](const Waiting& each) { return each.needs == Needs::picture; });
    if (!previews || exact || recorder.records()) return 0;
    if (scene.isMaking()) return PreviewControl::kFirst;
    return moves ? control.moving()
                 : control.still(scene.side(0).shown().level, seconds() - moved_at);
}

// Orders the window's next request, if any. Only one order runs at a time; later requests go into
// the next order, in their latest state.
void Shell::orderWork() {
    if (drawing.busy() || stopped) return;
    MeasurePanel& measuring = timings.measuring();
    if (const auto wanted = measuring.wanted(); wanted && !scene.isMaking()) {
        PlayState still{.playing = false};
        Order order = scene.order(still, 0.0, OpenScene::Frames::as_due);
        order.measure = MeasureOrder{
            .side = scene.side(*wanted).id(),
            .name = scene.file().name,
            .hooks = measuring.begin()};
        drawPicture();
        beginWork(std::move(order));
        return;
    }
    // A recording has every frame, whatever the speed.
    const auto frames =
        recorder.records() ? OpenScene::Frames::every_one : OpenScene::Frames::as_due;
    Order order = scene.order(state, std::exchange(due, 0.0), frames);
    order.level = levelFor(order);
    if (const auto side = timings.wantsCounts(); side && !scene.isMaking()) order.count = *side;
    const auto lacks = [&](const Side* side) {
        return side->shown().level != order.level || !side->shown().has_guides;
    };
    const bool asks = order.frames > 0 || order.seek || order.count || !scene.isFollowed() ||
                      std::ranges::any_of(scene.sides(), lacks) ||
                      (shaders.watches && seconds() >= ordered_at + kLooking);
    if (asks) beginWork(std::move(order));
}

void Shell::beginWork(Order order) {
    // Keeps pending work of the window's device out of the frame's times.
    runOnce(device, [](engine::Commands&) {});
    disturbed = false;
    ordered_at = seconds();
    drawing.begin(std::move(order));
    if (!waitsForDrawing() && drawing.waitFor(kSoon)) takeWork();
}

// Waits until the reply arrives.
void Shell::waitForWork() {
    while (drawing.busy() && !engine::interrupted()) {
        if (drawing.waitFor(kSoon)) {
            takeWork();
            return;
        }
        window.poll(0.0);
        if (timings.measuring().isMeasuring()) holdStill();
    }
}

// During a measurement, the window is only drawn between rounds.
void Shell::holdStill() {
    MeasurePanel& measuring = timings.measuring();
    if (window.wantsToClose() || engine::interrupted()) measuring.cancel();
    if (!measuring.wantsPicture()) return;
    if (presenter.extent().width > 0) {
        drawPicture();
        runOnce(device, [](engine::Commands&) {});
    }
    measuring.shown();
}

// Counts recent pictures of the scene.
double Shell::picturesPerSecond() const {
    if (came.size() < 2 || came.back() < seconds() - kOfLate) return 0.0;
    return static_cast<double>(came.size() - 1) / (came.back() - came.front());
}

void Shell::stopDrawing(const std::string& why) {
    stopped = true;
    timings.measuring().end(std::nullopt, why);
    message.complain(why + "; nothing is drawn any more, but the scene can be saved");
    actOnFollowed();
}

void Shell::takeWork() {
    std::optional<Reply> reply;
    try {
        reply = drawing.take();
    } catch (const std::exception& error) {
        // If a user is present, the changes can still be saved.
        if (driven || !scene.side(0).shown().isThere()) throw;
        stopDrawing(error.what());
        return;
    }
    if (!reply) return;
    control.drawn(reply->level, reply->milliseconds);
    timings.setMemory(reply->memory);
    timings.setReplacedShaders(reply->shaders.replaced);
    shaders = std::move(reply->shaders);
    for (const SideReply& side : reply->sides) unseen |= side.shown.has_value();
    if (!reply->sides.empty() && reply->sides.front().shown) {
        const double now = seconds();
        came.push_back(now);
        std::erase_if(came, [&](double time) { return time < now - kOfLate; });
    }
    const auto beside = disturbed ? Side::Beside::other_work : Side::Beside::nothing;
    const OpenScene::News news = scene.take(std::move(reply->sides), beside);
    if (timings.measuring().isMeasuring()) {
        timings.measuring().end(std::move(reply->measured), reply->not_measured);
        unseen = true;
    }
    takeNews(news);
    pauseIfCrawling();
    if (const auto counts = timings.wantsCounts()) {
        const Side* const side = scene.find(*counts);
        if (!side) timings.forgetCounts();
        if (side && reply->counted) timings.setCounts(std::move(*reply->counted), *side);
        unseen |= reply->counted.has_value();
    }
    const std::string& problem = scene.editedSide().problem();
    if (problem != reported) unseen = true;
    if (problem != reported && !problem.empty()) message.complain(problem);
    reported = problem;
    const Shown& shown = scene.side(0).shown();
    if (shown.level == 0) message.attempt([&] { recorder.frame(shown); });
    actOnFollowed();
}

// Pauses because a still picture is refined and shows more than one that hardly moves. Does not
// pause again if the user continues.
void Shell::pauseIfCrawling() {
    if (!previews || driven || paused_crawling || !state.playing || !control.crawls()) return;
    paused_crawling = true;
    state.playing = false;
    message.tell("paused: this device takes over a second for the coarsest picture; Space plays");
}

void Shell::takeNews(const OpenScene::News& news) {
    if (news.failure) {
        // Without a scene, the viewer cannot run.
        if (!scene.side(0).shown().isThere()) std::rethrow_exception(news.failure);
        message.attempt([&] { std::rethrow_exception(news.failure); });
    }
    if (news.opened) {
        paused_crawling = false;
        state.scrub.reset();
        state.furthest = 0;
        const SceneFile& file = scene.file();
        scenes.setFolder(file.directory);
        area.views = Views::a;
        window.setTitle("hairbench " + file.name);
        remember(preferences.now, file.path);
        message.tell("opened " + file.path.string());
    }
    if (news.compares) {
        area.views = Views::side_by_side;
        message.tell("the settings panel is B's now; A is as it was");
    }
    unseen |= news.failure || news.opened || news.compares;
}

void Shell::whenFollowed(Side& side, Needs needs, std::function<void(Side&)> act) {
    side.settle();
    waiting.push_back(
        {.side = side.id(), .revision = side.revision(), .needs = needs, .act = std::move(act)});
    actOnFollowed();
}

void Shell::actOnFollowed() {
    std::vector<Waiting> left;
    for (Waiting& each : std::exchange(waiting, {})) {
        Side* const side = scene.find(each.side);
        if (!side) {
            message.complain("the scene was closed before it was written");
        } else if (stopped && each.needs == Needs::picture) {
            message.complain("no picture can be drawn any more");
        } else if (
            stopped || (side->answered() >= each.revision &&
                        (each.needs == Needs::settings || side->shown().isExact()))) {
            // The request is applied, unless its settings are impossible.
            message.attempt([&] {
                if (!side->problem().empty())
                    throw engine::Error("the panel's settings are invalid", side->problem());
                each.act(*side);
            });
        } else {
            left.push_back(std::move(each));
        }
    }
    std::ranges::move(left, std::back_inserter(waiting));
}

// ---- Files that are opened and written ----------------------------------------------------------

std::filesystem::path Shell::suggestedPath() const {
    const SceneFile& file = scene.file();
    if (scene.wasSaved()) return file.path;
    // The user cannot write scenes of an installed program.
    const std::filesystem::path beside = file.path.parent_path();
    const bool is_users = engine::system::checkWriteAccess(beside.empty() ? "." : beside) == 0;
    return freeName(is_users ? beside : std::filesystem::current_path(), file.name, ".json");
}

void Shell::open(const std::filesystem::path& path) {
    message.attempt([&] {
        scene.open(openScene(path, outside));
        message.tell("opening " + path.string());
    });
}

// A scene written by hand contains more than its state, such as a sweep, so it is replaced only if
// the user says so.
void Shell::save() {
    if (scene.wasSaved())
        saveAs(scene.file().path);
    else
        dialog.open(FileDialog::Use::save, suggestedPath());
}

void Shell::saveAs(const std::filesystem::path& path) {
    Side& edited = scene.editedSide();
    edited.settle();
    whenFollowed(edited, Needs::settings, [this, path, settings = edited.wanted()](Side&) {
        saveScene(settings, scene.file().directory, path);
        scene.savedAs(path, settings);
        window.setTitle("hairbench " + scene.file().name);
        remember(preferences.now, path);
        message.tell("saved to " + path.string());
    });
}

void Shell::copyArguments() {
    message.attempt([&] {
        const scene::Scene saved = scene::loadScene(scene.file().path, scene::Outside::allowed);
        // The scene may have been saved to another folder than it was opened from.
        const std::string arguments = caseArguments(
            saved,
            movedFiles(scene.editedSide().wanted(), scene.file().directory, saved.directory));
        ImGui::SetClipboardText(arguments.c_str());
        message.tell(arguments.empty() ? "nothing differs from the scene" : "copied: " + arguments);
    });
}

void Shell::screenshot() {
    whenFollowed(scene.editedSide(), Needs::picture, [this](Side& side) {
        const std::filesystem::path folder = std::filesystem::current_path();
        const std::filesystem::path path =
            freeName(folder, "hairbench-" + scene.file().name, ".png");
        const Shown& shown = side.shown();
        writeScreenshot(
            path, shown.width, shown.height, shown.picture,
            sceneText(shown.settings, shown.directory, folder));
        message.tell("wrote " + path.string());
    });
}

void Shell::record() {
    message.attempt([&] {
        if (recorder.records()) {
            message.tell(recorder.summary());
            recorder.stop();
            return;
        }
        recorder.start(freeName(
            std::filesystem::current_path(), "hairbench-" + scene.file().name + "-recording",
            ".png"));
        message.tell(recorder.message());
    });
}

void Shell::drop(const std::filesystem::path& file) {
    const Dropped what = whatIs(file);
    if (what == Dropped::scene) {
        open(file);
    } else if (what == Dropped::unknown) {
        message.complain(
            file.string() +
            ": is not a scene, screenshot, groom, mesh or environment, by its name");
    } else {
        message.attempt([&] {
            const hair::Settings settings =
                withDropped(scene.editedSide().wanted(), scene.file().directory, file);
            scene.edit(scene.edited(), settings, {.changed = true});
            message.tell("took " + file.string());
        });
    }
}

}  // namespace benchmarks::viewer
