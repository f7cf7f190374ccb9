#pragma once

#include "hair/settings.h"

namespace benchmarks {

// Where /groom/guides comes from: its default, or someone wrote it.
enum class GuideCount { by_default, written };

// The rules between fields, which no table row can say, such as a near plane in front of the far
// plane. A broken one is an engine::Error "<JSON pointer>: <reason>".
void checkSettings(const hair::Settings& settings, GuideCount guide_count);

}  // namespace benchmarks
