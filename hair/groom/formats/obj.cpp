#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/error.h"
#include "hair/groom/formats/polylines.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- Writing ------------------------------------------------------------------------------------

void addVector(TextWriter& text, const glm::vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) text.addNumber(vector[axis]);
}

// ---- Reading ------------------------------------------------------------------------------------

constexpr std::size_t kMaximumVertices = std::numeric_limits<std::uint32_t>::max();
constexpr glm::vec3 kWhite{1.0f};

class ObjReader {
public:
    // Takes a statement, continuation lines included.
    void read(std::string_view statement) {
        std::string_view rest = statement;
        const std::string_view keyword = takeWord(rest);
        if (keyword == "v") {
            readVertex(rest);
        } else if (keyword == "l") {
            readLine(rest);
        } else if (keyword == "f" || keyword == "fo") {
            ++faces_;
        } else if (keyword == "p") {
            ++loose_points_;
        } else if (keyword == "o" || keyword == "g") {
            last_is_segment_ = false;
        }
    }

    // Ends the reading; `line` is the last of the file.
    StrandSet finish(std::size_t line) {
        if (greatest_.index >= set_.points.size() && !lines_.ends.empty()) {
            throw engine::Error(
                "line " + std::to_string(greatest_.line),
                "vertex " + std::to_string(greatest_.index + 1) + " is named, but there are " +
                    std::to_string(set_.points.size()));
        }
        if (lines_.ends.empty()) {
            throw engine::Error(
                "line " + std::to_string(line),
                "the file has no strands: expected line elements, such as 'l 1 2 3'");
        }
        completeColors();
        warn(faces_, "faces are left out");
        warn(loose_points_, "point elements are left out");
        if (has_other_indices_) {
            set_.warnings.push_back("the texture coordinates of lines are left out");
        }
        arrangePoints(set_, std::move(lines_));
        return std::move(set_);
    }

    void setLine(std::size_t line) { line_ = line; }
    void setComment(std::string comment) { set_.comment = std::move(comment); }

private:
    struct Index {
        std::size_t index = 0;
        std::size_t line = 0;
    };

    [[noreturn]] void fail(const std::string& reason) const {
        throw engine::Error("line " + std::to_string(line_), reason);
    }

    void warn(std::size_t count, const char* what) {
        if (count > 0) set_.warnings.push_back(std::to_string(count) + ' ' + what);
    }

    void readVertex(std::string_view rest) {
        std::array<float, 6> numbers{};
        std::size_t count = 0;
        for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
            const auto number = floatFrom(word);
            if (!number) fail(inQuotes(word) + " is not a number");
            if (count < numbers.size()) numbers[count] = *number;
            ++count;
        }
        if (count != 3 && count != 4 && count != 6) {
            fail(
                "a vertex of " + std::to_string(count) +
                " numbers, expected x y z, perhaps with a weight or with red green blue");
        }
        if (set_.points.size() == kMaximumVertices) fail("at most 2^32 - 1 vertices are expected");
        set_.points.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (count < 6) return;
        set_.colors.values.resize(set_.points.size() - 1, kWhite);  // for earlier vertices without
        set_.colors.values.emplace_back(numbers[3], numbers[4], numbers[5]);
        ++colored_;
    }

    // "7", "-1", or "7/3" with a texture coordinate.
    std::uint32_t readIndex(std::string_view word) {
        const std::size_t slash = word.find('/');
        if (slash != std::string_view::npos) has_other_indices_ = true;
        const auto number = integerFrom(word.substr(0, slash));
        if (!number) fail(inQuotes(word) + " is not the index of a vertex");
        const auto vertices = static_cast<std::int64_t>(set_.points.size());
        const std::int64_t index = *number > 0 ? *number - 1 : *number + vertices;
        if (*number == 0 || index < 0 || index >= static_cast<std::int64_t>(kMaximumVertices)) {
            fail(
                "vertex " + std::to_string(*number) + " is named, but there are " +
                std::to_string(vertices));
        }
        // Vertices may follow, so only the end of the file shows whether the index is valid.
        if (static_cast<std::size_t>(index) > greatest_.index || greatest_.line == 0) {
            greatest_ = {static_cast<std::size_t>(index), line_};
        }
        return static_cast<std::uint32_t>(index);
    }

    void readLine(std::string_view rest) {
        const std::size_t start = lines_.vertices.size();
        for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
            if (!hasRoomFor(lines_, 1)) fail("the strands have 2^32 points, or more");
            lines_.vertices.push_back(readIndex(word));
        }
        const std::size_t size = lines_.vertices.size() - start;
        if (size == 0) fail("a line of no vertices, expected 2 or more");
        const bool is_segment = size == 2;
        const bool continues =
            is_segment && last_is_segment_ && lines_.vertices[start] == lines_.vertices[start - 1];
        if (continues) {
            lines_.vertices.erase(lines_.vertices.end() - 2);
            lines_.ends.pop_back();
        }
        lines_.ends.push_back(static_cast<std::uint32_t>(lines_.vertices.size()));
        last_is_segment_ = is_segment;
    }

    void completeColors() {
        if (colored_ == 0 || colored_ == set_.points.size()) return;
        set_.warnings.push_back(
            std::to_string(set_.points.size() - colored_) +
            " vertices have no colour and become white");
        set_.colors.values.resize(set_.points.size(), kWhite);
    }

    StrandSet set_;
    Polylines lines_;
    std::size_t line_ = 0;
    std::size_t faces_ = 0;
    std::size_t loose_points_ = 0;
    std::size_t colored_ = 0;
    Index greatest_;  // greatest vertex that a line names
    bool has_other_indices_ = false;
    bool last_is_segment_ = false;  // the last element was of two points, in this group
};

std::string takeComment(TextLines& lines) {
    std::string comment;
    for (TextLines next = lines; !next.atEnd(); lines = next) {
        std::string_view line = next.take();
        if (!line.starts_with('#')) break;
        line.remove_prefix(line.starts_with("# ") ? 2 : 1);
        comment.append(next.number() > 1 ? "\n" : "").append(line);
    }
    return comment;
}

std::string_view withoutComment(std::string_view statement) {
    return statement.substr(0, statement.find('#'));
}

bool isContinued(std::string_view line) { return line.ends_with('\\'); }

// Joins lines that end with a backslash to the next; `line` is the first.
std::string joinContinued(std::string_view line, TextLines& lines) {
    std::string joined;
    while (isContinued(line) && !lines.atEnd()) {
        joined.append(line.substr(0, line.size() - 1)).append(" ");
        line = lines.take();
    }
    return joined.append(line);
}

}  // namespace

std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings = leftOut(strands, {Part::colors, Part::comment});
    if (greatestSize(strands) < 2) {
        throw engine::Error("no strand has the two points that a line needs");
    }
    TextWriter text(out);
    text.add(commentLines(strands.comment, "# "));
    for (std::size_t i = 0; i < strands.points.size(); ++i) {
        text.add("v");
        addVector(text, strands.points[i]);
        if (strands.colors.known()) addVector(text, strands.colors.at(i));
        text.add("\n");
    }
    std::uint32_t first = 0;
    std::size_t single = 0;
    for (const std::uint32_t end : strands.ends) {
        if (end - first == 1) {
            ++single;
        } else {
            text.add("l");
            for (std::uint64_t i = first; i < end; ++i) text.addNumber(i + 1);
            text.add("\n");
        }
        first = end;
    }
    text.flush();
    if (single > 0) {
        warnings.push_back(
            std::to_string(single) +
            " strands of a single point are written as points, not as lines");
    }
    return warnings;
}

StrandSet importObj(const StrandFile& file) {
    TextLines lines({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    ObjReader reader;
    reader.setComment(takeComment(lines));
    while (!lines.atEnd()) {
        const std::string_view line = lines.take();
        if (line.starts_with('#')) continue;
        reader.setLine(lines.number());
        if (isContinued(line)) {
            reader.read(withoutComment(joinContinued(line, lines)));
        } else {
            reader.read(withoutComment(line));
        }
    }
    return reader.finish(std::max<std::size_t>(lines.number(), 1));
}

}  // namespace hair::groom
