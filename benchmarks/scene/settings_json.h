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

// The place of an object that a field or an element of a list is set to.
enum class Objects {
    merged,  // into the members that are there (RFC 7386): null gives a member its default
    replaced,  // as in a file: absent members have their defaults, and parameters may be new
};

// Sets the field that a JSON pointer names, an element of a list, a component of a vector or a
// parameter of a file. Throws engine::Error "<JSON pointer>: <reason>" if the pointer names
// nothing, and like readSettings() for the value; other fields stay unchanged.
void setField(
    hair::Settings& settings, const std::string& pointer, const Json& value,
    Objects objects = Objects::merged);

// Returns the value that setField() would set, as writeSettings() writes it. Throws engine::Error
// if the pointer names nothing.
Json valueAt(const hair::Settings& settings, const std::string& pointer);

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
