#pragma once

struct ImGuiStyle;

namespace benchmarks {

enum class Theme { dark, light };

const char* themeName(Theme theme);

// Colours and sizes of widgets, for letters that are `scale` times as large as usual.
ImGuiStyle styleOf(Theme theme, float scale);

}  // namespace benchmarks
