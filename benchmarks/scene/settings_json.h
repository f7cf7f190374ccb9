#pragma once

#include <array>
#include <string>
#include <string_view>

#include "benchmarks/scene/json.h"
#include "hair/settings.h"

namespace hair {
class SettingsView;
struct Range;
}  // namespace hair

// Settings as JSON, by the tables of hair/settings.h.
namespace benchmarks::scene {

// Members of a scene file that the scene reader uses itself; they are not settings.
inline constexpr std::array<std::string_view, 3> kSceneKeys{"$schema", "base", "sweep"};

// Reads the settings from a scene's document. An absent member keeps its default, and kSceneKeys
// are skipped. Throws engine::Error "<JSON pointer>: <reason>" for anything that the tables of
// hair/settings.h do not allow: an unknown key or name, a wrong type, a number out of range, not
// whole or not finite, a list too long. Checks members one by one; schema.h has the rules between
// them.
hair::Settings readSettings(const Json& document);

// Returns every field, resolved: the inverse of readSettings(). Writes a float as the shortest
// decimal that reads back bit-equal.
Json writeSettings(const hair::Settings& settings);

// Returns the document's own members as reports echo them: writeSettings() of readSettings()
// without the other members.
Json echoedMembers(const Json& document);

// Writes a part of the settings, like writeSettings() for all of them.
Json writeFields(hair::SettingsView settings);

// Returns the members of the settings that differ from the defaults, in the table's order: the
// members that a scene has to contain. A list with any difference is written as a whole, but its
// elements leave out whatever equals a new element. Floats are compared by their bits.
Json changedFields(const hair::Settings& settings);

// Throws engine::Error "<JSON pointer>: 0 is outside [1, 4096] count" for a number out of range.
void checkInRange(const std::string& pointer, double number, const hair::Range& range);

// Returns an integer if the number has no fraction, so that 64 stays 64 in names and schemas.
Json cleanNumber(double value);

}  // namespace benchmarks::scene
