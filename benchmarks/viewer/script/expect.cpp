#include <regex>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/pointer.h"
#include "benchmarks/viewer/script/layout_faults.h"
#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/place.h"
#include "benchmarks/viewer/script/verbs.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"
#include "engine/read_file.h"

// Steps that fail where what they say does not hold.
namespace benchmarks {

namespace {

// What one member of "expect" says. `side` is what it says it of.
using Check = std::function<void(const Driver&, const Side& side)>;

struct Expectation {
    const char* name;
    Check (*read)(const Json& value, const std::string& pointer, const ScriptFolders& folders);
};

[[noreturn]] void fail(const std::string& text) { throw engine::Error(text); }

void checkTrue(const Json& value, const std::string& pointer) {
    if (!flagOf(value, pointer)) throw engine::Error(pointer, "must be true");
}

Check readHash(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::string wanted = textOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::string hash = side.player().played().pictureHash();
        if (hash != wanted) fail("the picture's hash is " + hash + ", not " + wanted);
    };
}

// Of the first side in a file that "state" wrote.
std::string hashIn(const std::filesystem::path& file) {
    const Json state = parseJson(engine::readFile(file), file.string());
    const Json::json_pointer place("/sides/0/image_hash");
    if (!state.contains(place)) throw engine::Error(file.string(), "has no /sides/0/image_hash");
    return state.at(place).get<std::string>();
}

Check readSameHash(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / textOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::string hash = side.player().played().pictureHash(), other = hashIn(file);
        if (hash != other)
            fail("the picture's hash is " + hash + ", and " + file.string() + " has " + other);
    };
}

Check readOtherHash(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / textOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        if (side.player().played().pictureHash() == hashIn(file))
            fail("the picture is the same as in " + file.string());
    };
}

Check readFrame(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t wanted = countOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::uint32_t frame = side.player().frame();
        if (frame != wanted)
            fail("it is frame " + std::to_string(frame) + ", not " + std::to_string(wanted));
    };
}

Check readSetting(const Json& value, const std::string& pointer, const ScriptFolders&) {
    if (!value.is_object())
        throw engine::Error(pointer, "must be an object, as in {\"/strands/density\": 16}");
    return [=](const Driver&, const Side& side) {
        Json document = writeSettings(side.player().settings());
        for (const auto& [field, wanted] : value.items()) {
            const Json& is = valueAt(document, field);
            if (is != wanted) fail(field + " is " + is.dump() + ", not " + wanted.dump());
        }
    };
}

Check readNoProblem(const Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver&, const Side& side) {
        if (!side.problem().empty()) fail("there is a problem: " + side.problem());
    };
}

std::regex regexOf(const Json& value, const std::string& pointer) {
    try {
        return std::regex(textOf(value, pointer));
    } catch (const std::regex_error&) {
        throw engine::Error(pointer, "is no regular expression");
    }
}

void checkText(const char* what, const std::string& text, const std::regex& wanted) {
    if (!std::regex_search(text, wanted))
        fail(std::string(what) + " is \"" + text + "\", which does not match");
}

Check readProblem(const Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = regexOf(value, pointer)](const Driver&, const Side& side) {
        checkText("the problem", side.problem(), wanted);
    };
}

Check readMessage(const Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = regexOf(value, pointer)](const Driver& driver, const Side&) {
        checkText("the message", driver.viewer.message(), wanted);
    };
}

Check readClipboard(const Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = regexOf(value, pointer)](const Driver&, const Side&) {
        const char* const text = ImGui::GetClipboardText();
        checkText("the clipboard", text ? text : "", wanted);
    };
}

Check readSides(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t wanted = countOf(value, pointer);
    return [=](const Driver& driver, const Side&) {
        if (driver.viewer.sideCount() != wanted)
            fail("the window shows " + std::to_string(driver.viewer.sideCount()) + " sides");
    };
}

void checkFlag(const ItemName& name, const char* what, bool is, std::optional<bool> wanted) {
    if (wanted && is != *wanted) fail(described(name) + (is ? " is " : " is not ") + what);
}

Check readItem(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Json object = value.is_string() ? Json{{"item", value}} : value;
    const Members members(
        object, pointer, {"item", "window", "seen", "enabled", "checked", "open"});
    const auto name = itemOf(members);
    if (!name) throw engine::Error(pointer, "needs an \"item\" or a \"window\"");
    const auto seen = members.flag("seen"), enabled = members.flag("enabled"),
               checked = members.flag("checked"), open = members.flag("open");
    return [=](const Driver& driver, const Side&) {
        if (seen == false) {
            if (findItem(driver.items, *name)) fail(described(*name) + " is seen");
            return;
        }
        const engine::UiItem item = itemNamed(driver.items, *name);
        checkFlag(*name, "enabled", item.enabled, enabled);
        checkFlag(*name, "checked", item.checked, checked);
        checkFlag(*name, "open", item.open, open);
    };
}

// Of many, the first few say enough.
void checkNone(const std::vector<std::string>& faults) {
    constexpr std::size_t kMost = 5;
    if (faults.empty()) return;
    std::string text;
    for (std::size_t i = 0; i < std::min(faults.size(), kMost); ++i)
        text += (i > 0 ? "; " : "") + faults[i];
    if (faults.size() > kMost) text += "; and " + std::to_string(faults.size() - kMost) + " more";
    fail(text);
}

Check readNothingClipped(const Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver& driver, const Side&) { checkNone(clippedText(driver.items)); };
}

Check readNothingOutside(const Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver& driver, const Side&) { checkNone(outsideItems(driver.items)); };
}

constexpr Expectation kExpectations[] = {
    {"hash", readHash},
    {"same_hash_as", readSameHash},
    {"other_hash_than", readOtherHash},
    {"frame", readFrame},
    {"setting", readSetting},
    {"no_problem", readNoProblem},
    {"problem", readProblem},
    {"message", readMessage},
    {"clipboard", readClipboard},
    {"sides", readSides},
    {"item", readItem},
    {"nothing_clipped", readNothingClipped},
    {"nothing_outside", readNothingOutside},
};

}  // namespace

Act readExpect(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    std::vector<const char*> known{"side"};
    for (const Expectation& row : kExpectations) known.push_back(row.name);
    const Members members(value, pointer, known);
    const std::uint32_t side = members.count("side").value_or(0);
    std::vector<Check> checks;
    for (const Expectation& row : kExpectations)
        if (members.has(row.name))
            checks.push_back(row.read(members.at(row.name), members.pointerOf(row.name), folders));
    if (checks.empty()) throw engine::Error(pointer, "expects nothing");
    return [=](Driver& driver) {
        for (const Check& check : checks) check(driver, driver.side(side));
    };
}

}  // namespace benchmarks
