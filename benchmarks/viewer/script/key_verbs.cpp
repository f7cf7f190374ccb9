#include "benchmarks/viewer/script/key_names.h"
#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/verbs.h"

// Steps of the keyboard.
namespace benchmarks {

Act readKey(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const int chord = keyChord(textOf(value, pointer), pointer);
    return [=](Driver& driver) {
        driver.then([=, &driver] { driver.input.key(chord, UserInput::Change::press); });
        driver.then([=, &driver] { driver.input.key(chord, UserInput::Change::release); });
        driver.settle();
    };
}

Act readType(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::string text = textOf(value, pointer);
    return [=](Driver& driver) {
        driver.then([=, &driver] { driver.input.type(text); });
        driver.settle();
    };
}

}  // namespace benchmarks
