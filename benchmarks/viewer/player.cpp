#include "benchmarks/viewer/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/device.h"
#include "engine/process.h"
#include "engine/target.h"
#include "engine/transfer.h"

namespace benchmarks::viewer {
namespace {

// The effect of a change of settings.
enum class Effect {
    none,
    camera,
    drawing,
    forces,  // a running simulation can take the change
    everything,
};

Effect effectOf(const hair::Settings& before, const hair::Settings& after) {
    scene::Json a = scene::writeSettings(before), b = scene::writeSettings(after);
    const auto without = [&](const char* member) {
        a.erase(member);
        b.erase(member);
        return a == b;
    };
    if (without("description")) return Effect::none;
    for (const char* member : {"groom", "seed", "run"})
        if (a[member] != b[member]) return Effect::everything;
    if (a["simulation"] != b["simulation"]) {
        for (scene::Json* document : {&a, &b})
            for (const char* member : {"wind", "colliders", "motion", "pulls"})
                (*document)["simulation"].erase(member);
        return a["simulation"] == b["simulation"] ? Effect::forces : Effect::everything;
    }
    return without("camera") ? Effect::camera : Effect::drawing;
}

scene::Document documentOf(const hair::Settings& settings) {
    return scene::Document(scene::writeSettings(settings));
}

constexpr std::size_t kFewVertices = 1u << 19;  // about as many bytes as a 1080p picture

constexpr double kPause = 0.5;  // s without a new frame; longer than a frame on a slow device

}  // namespace

// ---- Pacer --------------------------------------------------------------------------------------

std::uint32_t Pacer::framesFor(double seconds, double frame_time, std::optional<double> speed) {
    if (!speed) {
        due_ = 0.0;
        return 1;
    }
    if (frame_time <= 0.0) return 0;
    due_ = std::min(due_ + seconds * *speed / frame_time, double{kMostFrames});
    const double whole = std::floor(due_);
    due_ -= whole;
    return static_cast<std::uint32_t>(whole);
}

// ---- Player -------------------------------------------------------------------------------------

Player::Player(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, measure::HairCache* cache, unsigned level)
    : device_(device), directory_(directory), cache_(cache), settings_(settings),
      case_(caseOf(settings)), isolated_(device, engine::Timing::isolated),
      overlapped_(device, engine::Timing::overlapped), level_(level),
      files_(directory.empty() ? std::filesystem::path(".") : directory) {
    watch();
    seek(0);
}

// Watches the scene's GLSL files. The case's own text counts as the last one read.
void Player::watch() {
    for (const scene::NamedExtension& each : scene::namedExtensions(case_->settings()))
        files_.watch(each.file, each.text);
}

std::unique_ptr<measure::Case> Player::caseOf(const hair::Settings& settings) const {
    return std::make_unique<measure::Case>(device_, settings, directory_, cache_);
}

double Player::time() const {
    return (static_cast<double>(frame_) + 1.0) * double{settings_.run.frame_time};
}

void Player::apply(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none && !previews_) return;
    scene::checkSettings(settings);
    if (effect == Effect::forces || effect == Effect::everything || previews_) {
        replace(caseOf(settings), settings);
        return;
    }
    drawWith(settings);
}

void Player::preview(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none || effect == Effect::everything) return;
    scene::checkSettings(settings);
    if (effect == Effect::forces) {
        case_->carryOn(settings.simulation);
        settings_.simulation = settings.simulation;
        previews_ = true;
        return;
    }
    drawWith(settings);
}

// Changes the drawing from the next picture on.
void Player::drawWith(const hair::Settings& settings) {
    if (effectOf(settings_, settings) == Effect::camera) {
        case_->setCamera(settings.camera);
        for (const auto& renderer : coarse_)
            if (renderer) renderer->setCamera(settings.camera);
        // A level by distance depends on the camera.
        if (settings.lod.mode == hair::LodMode::distance) coarse_ = {};
    } else {
        case_->setDrawing(settings);
        coarse_ = {};
    }
    settings_ = settings;
    outdated_ = true;
}

void Player::rebuild() { replace(caseOf(settings_), settings_); }

bool Player::reread() {
    constexpr auto kBetweenLooks = std::chrono::milliseconds(250);
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look_) return false;
    next_look_ = now + kBetweenLooks;
    watch();
    if (!files_.look()) return false;
    hair::Settings settings = settings_;
    scene::rereadExtensions(settings, directory_);
    replace(caseOf(settings), settings);
    return true;
}

void Player::replace(std::unique_ptr<measure::Case> other, const hair::Settings& settings) {
    coarse_ = {};
    case_ = std::move(other);
    settings_ = settings;
    // Everything is new and starts again, so the picture is no longer a preview.
    previews_ = false;
    seek(frame_);
}

void Player::play(engine::Timing timing, const std::function<void(engine::Passes&)>& record) {
    engine::FrameLoop& loop = timing == engine::Timing::overlapped ? overlapped_ : isolated_;
    loop.frame(record);
    record_ = loop.finish().back();
}

hair::rendering::Renderer& Player::coarse() {
    std::unique_ptr<hair::rendering::Renderer>& renderer = coarse_[level_];
    // It cannot be moved, so make_unique() does not work.
    if (!renderer)
        renderer.reset(
            new hair::rendering::Renderer(case_->rendererOf(previewSettings(settings_, level_))));
    return *renderer;
}

// Draws after the commands of `simulate`, if there are any.
void Player::drawFrame(
    engine::Timing timing, const std::function<void(engine::Passes&)>& simulate) {
    hair::rendering::Renderer* const renderer = level_ > 0 ? &coarse() : nullptr;
    play(timing, [&](engine::Passes& passes) {
        if (simulate) passes.asyncCompute(1, [&] { simulate(passes); });
        if (renderer)
            renderer->record(passes, case_->view());
        else
            case_->draw(passes);
    });
    drawn_level_ = level_;
    outdated_ = false;
    ++pictures_;
}

void Player::next(engine::Timing timing) {
    // Keeps earlier submissions out of the frame's times.
    runOnce(device_, [](engine::Commands&) {});
    drawFrame(timing, [&](engine::Passes& passes) { case_->simulate(passes); });
    ++frame_;
}

void Player::skip() {
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->simulate(passes); });
    ++frame_;
}

void Player::refresh() {
    if (outdated_ || drawn_level_ != level_) drawFrame(engine::Timing::isolated, {});
}

void Player::seek(std::uint32_t frame, const std::function<bool()>& stop) {
    // After a preview, a reset would return to the simulation's old settings.
    if (std::exchange(previews_, false)) {
        coarse_ = {};
        case_ = caseOf(settings_);
    } else {
        case_->reset();
    }
    frame_ = 0;
    while (frame_ < frame) {
        if (stop && stop()) throw engine::Interrupted();
        skip();
    }
    drawFrame(engine::Timing::isolated, [&](engine::Passes& passes) { case_->simulate(passes); });
}

Shown Player::shown(Guides guides) const {
    const hair::rendering::Renderer* const renderer = coarse_[drawn_level_].get();
    const engine::Target* const target = renderer ? &renderer->target() : nullptr;
    const hair::groom::Groom& groom = case_->groom();
    const bool reads = guides == Guides::all || groom.points.size() <= kFewVertices;
    Shown shown{
        .settings = settings_,
        .directory = directory_,
        .frame = frame_,
        .previews = previews_,
        .level = drawn_level_,
        .strand_share = 1.0,
        .width = settings_.render.width,
        .height = settings_.render.height,
        .picture = target ? engine::readOutput(device_, *target) : case_->picture(),
        .number = 0,
        .has_guides = reads,
        .guides = reads ? case_->guides() : std::vector<glm::vec3>(),
        .rest_guides = reads ? groom.points : std::vector<glm::vec3>(),
        .vertices_per_guide = groom.vertices_per_strand,
        .rest = sphereRound(groom.points),
        .head = case_->head(),
        .counts = case_->counts(),
        .backend = {},
        .transparency = {}};
    if (const auto backend = case_->backend())
        shown.backend = {hair::backendName(backend->backend), backend->variant, backend->reason};
    if (target) {
        shown.width = target->output().extent().width;
        shown.height = target->output().extent().height;
        const double all = static_cast<double>(case_->plan().strands());
        if (all > 0.0) shown.strand_share = static_cast<double>(renderer->plan().strands()) / all;
    } else {
        measure::addTransparency(*case_, shown.transparency);
    }
    return shown;
}

// ---- Shown values -------------------------------------------------------------------------------

double Shown::time() const {
    return (static_cast<double>(frame) + 1.0) * double{settings.run.frame_time};
}

std::string Shown::pictureHash() const {
    return report::hashBytes(std::as_bytes(std::span(picture)));
}

Sphere groomNow(const Shown& shown) {
    if (!shown.guides.empty()) return sphereRound(shown.guides);
    Sphere groom = shown.rest;
    groom.center = shown.head(groom.center);
    return groom;
}

std::string Shown::stateHash() const { return report::hashBytes(std::as_bytes(std::span(guides))); }

// ---- Timings of drawn frames --------------------------------------------------------------------

void TimingHistory::add(
    const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number) {
    TimedFrames& frames = timing == engine::Timing::overlapped ? overlapped_ : isolated_;
    if (frames.size() == kFrames) {
        frames.records.erase(frames.records.begin());
        frames.numbers.erase(frames.numbers.begin());
    }
    frames.records.push_back(frame);
    frames.numbers.push_back(number);
}

void TimingHistory::clear() {
    isolated_ = {};
    overlapped_ = {};
    ++revision_;
}

// ---- Edit history -------------------------------------------------------------------------------

EditHistory::EditHistory(scene::Document document) { documents_.push_back(std::move(document)); }

void EditHistory::edit(scene::Document document, bool continues) {
    const bool replaces = continues && continuing_;
    if (!replaces && document == current()) return;
    continuing_ = continues;
    if (replaces) {
        documents_[index_] = std::move(document);
        return;
    }
    documents_.resize(index_ + 1);
    documents_.push_back(std::move(document));
    ++index_;
}

const scene::Document& EditHistory::undo() {
    if (canUndo()) --index_;
    continuing_ = false;
    return current();
}

const scene::Document& EditHistory::redo() {
    if (canRedo()) ++index_;
    continuing_ = false;
    return current();
}

// ---- Side ---------------------------------------------------------------------------------------

Side::Side(std::uint64_t id, const hair::Settings& settings, const std::filesystem::path& directory)
    : id_(id), directory_(directory), wanted_(settings), original_(settings),
      history_(documentOf(settings)) {
    shown_.settings = settings;
    shown_.directory = directory;
}

void Side::edit(const hair::Settings& settings, Edit edit) {
    if (!edit.changed) return;
    wanted_ = settings;
    scene::rereadExtensions(wanted_, directory_);
    history_.edit(documentOf(wanted_), edit.continues);
    continues_ = edit.continues;
    ++revision_;
}

void Side::settle() {
    history_.settle();
    if (!continues_) return;
    continues_ = false;
    ++revision_;
}

void Side::undo() {
    wanted_ = scene::readSettings(history_.undo().json());
    scene::rereadExtensions(wanted_, directory_);
    continues_ = false;
    ++revision_;
}

void Side::redo() {
    wanted_ = scene::readSettings(history_.redo().json());
    scene::rereadExtensions(wanted_, directory_);
    continues_ = false;
    ++revision_;
}

SideOrder Side::order() const {
    return {
        .side = id_,
        .revision = revision_,
        .settings = wanted_,
        .continues = continues_,
        .directory = directory_,
        .beside = std::nullopt};
}

void Side::take(SideReply reply, Beside beside) {
    answered_ = reply.revision;
    problem_ = std::move(reply.problem);
    if (reply.reread) scene::rereadExtensions(wanted_, directory_);
    if (reply.restarts_timings) timings_.clear();
    if (reply.timed && beside == Beside::nothing)
        timings_.add(reply.timed->record, reply.timed->timing, reply.timed->number);
    if (reply.shown) shown_ = std::move(*reply.shown);
}

// ---- Moment of a drag ---------------------------------------------------------------------------

Moment momentAfter(std::uint32_t frame, double frame_time, double time_step) {
    const double step = frame_time > 0.0 ? frame_time : time_step;
    // Computes a frame's time as one product, whichever frame asks for it. A key for a frame then
    // has exactly that frame's time.
    const auto after = [&](double frames) {
        if (frame_time > 0.0)
            return static_cast<float>((static_cast<double>(frame) + 1.0 + frames) * step);
        return static_cast<float>(frames * step);
    };
    const auto ascending = [](float before, float time) {
        return std::max(time, std::nextafter(before, std::numeric_limits<float>::max()));
    };
    Moment moment{.now = after(0.0)};
    moment.next = ascending(moment.now, after(1.0));
    moment.later = ascending(moment.next, after(1.0 + Pacer::kMostFrames));
    return moment;
}

Moment momentOf(const Shown& shown) {
    const hair::Settings& settings = shown.settings;
    return momentAfter(
        shown.frame, double{settings.run.frame_time}, double{settings.simulation.time_step});
}

// ---- Running clock ------------------------------------------------------------------------------

bool RunningClock::runs(const Shown& shown, double seconds) {
    const auto [entry, is_new] = seen_.try_emplace(&shown, Seen{.frame = shown.frame});
    Seen& seen = entry->second;
    if (seen.frame != shown.frame) seen = {shown.frame, seconds};
    return seconds - seen.since < kPause;
}

}  // namespace benchmarks::viewer
