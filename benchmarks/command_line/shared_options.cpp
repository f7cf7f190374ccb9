#include "benchmarks/command_line/command_line.h"

namespace benchmarks {

namespace {

// "2%" and "0.02" -> 0.02
std::string asShare(std::string& text) {
    if (!text.ends_with('%')) return {};
    text.pop_back();
    try {
        std::size_t used = 0;
        const double percent = std::stod(text, &used);
        if (used != text.size()) return "'" + text + "%' is no share";
        std::ostringstream share;
        share << percent / 100.0;
        text = share.str();
    } catch (const std::exception&) {
        return "'" + text + "%' is no share";
    }
    return {};
}

}  // namespace

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
        "run under the Vulkan validation layer; slow");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, "scene file (.json)")->required()->type_name("FILE");
    addRepeated(
        command, "-a,--axis", options.axes,
        "replaces or adds an axis of the sweep: /strands/density=16,32, /groom/guides=pow2:6:12")
        ->type_name("POINTER=V1,V2");
    addRepeated(
        command, "--set", options.sets, "sets a field of every case; it is not in their names")
        ->type_name("POINTER=VALUE");
    addDeviceOptions(command, options.device);
}

void addSamplingOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("--frames", options.frames, "frames of a round (/run/frames)");
    command.add_option("--warmup", options.warmup, "frames before each round (/run/warmup)");
    command
        .add_option(
            "--precision", options.precision,
            "rounds are played until the median is known this well (default 1%)")
        ->transform(CLI::Validator(asShare, "SHARE"));
    command.add_option(
        "--max-time", options.max_time, "s, for the rounds of a mode (default 10); 0: one round");
}

void addVerdictOptions(CLI::App& command, VerdictOptions& options) {
    command
        .add_option(
            "--threshold", options.threshold,
            "a change of this share matters to nobody (default 2%)")
        ->transform(CLI::Validator(asShare, "SHARE"))
        ->check(CLI::Range(0.0, 10.0));
    command
        .add_option(
            "--metrics", options.metrics,
            "judge the metrics whose name matches (default the times of frames and passes; on a "
            "software device their CPU time)")
        ->type_name("REGEX");
    command
        .add_option_function<std::string>(
            "--fail-on", [&options](const std::string&) { options.fail_on_inconclusive = true; },
            "inconclusive: exit with 11 where nothing is slower but not all is known")
        ->check(CLI::IsMember({"inconclusive"}));
}

}  // namespace benchmarks
