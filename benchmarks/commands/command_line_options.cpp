#include "benchmarks/commands/command_line_options.h"

#include <chrono>
#include <cstddef>
#include <exception>
#include <sstream>

#include "benchmarks/scene/extensions.h"

namespace benchmarks::commands {
namespace {

std::string whyNotFinite(std::string& text) {
    return text.find_first_of("nN") == std::string::npos ? "" : "'" + text + "' is not finite";
}

}  // namespace

CLI::App* addPlainCommand(const CommandLine& line, CLI::App& parent, const CommandText& text) {
    CLI::App* const command = parent.add_subcommand(text.name, text.description);
    std::string footer = text.notes;
    if (!footer.empty()) footer += '\n';
    footer += text.examples.size() == 1 ? "Example:" : "Examples:";
    for (const std::string& example : text.examples) footer += "\n  " + example;
    command->footer(footer);
    line.texts[command] = text;
    return command;
}

void refuseWhatIsNotFinite(CLI::App& command) {
    for (CLI::Option* const option : command.get_options({}))
        if (option->get_type_name().starts_with("FLOAT"))
            option->check(CLI::Validator(whyNotFinite, ""));
}

void addCommand(const CommandLine& line, CLI::App& parent, const CommandText& text, int (*run)()) {
    addPlainCommand(line, parent, text)->callback([&chosen = line.chosen, run] { chosen = run; });
}

// ---- Options that several commands have ---------------------------------------------------------

std::string asShare(std::string& text) {
    if (!text.ends_with('%')) return {};
    text.pop_back();
    try {
        std::size_t used = 0;
        const double percent = std::stod(text, &used);
        if (used != text.size())
            return "'" + text + "%' is not a percentage: expected a number before '%', as in 3%";
        std::ostringstream share;
        share << percent / 100.0;
        text = share.str();
    } catch (const std::exception&) {
        return "'" + text + "%' is not a percentage: expected a number before '%', as in 3%";
    }
    return {};
}

CLI::Option* addRepeated(
    CLI::App& command, const std::string& name, std::vector<std::string>& values,
    const std::string& description) {
    return command.add_option(name, values, description)
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
}

void addDeviceOptions(CLI::App& command, engine::DeviceOptions& options) {
    command.add_option(
        "--device", options.wanted,
        "index or part of the name of the device (see 'hairbench devices')");
    command.add_flag_callback(
        "--validate", [&options] { options.validation = engine::Validation::on; },
        "run under the Vulkan validation layer and look for missing barriers; slow");
    command
        .add_option_function<double>(
            "--device-timeout",
            [&options](double seconds) {
                options.patience = std::chrono::duration<double>(seconds);
            },
            "time without an answer after which the device counts as lost (default 600, for a "
            "software device 3600)")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber);
}

void addCacheOption(CLI::App& command, scene::SceneOptions& options) {
    command.add_flag_callback(
        "--no-cache", [&options] { options.cache = false; },
        "bake distance fields and settle hair anew, and keep neither on disk");
}

void addOutsideOption(CLI::App& command, scene::Outside& outside) {
    command.add_flag_callback(
        "--allow-outside", [&outside] { outside = scene::Outside::allowed; },
        "let scenes name files outside their folder");
}

void addSceneOptions(CLI::App& command, scene::SceneOptions& options) {
    addScene(command, "scene", options.scene, "scene file (.json), or the name of a shipped scene")
        ->type_name("SCENE");
    addRepeated(
        command, "-a,--axis", options.axes,
        "replaces or adds an axis of the sweep: /strands/density=16,32, /groom/guides=pow2:6:12")
        ->type_name("POINTER=V1,V2");
    addRepeated(
        command, "--set", options.sets,
        "sets a field of every case; the cases' names don't show it")
        ->type_name("POINTER=VALUE");
    addDeviceOptions(command, options.device);
    addCacheOption(command, options);
    addOutsideOption(command, options.outside);
}

void addSamplingOptions(CLI::App& command, scene::SceneOptions& options) {
    command.add_option("--frames", options.frames, "frames of a round (/run/frames)");
    command.add_option(
        "--warmup", options.warmup, "warm-up frames before each round (/run/warmup)");
    command
        .add_option(
            "--precision", options.precision,
            "end rounds once half the width of the median's confidence interval is this share of "
            "the median (default 1%)")
        ->transform(CLI::Validator(asShare, "SHARE"));
    command.add_option(
        "--max-time", options.max_time,
        "seconds for the rounds of each mode (default 10); 0: one round");
}

void addVerdictOptions(CLI::App& command, report::VerdictOptions& options) {
    command
        .add_option(
            "--threshold,--margin", options.threshold,
            "largest change that counts as none (default 2%)")
        ->transform(CLI::Validator(asShare, "SHARE"))
        ->check(CLI::Range(0.0, 10.0));
    command
        .add_option(
            "--metrics", options.metrics,
            "judge the metrics whose name matches (default: the times of frames and passes; on a "
            "software device, their CPU time)")
        ->type_name("REGEX");
}

void addFailOnInconclusive(CLI::App& command, report::VerdictOptions& options) {
    command
        .add_option_function<std::string>(
            "--fail-on",
            [&options](const std::string& what) {
                options.fail_on_inconclusive = what == "inconclusive";
                options.pass_without_verdicts = what == "regressed";
            },
            "inconclusive: exit with status 11 if nothing is slower but a metric is inconclusive; "
            "regressed: exit with status 0 in that case, even if a gate had no time for a verdict")
        ->check(CLI::IsMember({"inconclusive", "regressed"}));
}

}  // namespace benchmarks::commands
