#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/recording.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/pattern.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/npy.h"
#include "hair/simulation/probes.h"

namespace benchmarks::commands {

namespace {

// ---- Cases of a sweep, each with its file -------------------------------------------------------

engine::Error needsCasePlace(const std::string& option) {
    return {option, "needs {case} in the name of the file, which stands for that of each case"};
}

// Returns all cases of the sweep that the options leave if `sweeps`, otherwise the scene itself.
// Empty if --filter matches none.
std::vector<run::PlannedCase>
casesToPlay(const SweepOptions& options, bool sweeps, scene::AssetStore& assets) {
    if (sweeps) return run::planRun(options.scene, options.filter, options.shard, &assets).cases;
    if (!options.filter.empty() || !options.shard.empty())
        throw needsCasePlace(options.filter.empty() ? "--shard" : "--filter");
    if (options.resume) throw needsCasePlace("--resume");
    for (const std::string& axis : options.scene.axes)
        if (scene::parseAxis(axis).values.size() > 1) throw needsCasePlace("--axis " + axis);
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    run::PlannedCase only{
        .spec = scene::singleCase(scene, options.scene, &assets), .directory = scene.directory};
    only.spec.name = scene.name;
    return {std::move(only)};
}

// Returns a file for each case, all of which can be written.
std::vector<std::filesystem::path> filesOf(
    const std::vector<run::PlannedCase>& cases, const std::filesystem::path& pattern,
    const std::filesystem::path& scene) {
    std::vector<std::filesystem::path> files;
    for (const run::PlannedCase& each : cases) {
        files.push_back(scene::caseFile(pattern, scene.stem().string(), each.spec.name));
        if (std::ranges::count(files, files.back()) > 1)
            throw engine::Error(files.back().string(), "is the file of two cases");
    }
    return files;
}

// Returns the record of a sweep's finished cases, beside its files; each shard has its own, so that
// they may run at once. `identity` has the options of the command that its files depend on. A scene
// alone needs none.
std::optional<run::SweepRecord> recordOf(
    const SweepOptions& options, bool sweeps, const std::filesystem::path& pattern,
    const engine::Device& device, scene::Json identity) {
    if (!sweeps) return std::nullopt;
    identity["device"] = device.info().name;
    identity["driver"] = device.info().driver_version;
    identity["filter"] = options.filter;
    std::string name = options.scene.scene.stem().string();
    if (!options.shard.empty()) name += "_part_" + options.shard;
    return std::make_optional<run::SweepRecord>(
        run::journalFile(scene::caseFile(pattern, "", name)), std::move(identity), options.resume);
}

// Returns what an earlier sweep kept of each case, if its files are there; null: it is to be
// played. Says how many there are.
std::vector<scene::Json> keptCases(
    const std::optional<run::SweepRecord>& record, const std::vector<run::PlannedCase>& cases,
    const std::function<bool(std::size_t, const scene::Json&)>& has_files) {
    std::vector<scene::Json> kept(cases.size());
    std::size_t count = 0;
    for (std::size_t i = 0; record && i < cases.size(); ++i) {
        scene::Json known = record->finished(cases[i].spec);
        if (known.is_null() || !has_files(i, known)) continue;
        kept[i] = std::move(known);
        ++count;
    }
    if (count > 0)
        std::cerr << count << " of " << cases.size() << " cases are there already, "
                  << cases.size() - count << " are played\n";
    return kept;
}

int sayNothingMatches(const SweepOptions& options) {
    std::cerr << "hairbench: no case's name matches '" << options.filter << "'"
              << (options.shard.empty() ? "" : " in part " + options.shard) << '\n';
    return report::kNothingRan;
}

scene::Json toJson(const scene::CaseSpec& spec) {
    scene::Json axes = scene::Json::object();
    for (const scene::AxisValue& each : spec.axes) axes[each.pointer] = each.value.json();
    return {{"name", spec.name}, {"axes", axes}};
}

std::string textOf(const scene::Json& json) {
    return json.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

}  // namespace

// ---- hairbench render ---------------------------------------------------------------------------

namespace {

bool isNumPy(const std::filesystem::path& file) {
    return hair::groom::lowerCaseExtension(file) == ".npy";
}

void checkFormat(const std::filesystem::path& file, bool linear) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    if (!extension.empty() && extension != ".png" && extension != ".exr" && extension != ".npy")
        throw engine::Error(file.string(), "is neither .png nor .exr nor .npy");
    if (linear && !isNumPy(file)) throw engine::Error("--linear", "is for .npy");
}

template <class Number>
void writeArray(
    const std::filesystem::path& file, hair::groom::NpyType type,
    const std::array<std::uint64_t, 3>& shape, const std::vector<Number>& numbers) {
    engine::writeFileAtomically(file, [&](std::ostream& out) {
        out << hair::groom::npyHeader(type, shape);
        out.write(
            reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
    });
}

void writePicture(const measure::Case& picture, bool linear, const std::filesystem::path& file) {
    const hair::RenderSettings& render = picture.settings().render;
    if (isNumPy(file) && linear)
        writeArray(
            file, hair::groom::NpyType::float32, {render.height, render.width, 3},
            picture.radiance());
    else if (isNumPy(file))
        writeArray(
            file, hair::groom::NpyType::uint8, {render.height, render.width, 4}, picture.picture());
    else if (hair::groom::lowerCaseExtension(file) == ".exr")
        engine::writeExr(file, render.width, render.height, picture.radiance());
    else
        engine::writePng(file, render.width, render.height, picture.picture());
}

// Plays a case from its first frame, one step of `progress` per frame, and draws the frames of the
// range. Calls `drawn` after each drawn frame.
void play(
    const engine::Device& device, measure::Case& picture, const scene::FrameRange& range,
    measure::Progress& progress, const std::function<void(std::uint32_t)>& drawn) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (std::uint32_t i = 0; i < range.end; ++i) {
        engine::checkInterrupted();
        const bool draws = range.holds(i);
        progress.begin((draws ? "draws frame " : "plays frame ") + std::to_string(i));
        loop.frame([&](engine::Passes& passes) {
            draws ? picture.frame(passes) : picture.simulate(passes);
        });
        if (draws) drawn(i);
    }
}

// Frames of a case, and the names of their files.
struct PictureFiles {
    scene::FrameRange range;
    std::optional<scene::FramePaths> paths;  // with a number; absent: `only`
    std::filesystem::path only;

    std::filesystem::path of(std::uint32_t frame) const { return paths ? paths->of(frame) : only; }
};

PictureFiles pictureFiles(const RenderOptions& options, const std::filesystem::path& file) {
    PictureFiles files{
        .range = {.first = options.frame, .end = options.frame + 1}, .paths = {}, .only = file};
    if (!options.frames.empty()) {
        files.range = scene::parseFrameRange(options.frames);
        files.paths.emplace(file);
        if (!files.paths->hasNumber() && files.range.count() > 1)
            throw engine::Error(
                file.string(), "needs a place for the number of the frame, as in out/%04d.png");
    }
    return files;
}

// Draws the frames of a case, and returns what it wrote. Adds it to `written` picture by picture.
void renderCase(
    const engine::Device& device, const run::PlannedCase& planned, const PictureFiles& files,
    const RenderOptions& options, measure::HairCache& cache, measure::Progress& progress,
    scene::Json& written) {
    const hair::RenderSettings& render = planned.spec.settings.render;
    {
        const engine::HeldMessages held;  // they count the pictures
        written = toJson(planned.spec);
        written["width"] = render.width;
        written["height"] = render.height;
        written["pictures"] = scene::Json::array();
    }
    measure::Case picture(device, planned.spec.settings, planned.directory, &cache);
    for (const std::string& warning : measure::inspectStart(picture).warnings)
        std::cerr << "hairbench: " << engine::shownText(warning) << '\n';
    play(device, picture, files.range, progress, [&](std::uint32_t frame) {
        writePicture(picture, options.linear, files.of(frame));
        const engine::HeldMessages held;
        written["pictures"].push_back({{"frame", frame}, {"file", files.of(frame).string()}});
    });
    progress.clear();
    std::string hash = picture.pictureHash();
    {
        const engine::HeldMessages held;
        written["image_hash"] = std::move(hash);
    }
    for (const std::string& warning : picture.warnings())
        std::cerr << "hairbench: " << engine::shownText(warning) << '\n';
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    if (const std::string text = measure::droppedFragments(picture); !text.empty())
        std::cerr << "hairbench: " << text << '\n';
    if (options.sweep.json) return;
    std::cout << engine::shownText(files.only.string()) << ": ";
    const scene::FrameRange& range = files.range;
    if (range.count() > 1) {
        std::cout << range.count() << " pictures, frames " << range.first << " to "
                  << range.first + (range.count() - 1) * range.step;
    } else {
        std::cout << "frame " << range.first;
    }
    std::cout << " of " << engine::shownText(planned.spec.name) << ", " << render.width << " x "
              << render.height << " px, image " << picture.pictureHash() << '\n';
}

}  // namespace

int renderScene(const RenderOptions& options) {
    checkFormat(options.out, options.linear);
    pictureFiles(options, options.out);  // before anything is read
    const scene::SceneOptions& wanted = options.sweep.scene;
    measure::HairCache cache = measure::userHairCache(wanted.cache);
    const std::vector<run::PlannedCase> cases =
        casesToPlay(options.sweep, scene::hasCasePlace(options.out), cache.assets());
    if (cases.empty()) return sayNothingMatches(options.sweep);
    std::vector<PictureFiles> files;
    for (const std::filesystem::path& each : filesOf(cases, options.out, wanted.scene)) {
        files.push_back(pictureFiles(options, each));
        engine::checkWritable(files.back().of(files.back().range.first));
    }

    const engine::Device device(wanted.device);
    std::optional<run::SweepRecord> record = recordOf(
        options.sweep, scene::hasCasePlace(options.out), options.out, device,
        {{"command", "render"},
         {"file", options.out.string()},
         {"frame", options.frame},
         {"frames", options.frames},
         {"linear", options.linear}});
    std::vector<scene::Json> kept =
        keptCases(record, cases, [](std::size_t, const scene::Json& entry) {
            return std::ranges::all_of(entry.at("pictures"), [](const scene::Json& each) {
                return std::filesystem::exists(each.at("file").get<std::string>());
            });
        });
    const auto to_play = static_cast<std::size_t>(std::ranges::count(kept, scene::Json()));
    measure::Progress progress(to_play * files.front().range.end);
    scene::Json document = {
        {"schema", "hairbench-pictures/1.0.0"}, {"scene", wanted.scene.string()}};
    scene::Json written = scene::Json::array();
    bool interrupted = false;
    const auto say_interrupted = [&] {
        std::size_t pictures = 0;
        for (const scene::Json& each : written)
            if (!each.is_null()) pictures += each.at("pictures").size();
        std::cerr << "interrupted: " << pictures << " of "
                  << cases.size() * files.front().range.count() << " pictures are written"
                  << (record ? "; --resume continues\n" : "\n");
    };
    const engine::InterruptMessage last_words(say_interrupted);
    try {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            scene::Json entry = std::move(kept[i]);
            const bool is_kept = !entry.is_null();
            {
                const engine::HeldMessages held;
                written.push_back(std::move(entry));
            }
            if (is_kept) continue;
            renderCase(device, cases[i], files[i], options, cache, progress, written.back());
            if (record) record->add(cases[i].spec, written.back());
        }
        engine::finishInAnyCase();
        if (record) record->complete();
    } catch (const engine::Interrupted&) {
        progress.clear();
        say_interrupted();
        interrupted = true;
    }
    document["interrupted"] = interrupted;
    document["cases"] = std::move(written);
    if (options.sweep.json) std::cout << textOf(document);
    return interrupted ? report::kInterrupted : report::kOk;
}

// ---- hairbench reference ------------------------------------------------------------------------

int renderReference(const ReferenceOptions& options) {
    const std::string extension = hair::groom::lowerCaseExtension(options.out);
    if (extension != ".exr" && extension != ".png")
        throw engine::Error(options.out.string(), "is neither .png nor .exr");
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    const hair::Settings& settings = spec.settings;
    engine::checkWritable(options.out);
    reference::checkReferenceTool();

    try {
        const engine::ScratchFolder folder;
        {
            const engine::Device device(options.scene.device);
            reference::exportMitsuba(device, scene, settings, options.frame, folder.path(), cache);
            for (const std::string& message : device.messages().take())
                std::cerr << message << '\n';
        }
        reference::traceMitsuba(folder.path(), options.samples, options.out);
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return report::kInterrupted;
    }
    std::cout << options.out.string() << ": frame " << options.frame << " of " << scene.name << ", "
              << settings.render.width << " x " << settings.render.height << " px, "
              << options.samples << " samples per pixel\n";
    return report::kOk;
}

// ---- hairbench export ---------------------------------------------------------------------------

namespace {

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

}  // namespace

int exportScene(const ExportOptions& options) {
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    engine::checkWritable(options.mitsuba / "scene.xml");

    const engine::Device device(options.scene.device);
    try {
        const reference::MitsubaExport written = reference::exportMitsuba(
            device, scene, spec.settings, options.frame, options.mitsuba, cache);
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        std::cout << (options.mitsuba / "scene.xml").string() << ": frame " << options.frame
                  << " of " << scene.name << ", " << written.strands << " strands, "
                  << written.points << " points, " << written.triangles << " triangles\n";
        if (written.strands > 0)
            std::cout << "directions of strands within 2 mm of each other differ by "
                      << figure(written.orientation_spread)
                      << " degrees: /shading/orientation_spread\n";
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: the scene is not written\n";
        return report::kInterrupted;
    }
    return report::kOk;
}

// ---- hairbench diff -----------------------------------------------------------------------------

namespace {

scene::Json toJson(const reference::PictureErrors& errors) {
    return {{"width", errors.width},
            {"height", errors.height},
            {"rmse", errors.rmse},
            {"psnr_db", errors.psnr ? scene::Json(*errors.psnr) : scene::Json()},
            {"ssim", errors.ssim},
            {"flip", errors.flip}};
}

}  // namespace

int diffPictures(const DiffOptions& options) {
    if (!options.out.empty()) engine::checkWritable(options.out);
    const reference::PictureErrors errors =
        reference::comparePictures(options.reference, options.picture, options.out);
    if (options.json) {
        std::cout << toJson(errors).dump(2) << '\n';
        return report::kOk;
    }
    std::cout << engine::shownText(options.picture.string()) << " against "
              << engine::shownText(options.reference.string()) << ", " << errors.width << " x "
              << errors.height << " px\n"
              << "RMSE  " << figure(errors.rmse) << '\n'
              << "PSNR  " << (errors.psnr ? figure(*errors.psnr) : "infinite") << " dB\n"
              << "SSIM  " << figure(errors.ssim) << '\n'
              << "FLIP  " << figure(errors.flip) << '\n';
    return report::kOk;
}

// ---- hairbench simulate -------------------------------------------------------------------------

namespace {

// A JSON text that stands in an archive with a case's positions.
std::string metadataOf(const SimulateOptions& options, const scene::CaseSpec& spec) {
    scene::Json metadata = toJson(spec);
    metadata["scene"] = options.sweep.scene.scene.string();
    metadata["version"] = report::versionText();
    metadata["frames"] = options.recording.frames;
    metadata["settings"] = run::documentOf(spec).json();
    return metadata.dump(-1, ' ', false, scene::Json::error_handler_t::replace);
}

scene::Json describeFile(const groom::Recorded& recorded, const groom::RecordingOptions& options) {
    const std::uint32_t last = options.frames - 1;
    return {
        {"file", options.out.string()},
        {"strands", recorded.strands.strandCount()},
        {"points", recorded.strands.points.size()},
        {"first_frame", groom::holdsFrames(options.out) ? 0 : last},
        {"last_frame", last}};
}

void printFile(const scene::Json& written) {
    const std::filesystem::path file = written.at("file").get<std::string>();
    std::error_code no_size;  // for a pipe
    const std::uintmax_t size = std::filesystem::file_size(file, no_size);
    const std::string last = written.at("last_frame").dump();
    std::cout << engine::shownText(file.string()) << ": " << written.at("strands") << " strands, "
              << written.at("points") << " points, "
              << (groom::holdsFrames(file) ? "frames 0 to " + last
                                           : "frame " + last + ", the last,")
              << " of " << engine::shownText(written.at("name").get<std::string>())
              << (no_size ? "" : ", " + report::sizeText(size)) << '\n';
}

// Probes of the cases that were played.
struct ProbeTable {
    std::vector<std::string> cases;
    std::vector<measure::PlayedProbes> played;

    void add(const std::string& name, measure::PlayedProbes probes) {
        cases.push_back(name);
        played.push_back(std::move(probes));
    }

    // The probes of any case, each once.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const measure::PlayedProbes& each : played)
            for (const std::string& name : each.names)
                if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        return names;
    }
};

// Writes a row for each frame of each case, and a column for each probe, as RFC 4180 has it. A
// probe that a case lacks, or that is not a number, is empty.
void writeProbes(const ProbeTable& probes, const std::filesystem::path& file) {
    const std::vector<std::string> names = probes.names();
    std::ostringstream table;
    table.precision(9);  // enough for 32 bits
    table << "case,frame,probe.time";
    for (const std::string& name : names) table << ',' << name;
    table << '\n';
    for (std::size_t i = 0; i < probes.cases.size(); ++i) {
        const measure::PlayedProbes& played = probes.played[i];
        for (std::size_t frame = 0; frame < played.times.size(); ++frame) {
            table << std::quoted(probes.cases[i], '"', '"') << ',' << frame << ','
                  << played.times[frame];
            for (const std::string& name : names) {
                table << ',';
                const auto found = std::ranges::find(played.names, name);
                if (found == played.names.end()) continue;
                const double value =
                    played.values[static_cast<std::size_t>(found - played.names.begin())][frame];
                if (std::isfinite(value)) table << value;
            }
            table << '\n';
        }
    }
    engine::writeFileAtomically(file, table.str());
}

void checkProbes(const std::vector<run::PlannedCase>& cases) {
    for (const run::PlannedCase& each : cases)
        if (!hair::simulation::hasProbes(each.spec.settings.run.probes))
            throw engine::Error("--probes", each.spec.name + " asks for none: see /run/probes");
}

// A value that is not finite is null.
scene::Json toJson(const measure::PlayedProbes& probes) {
    return {{"names", probes.names}, {"times", probes.times}, {"values", probes.values}};
}

measure::PlayedProbes probesOf(const scene::Json& json) {
    measure::PlayedProbes probes{
        .names = json.at("names").get<std::vector<std::string>>(),
        .times = json.at("times").get<std::vector<double>>(),
        .values = {},
        .pass_times = {}};
    for (const scene::Json& row : json.at("values")) {
        std::vector<double>& values = probes.values.emplace_back();
        for (const scene::Json& value : row)
            values.push_back(
                value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
    }
    return probes;
}

// Plays a case once and writes its strands.
void simulateCase(
    const engine::Device& device, const run::PlannedCase& planned, const SimulateOptions& options,
    const std::filesystem::path& file, measure::HairCache& cache,
    std::optional<run::SweepRecord>& record, ProbeTable& probes, scene::Json& written) {
    groom::RecordingOptions recording = options.recording;
    recording.out = file;
    recording.probes = !options.probes.empty();
    recording.metadata = metadataOf(options, planned.spec);
    groom::Recorded recorded = groom::recordStrands(
        device, planned.directory, planned.spec.name, planned.spec.settings, recording, cache);
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    for (const std::string& warning : recorded.warnings)
        std::cerr << engine::shownText(warning) << '\n';
    scene::Json entry = toJson(planned.spec);
    if (!file.empty()) {
        entry.update(describeFile(recorded, recording));
        if (!options.sweep.json) printFile(entry);
    }
    if (record) {
        scene::Json line = {{"entry", entry}};
        if (recorded.probes) line["probes"] = toJson(*recorded.probes);
        record->add(planned.spec, line);
    }
    if (recorded.probes) probes.add(planned.spec.name, std::move(*recorded.probes));
    written.push_back(std::move(entry));
}

// Takes what an earlier sweep kept of a case.
void takeKept(
    const scene::Json& kept, const scene::CaseSpec& spec, ProbeTable& probes,
    scene::Json& written) {
    if (const auto played = kept.find("probes"); played != kept.end())
        probes.add(spec.name, probesOf(*played));
    written.push_back(kept.at("entry"));
}

// Writes the table, and adds it to `document`.
void finishProbes(const ProbeTable& probes, const SimulateOptions& options, scene::Json& document) {
    if (probes.cases.empty()) return;
    writeProbes(probes, options.probes);
    const std::vector<std::string> names = probes.names();
    scene::Json units = scene::Json::object();
    for (const std::string& name : names)
        units[name] = report::Metric(report::metricNamed(name), {}).unit;
    document["probes"] = {
        {"file", options.probes.string()},
        {"first_frame", 0},
        {"last_frame", options.recording.frames},
        {"units", units}};
    if (!options.sweep.json)
        std::cout << engine::shownText(options.probes.string()) << ": " << names.size()
                  << " probes, frames 0 to " << options.recording.frames << " of "
                  << probes.cases.size() << (probes.cases.size() == 1 ? " case\n" : " cases\n");
}

}  // namespace

int simulateScene(const SimulateOptions& options) {
    const std::filesystem::path& out = options.recording.out;
    if (out.empty() && options.probes.empty())
        throw engine::Error("simulate", "needs --export or --probes");
    const scene::SceneOptions& wanted = options.sweep.scene;
    measure::HairCache cache = measure::userHairCache(wanted.cache);
    // Throws early for an unknown format.
    if (!out.empty() && !groom::isArray(out)) hair::groom::strandExporterOf(out);
    const bool sweeps = out.empty() || scene::hasCasePlace(out);
    const std::vector<run::PlannedCase> cases = casesToPlay(options.sweep, sweeps, cache.assets());
    if (cases.empty()) return sayNothingMatches(options.sweep);
    std::vector<std::filesystem::path> files(cases.size());
    if (!out.empty()) files = filesOf(cases, out, wanted.scene);
    if (!out.empty())
        for (const std::filesystem::path& each : files) engine::checkWritable(each);
    if (!options.probes.empty()) {
        checkProbes(cases);
        engine::checkWritable(options.probes);
    }

    const engine::Device device(wanted.device);
    std::optional<run::SweepRecord> record = recordOf(
        options.sweep, sweeps, out.empty() ? options.probes : out, device,
        {{"command", "simulate"},
         {"file", out.string()},
         {"frames", options.recording.frames},
         {"guides", options.recording.guides},
         {"probes", !options.probes.empty()}});
    const std::vector<scene::Json> kept =
        keptCases(record, cases, [&](std::size_t i, const scene::Json&) {
            return files[i].empty() || std::filesystem::exists(files[i]);
        });
    scene::Json document = {
        {"schema", "hairbench-simulation/1.0.0"}, {"scene", wanted.scene.string()}};
    scene::Json written = scene::Json::array();
    ProbeTable probes;
    bool interrupted = false;
    try {
        for (std::size_t i = 0; i < cases.size(); ++i)
            if (kept[i].is_null())
                simulateCase(device, cases[i], options, files[i], cache, record, probes, written);
            else
                takeKept(kept[i], cases[i].spec, probes, written);
        if (record) record->complete();
    } catch (const engine::Interrupted&) {
        interrupted = true;
        std::cerr << "interrupted: "
                  << (written.empty() ? "nothing is written" : "only finished cases are written")
                  << (record && !written.empty() ? "; --resume continues\n" : "\n");
    }
    document["interrupted"] = interrupted;
    document["cases"] = std::move(written);
    finishProbes(probes, options, document);
    if (options.sweep.json) std::cout << textOf(document);
    return interrupted ? report::kInterrupted : report::kOk;
}

}  // namespace benchmarks::commands
