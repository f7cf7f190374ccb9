#pragma once

#include <optional>
#include <string>

namespace benchmarks {

// The text for something that may not be known: "-".
std::string numberText(std::optional<double> number);

// Explains the item before it to the mouse that rests on it.
void helpMarker(const char* help);

// Text at the right end of the room that is left in a line or cell.
void rightText(const std::string& text);

// Lines "what  figure", and where two sides are compared "what  A  B  B / A". Names that have no
// room in a line take two.
class FigureTable {
public:
    enum class Columns { one, compared };

    // Within the current window of Dear ImGui, until it leaves its scope. `title`: what all figures
    // are; empty: nothing is said.
    FigureTable(const char* id, Columns columns, const char* title = "");
    ~FigureTable();
    FigureTable(const FigureTable&) = delete;
    FigureTable& operator=(const FigureTable&) = delete;

    void
    row(const char* name, const char* help, std::optional<double> a,
        std::optional<double> b = std::nullopt);
    void row(const char* name, const char* help, const std::string& a, const std::string& b = {});

private:
    Columns columns_;
    bool open_ = false;
};

}  // namespace benchmarks
