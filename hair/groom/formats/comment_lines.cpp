#include "hair/groom/formats/comment_lines.h"

namespace hair {

std::string commentLines(std::string_view comment, std::string_view keyword) {
    if (comment.empty()) return {};
    std::string lines(keyword);
    for (const char c : comment) {
        if (c == '\r') continue;
        lines += c;
        if (c == '\n') lines += keyword;
    }
    return lines + '\n';
}

}  // namespace hair
