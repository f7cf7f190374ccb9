#include "benchmarks/commands/command_help.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace benchmarks::commands {

std::string typedName(const CommandHelp& command) {
    std::string name;
    for (const std::string& word : command.words) name += (name.empty() ? "" : " ") + word;
    return name;
}

std::vector<const CommandHelp*> withCommandsBelow(const CommandHelp& command) {
    std::vector<const CommandHelp*> all{&command};
    for (const CommandHelp& each : command.commands)
        std::ranges::copy(withCommandsBelow(each), std::back_inserter(all));
    return all;
}

ValueKind kindOf(const OptionHelp& option) {
    // These lists contain the names that the command line uses for paths.
    constexpr auto kFiles = std::to_array<std::string_view>(
        {"FILE", "A", "B", "CMD_OR_BUILD", "HEAD", "IN", "OUT", "PNG", "REPORT"});
    constexpr auto kFolders = std::to_array<std::string_view>({"DIR", "FOLDER"});
    std::string_view value = option.value;
    if (value.empty()) return ValueKind::none;
    if (!option.choices.empty()) return ValueKind::choice;
    if (value.ends_with("...")) value.remove_suffix(3);
    if (value == "SCENE") return ValueKind::scene;
    if (std::ranges::find(kFiles, value) != kFiles.end()) return ValueKind::file;
    if (std::ranges::find(kFolders, value) != kFolders.end()) return ValueKind::folder;
    return ValueKind::text;
}

}  // namespace benchmarks::commands
