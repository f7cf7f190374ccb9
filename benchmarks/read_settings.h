#pragma once

#include <array>
#include <string_view>

#include "benchmarks/json_fwd.h"
#include "hair/settings.h"

namespace benchmarks {

// Members of a scene file that are not settings but the scene reader's.
inline constexpr std::array<std::string_view, 3> kSceneKeys{"$schema", "base", "sweep"};

// The settings that a scene's document describes; an absent member keeps its default, and
// kSceneKeys are passed over. What the tables of hair/settings.h do not allow is an engine::Error
// "<JSON pointer>: <reason>": an unknown key or name, another type, a number out of range, not
// whole or not finite, a list too long. Members are checked one by one: check_settings.h has the
// rules between them.
hair::Settings readSettings(const Json& document);

}  // namespace benchmarks
