#pragma once

#include "benchmarks/json_fwd.h"
#include "hair/settings.h"

namespace hair {
class SettingsView;
}

namespace benchmarks {

// Every field, resolved: the inverse of readSettings. A float is written as the shortest decimal
// that reads back bit-equal.
Json writeSettings(const hair::Settings& settings);

// The same for a part of the settings.
Json writeFields(hair::SettingsView settings);

// The members of settings that are not the defaults, in the table's order: what a scene has to say.
// A list is there whole where anything in it differs, its elements without what is as in a new one.
// Floats are compared by their bits.
Json changedFields(const hair::Settings& settings);

// Without a fraction if it has none, so that 64 stays 64 and a name or a schema reads well.
Json cleanNumber(double value);

}  // namespace benchmarks
