#include "benchmarks/viewer/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/schema.h"
#include "engine/device.h"
#include "engine/process.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/fields.h"

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
    hair::Settings same = after;  // takes over what may differ
    same.description = before.description;
    if (!hair::differ(before, same)) return Effect::none;
    same.camera = before.camera;
    if (!hair::differ(before, same)) return Effect::camera;
    if (before.seed != after.seed || hair::differ(before.groom, after.groom) ||
        hair::differ(before.run, after.run))
        return Effect::everything;
    const bool own = motions(before.copies) > 1 || motions(after.copies) > 1;
    if (own && hair::differ(before.copies, after.copies)) return Effect::everything;
    hair::SimulationSettings& simulation = same.simulation;
    if (!hair::differ(before.simulation, simulation)) return Effect::drawing;
    simulation.wind = before.simulation.wind;
    simulation.colliders = before.simulation.colliders;
    simulation.motion = before.simulation.motion;
    simulation.pulls = before.simulation.pulls;
    return hair::differ(before.simulation, simulation) ? Effect::everything : Effect::forces;
}

constexpr std::size_t kFewVertices = 1u << 19;  // about as many bytes as a 1080p picture

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

namespace {

constexpr float kCoarsestLod = 8.0f;  // limit of /lod/level

// A level takes at most 2.5 times the work of the next coarser one.
constexpr double kLittle = 0.4 * PreviewControl::kAim;
constexpr double kClearlyWithin = 0.8 * PreviewControl::kAim;
constexpr unsigned kMostPatience = 256;  // pictures

// ms. A picture that is refined within this time hardly delays the user's next move.
constexpr double kAtOnce = 250.0;
constexpr double kShareOfWait = 0.25;  // share of a picture's time to wait before it is drawn
constexpr double kShortestWait = 0.15;  // s
constexpr double kLongestWait = 3.0;

// Thesis 2.3.8.1, as in hair/rendering/strand_plan.cpp for every root.
float lodAtTarget(const hair::LodSettings& lod, const hair::CameraSettings& camera) {
    if (lod.mode == hair::LodMode::forced) return lod.level;
    if (lod.mode == hair::LodMode::cluster) return 0.0f;  // only the device knows
    const float distance = glm::length(camera.position - camera.target);
    if (distance <= lod.near_distance || lod.far_distance <= lod.near_distance) return 0.0f;
    const float share =
        std::log2(distance / lod.near_distance) / std::log2(lod.far_distance / lod.near_distance);
    return lod.maximum_level * std::min(share, 1.0f);
}

std::uint32_t scaled(std::uint32_t pixels, float share) {
    return std::max(
        static_cast<std::uint32_t>(std::lround(static_cast<float>(pixels) * share)), 1u);
}

}  // namespace

// ---- Levels of preview --------------------------------------------------------------------------

hair::Settings previewSettings(const hair::Settings& settings, unsigned level) {
    hair::Settings coarse = settings;
    if (level == 0) return coarse;
    const PreviewLevel& preview = kPreviewLevels[std::min(level, kCoarsestPreview)];
    coarse.lod.level =
        std::min(lodAtTarget(settings.lod, settings.camera) + preview.coarser, kCoarsestLod);
    coarse.lod.mode = hair::LodMode::forced;
    coarse.render.width = scaled(settings.render.width, preview.across);
    coarse.render.height = scaled(settings.render.height, preview.across);
    coarse.render.msaa = 1;
    coarse.render.ssaa = 1;
    return coarse;
}

std::string
previewText(unsigned level, double strand_share, std::uint32_t width, std::uint32_t height) {
    const double percent = 100.0 * strand_share;
    const std::string share =
        percent > 0.0 && percent < 1.0 ? "under 1" : std::to_string(std::lround(percent));
    return "preview, level " + std::to_string(level) + " of " + std::to_string(kCoarsestPreview) +
           ": " + share + " % of strands at " + std::to_string(width) + " × " +
           std::to_string(height);
}

// ---- Player -------------------------------------------------------------------------------------

Player::Player(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, measure::HairCache* cache, unsigned level)
    : device_(device), directory_(directory), cache_(cache), settings_(settings),
      case_(caseOf(settings)), probes_(probesOf(*case_, settings)),
      isolated_(device, engine::Timing::isolated), overlapped_(device, engine::Timing::overlapped),
      level_(level), files_(directory.empty() ? std::filesystem::path(".") : directory) {
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

std::unique_ptr<hair::simulation::Probes>
Player::probesOf(const measure::Case& probed, const hair::Settings& settings) const {
    const hair::ProbeSettings& wanted = settings.run.probes;
    if (!hair::simulation::hasProbes(wanted)) return nullptr;
    return std::make_unique<hair::simulation::Probes>(
        device_, probed.groom(), settings.simulation, wanted, 1);
}

// Adds the values of the state. The frame's own times are known by then.
void Player::probe() {
    if (!probes_) return;
    probes_->restart();
    isolated_.frame([&](engine::Passes& passes) { case_->probe(passes, *probes_); });
    isolated_.finish();
    const auto append = [](std::vector<double>& history, double value) {
        if (history.size() == kMostProbed) history.erase(history.begin());
        history.push_back(value);
    };
    append(probed_.times, case_->time());
    const std::vector<std::vector<double>> values = probes_->read();
    for (std::size_t i = 0; i < values.size(); ++i)
        for (const double value : values[i]) append(probed_.values[i], value);
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
    std::unique_ptr<hair::simulation::Probes> probes = probesOf(*other, settings);
    coarse_ = {};
    case_ = std::move(other);
    probes_ = std::move(probes);
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
            renderer->record(passes, case_->views());
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
    probe();
    ++frame_;
}

void Player::skip() {
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->simulate(passes); });
    probe();
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
    probed_ = {};
    if (probes_) {
        probed_.names = measure::probeNames(settings_);
        probed_.values.resize(probed_.names.size());
    }
    probe();  // the start
    frame_ = 0;
    while (frame_ < frame) {
        if (stop && stop()) throw engine::Interrupted();
        skip();
    }
    drawFrame(engine::Timing::isolated, [&](engine::Passes& passes) { case_->simulate(passes); });
    probe();
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
        .counts = case_->counts()};
    shown.probes = probed_;
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

// ---- Choice of the level of preview -------------------------------------------------------------

double PreviewControl::expected(unsigned level) const {
    double factor = 1.0;
    for (unsigned coarser = level; coarser <= kCoarsestPreview; ++coarser, factor *= 2.0)
        if (took_[coarser] > 0.0) return took_[coarser] * factor;
    return 0.0;
}

void PreviewControl::drawn(unsigned level, double milliseconds) {
    if (level > kCoarsestPreview || !(milliseconds > 0.0)) return;
    took_[level] = milliseconds;
    crawling_ = level == kCoarsestPreview && milliseconds > kCrawl ? crawling_ + 1 : 0;
    if (level != moving_) {
        // A finer picture was drawn while nothing moved, so the next move may start at its level.
        if (level < moving_ && milliseconds < kClearlyWithin) {
            moving_ = level;
            calm_ = 0;
        }
        // Nothing is known yet about pictures in motion.
        while (moving_ < level && took_[moving_] == 0.0 && expected(moving_) > kAim) ++moving_;
        return;
    }
    if (milliseconds > kAim) {
        const double halvings = std::ceil(std::log2(milliseconds / kAim));
        const unsigned steps =
            static_cast<unsigned>(std::clamp(halvings, 1.0, double{kCoarsestPreview}));
        if (tried_finer_) patience_ = std::min(2 * patience_, kMostPatience);
        moving_ = std::min(moving_ + steps, kCoarsestPreview);
        calm_ = 0;
        tried_finer_ = false;
        return;
    }
    if (milliseconds >= kLittle) {
        calm_ = 0;
        return;
    }
    if (moving_ == 0 || ++calm_ < patience_) return;
    --moving_;
    calm_ = 0;
    tried_finer_ = true;
}

unsigned PreviewControl::still(unsigned shown, double seconds) const {
    if (shown == 0) return 0;
    unsigned next = shown - 1;
    for (unsigned finer = 0; finer < next; ++finer)
        if (expected(finer) <= kAtOnce) next = finer;
    const double wait =
        std::clamp(kShareOfWait * expected(next) / 1000.0, kShortestWait, kLongestWait);
    return seconds >= wait ? next : shown;
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

}  // namespace benchmarks::viewer
