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

// Members of a scene file that are not settings but the scene reader's.
inline constexpr std::array<std::string_view, 3> kSceneKeys{"$schema", "base", "sweep"};

// The settings that a scene's document describes; an absent member keeps its default, and
// kSceneKeys are passed over. What the tables of hair/settings.h do not allow is an engine::Error
// "<JSON pointer>: <reason>": an unknown key or name, another type, a number out of range, not
// whole or not finite, a list too long. Members are checked one by one: schema.h has the
// rules between them.
hair::Settings readSettings(const Json& document);

// Every field, resolved: the inverse of readSettings. A float is written as the shortest decimal
// that reads back bit-equal.
Json writeSettings(const hair::Settings& settings);

// Writes a part of the settings, as writeSettings() does the whole.
Json writeFields(hair::SettingsView settings);

// The members of settings that are not the defaults, in the table's order: what a scene has to say.
// A list is there whole where anything in it differs, its elements without what is as in a new one.
// Floats are compared by their bits.
Json changedFields(const hair::Settings& settings);

// Throws engine::Error "<JSON pointer>: 0 is outside [1, 4096] count" for a number that is.
void checkInRange(const std::string& pointer, double number, const hair::Range& range);

// Without a fraction if it has none, so that 64 stays 64 and a name or a schema reads well.
Json cleanNumber(double value);

}  // namespace benchmarks::scene
