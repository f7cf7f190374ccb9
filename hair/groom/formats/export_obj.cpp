#include "hair/groom/formats/export_obj.h"

#include <charconv>

#include "engine/error.h"
#include "hair/groom/formats/comment_lines.h"
#include "hair/groom/formats/left_out.h"

namespace hair {
namespace {

// Writes to the stream by large blocks.
class Text {
public:
    explicit Text(std::ostream& out) : out_(out) { text_.reserve(kBlock + kLongestNumber); }

    void add(std::string_view text) {
        text_ += text;
        if (text_.size() > kBlock) flush();
    }

    // In the shortest decimals that are the same number.
    template <class Number>
    void addNumber(Number number) {
        char digits[kLongestNumber];
        digits[0] = ' ';
        const char* end = std::to_chars(digits + 1, digits + kLongestNumber, number).ptr;
        add({digits, end});
    }

    void flush() {
        out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
        text_.clear();
    }

private:
    static constexpr std::size_t kBlock = 1 << 16;
    static constexpr std::size_t kLongestNumber = 32;

    std::ostream& out_;
    std::string text_;
};

void addVector(Text& text, const glm::vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) text.addNumber(vector[axis]);
}

}  // namespace

std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings = leftOut(strands, {Part::colors, Part::comment});
    if (greatestSize(strands) < 2) {
        throw engine::Error("no strand has two points, which a line is between");
    }
    Text text(out);
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
            " strands of a single point are left out, only the points stay");
    }
    return warnings;
}

}  // namespace hair
