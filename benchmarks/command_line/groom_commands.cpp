#include "benchmarks/command_line/command_line.h"

namespace benchmarks {

namespace {

constexpr const char* kConvertNotes = R"(Done in this order: scale, followers, vertices, guides.
Without --scale lengths stay as they are, but that .hgl is always in metres: what IN states of its
unit is applied. .hgl gets root triangles if IN has none. What a format can't hold is said on
stderr. OUT may be IN; it is replaced when all is written, and an interrupt leaves it alone.)";

}  // namespace

void addGroomCommands(const CommandLine& line) {
    CLI::App* const groom = line.app.add_subcommand("groom", "inspects and converts files of hair");
    groom->require_subcommand(1);
    addCommand<GroomInfoOptions>(
        line, *groom, "info", "says what is in a file of hair and what is odd about it",
        inspectGroom, [](CLI::App& command, GroomInfoOptions& options) {
            command.add_option("file", options.file, "file of hair")->required()->type_name("FILE");
            command
                .add_option("--mesh", options.mesh, "what the hair grows on: are the roots on it?")
                ->type_name("FILE");
            command
                .add_option(
                    "--scale", options.scale,
                    "metres in the file's unit (default stated or guessed)")
                ->check(CLI::PositiveNumber);
            command.add_flag("--json", options.json, "as JSON");
        });
    addCommand<GroomConvertOptions>(
        line, *groom, "convert",
        "rewrites a file of hair: .hair .hgl .tfx .obj .ply .gltf .glb .usda", convertGroom,
        [](CLI::App& command, GroomConvertOptions& options) {
            command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
            command.add_option("out", options.out, "file to write")->required()->type_name("OUT");
            command
                .add_option(
                    "--scale", options.scale,
                    "metres in IN's unit (0.01: centimetres); OUT is in metres")
                ->check(CLI::PositiveNumber);
            command.add_option(
                "--followers", options.followers,
                "so many copies round each strand, as TressFX makes them");
            command
                .add_option(
                    "--follower-radius", options.follower_radius,
                    "radius of the disc that they are in, in IN's unit")
                ->check(CLI::NonNegativeNumber);
            command
                .add_option(
                    "--tip-separation", options.tip_separation,
                    "factor of their displacement at the tip (default 1)")
                ->check(CLI::NonNegativeNumber);
            command.add_option(
                "--vertices", options.vertices,
                "points per strand, even by arc length (2 to 65536)");
            command
                .add_option(
                    "--guides", options.guides,
                    "keep so many strands, spread over roots and shapes")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--mesh", options.mesh,
                    "what the hair grows on, in metres: for the root triangles of OUT.hgl")
                ->type_name("FILE");
            command.add_option(
                "--seed", options.seed, "of followers and of the choice of guides (default 1)");
            command.footer(kConvertNotes);
        });
}

}  // namespace benchmarks
