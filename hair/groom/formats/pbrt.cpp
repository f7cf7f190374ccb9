#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// The point at a share of the way, as a float.
glm::vec3 pointOnTheWay(const glm::vec3& from, const glm::vec3& to, double share) {
    return glm::vec3(glm::dvec3(from) + share * (glm::dvec3(to) - glm::dvec3(from)));
}

constexpr double kFirstThird = 1.0 / 3.0;
constexpr double kSecondThird = 2.0 / 3.0;

// ---- Writing ------------------------------------------------------------------------------------

void addPbrtPoint(TextWriter& text, const glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis) text.addNumber(point[axis]);
}

// Writes a shape with a straight segment between each two points.
void addPbrtShape(
    TextWriter& text, std::span<const glm::vec3> points, const std::optional<float>& width0,
    const std::optional<float>& width1) {
    text.add("Shape \"curve\" \"string type\" \"cylinder\"");
    if (width0 && width0 == width1) text.addNumber(*width0, " \"float width\" ");
    if (width0 && width0 != width1) {
        text.addNumber(*width0, " \"float width0\" ");
        text.addNumber(*width1, " \"float width1\" ");
    }
    text.add(" \"point3 P\" [");
    addPbrtPoint(text, points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
        text.add("\n   ");
        addPbrtPoint(text, pointOnTheWay(points[i - 1], points[i], kFirstThird));
        addPbrtPoint(text, pointOnTheWay(points[i - 1], points[i], kSecondThird));
        addPbrtPoint(text, points[i]);
    }
    text.add(" ]\n");
}

bool hasOneWidth(const StrandSet& strands, std::uint32_t strand) {
    if (strands.widths.values.empty()) return true;
    const auto own =
        std::span(strands.widths.values).subspan(strands.first(strand), strands.size(strand));
    return std::ranges::all_of(own, [&](float width) { return width == own.front(); });
}

void addPbrtStrand(TextWriter& text, const StrandSet& strands, std::uint32_t strand) {
    const auto points = strands.strand(strand);
    const std::size_t first = strands.first(strand);
    const auto width = [&](std::size_t point) {
        return strands.widths.known() ? std::optional(strands.widths.at(first + point))
                                      : std::nullopt;
    };
    if (hasOneWidth(strands, strand)) {
        addPbrtShape(text, points, width(0), width(0));
        return;
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        addPbrtShape(text, points.subspan(i, 2), width(i), width(i + 1));
}

// ---- Words --------------------------------------------------------------------------------------

enum class PbrtKind { end, directive, number, text, open, close };

struct PbrtWord {
    PbrtKind kind = PbrtKind::end;
    std::string_view text;  // without quotes
    std::size_t line = 0;
};

// Splits a scene into words, brackets and texts in quotes.
class PbrtWords {
public:
    explicit PbrtWords(std::string_view rest) : rest_(rest) { next(); }

    const PbrtWord& peek() const { return word_; }
    PbrtWord take() {
        const PbrtWord taken = word_;
        next();
        return taken;
    }

private:
    void next() {
        skip();
        word_ = {PbrtKind::end, {}, line_};
        if (rest_.empty()) return;
        const char c = rest_.front();
        if (c == '[' || c == ']') {
            word_ = {c == '[' ? PbrtKind::open : PbrtKind::close, rest_.substr(0, 1), line_};
            rest_.remove_prefix(1);
        } else if (c == '"') {
            const std::size_t end = rest_.find_first_of("\"\n", 1);
            if (end == rest_.npos || rest_[end] == '\n') failAtLine(line_, "a text has no end");
            word_ = {PbrtKind::text, rest_.substr(1, end - 1), line_};
            rest_.remove_prefix(end + 1);
        } else {
            const std::size_t end = std::min(rest_.find_first_of(" \t\r\n\"[]#"), rest_.size());
            const std::string_view word = rest_.substr(0, end);
            const bool is_value =
                word == "true" || word == "false" ||
                std::string_view("+-.0123456789").find(c) != std::string_view::npos ||
                doubleFrom(word).has_value();
            word_ = {is_value ? PbrtKind::number : PbrtKind::directive, word, line_};
            rest_.remove_prefix(end);
        }
    }

    void skip() {
        while (!rest_.empty()) {
            if (rest_.front() == '#') {
                rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
            } else if (std::string_view(" \t\r\n").find(rest_.front()) != std::string_view::npos) {
                line_ += rest_.front() == '\n' ? 1 : 0;
                rest_.remove_prefix(1);
            } else {
                return;
            }
        }
    }

    std::string_view rest_;
    std::size_t line_ = 1;
    PbrtWord word_;
};

// ---- Curves -------------------------------------------------------------------------------------

// Weights of a quadratic segment's three vertices, in the form of a cubic one.
constexpr CurveBasis kQuadraticBezier{
    {{1.0, -2.0, 1.0, 0.0}, {0.0, 2.0, -2.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {}}};
constexpr CurveBasis kQuadraticBspline{
    {{0.5, -1.0, 0.5, 0.0}, {0.5, 1.0, -1.0, 0.0}, {0.0, 0.0, 0.5, 0.0}, {}}};

struct PbrtBasis {
    std::string_view name;
    std::size_t degree;
    const CurveBasis* weights;
    std::size_t step;  // vertices from a segment to the next
};

constexpr std::array kPbrtBases{
    PbrtBasis{"bezier", 3, &kBezierBasis, 3}, PbrtBasis{"bezier", 2, &kQuadraticBezier, 2},
    PbrtBasis{"bspline", 3, &kBsplineBasis, 1}, PbrtBasis{"bspline", 2, &kQuadraticBspline, 1}};

struct PbrtCurve {
    std::size_t line = 0;
    std::vector<glm::vec3> vertices;
    std::string_view basis = "bezier";
    double degree = 3.0;
    std::optional<double> width, width0, width1;
};

class PbrtReader {
public:
    explicit PbrtReader(std::string_view text) : words_(text) { set_.comment = commentOf(text); }

    StrandSet read() {
        while (words_.peek().kind != PbrtKind::end) readDirective(words_.take());
        if (!placed_.empty()) failAtLine(words_.peek().line, "truncated: a block has no end");
        if (set_.ends.empty()) failAtLine(words_.peek().line, "the scene has no curves" + others());
        finishWidths();
        warnOfStrands(in_objects_, "in objects (ObjectBegin)", set_);
        if (included_ > 0)
            set_.warnings.push_back(
                std::to_string(included_) +
                " included files are left out: read each of them by itself");
        return std::move(set_);
    }

private:
    struct Block {
        AffineSpace space;
        std::size_t unknown_place;
        bool is_object;
        std::string_view end;
    };

    // The lines of comment at the beginning.
    static std::string commentOf(std::string_view text) {
        std::string comment;
        for (TextLines lines(text); !lines.atEnd();) {
            std::string_view line = lines.take();
            if (!line.starts_with('#')) break;
            line.remove_prefix(line.starts_with("# ") ? 2 : 1);
            comment.append(lines.number() > 1 ? "\n" : "").append(line);
        }
        return comment;
    }

    std::string others() const {
        if (in_objects_ > 0) return " outside objects (ObjectBegin), which are not read";
        if (included_ > 0) return ", but it includes other files: read each of them by itself";
        return "";
    }

    // ---- Directives ----

    void readDirective(const PbrtWord& word) {
        if (word.kind != PbrtKind::directive)
            failAtLine(
                word.line, inQuotes(word.text) + ": a directive, such as Shape, is expected");
        if (word.text == "Shape" && words_.peek().kind == PbrtKind::text &&
            words_.peek().text == "curve") {
            words_.take();
            readCurve(word.line);
            return;
        }
        follows_curve_ = false;
        if (readTransform(word) || readBlock(word)) return;
        if (word.text == "Include" || word.text == "Import") ++included_;
        skipArguments();
    }

    void skipArguments() {
        for (;;) {
            const PbrtKind kind = words_.peek().kind;
            if (kind == PbrtKind::open)
                skipList();
            else if (kind == PbrtKind::number || kind == PbrtKind::text)
                words_.take();
            else
                return;
        }
    }

    void skipList() {
        const PbrtWord open = words_.take();
        while (words_.peek().kind == PbrtKind::number || words_.peek().kind == PbrtKind::text)
            words_.take();
        if (words_.take().kind != PbrtKind::close) failAtLine(open.line, "a list has no end");
    }

    bool readBlock(const PbrtWord& word) {
        constexpr std::array<std::array<std::string_view, 2>, 3> kBlocks{
            {{"AttributeBegin", "AttributeEnd"},
             {"TransformBegin", "TransformEnd"},
             {"ObjectBegin", "ObjectEnd"}}};
        constexpr std::size_t kMostBlocks = 1000;
        for (const auto& [begin, end] : kBlocks) {
            if (word.text == begin) {
                if (placed_.size() == kMostBlocks)
                    failAtLine(word.line, "more than 1,000 blocks are nested");
                placed_.push_back({space_, unknown_place_, is_object_, end});
                is_object_ = is_object_ || begin == "ObjectBegin";
                skipArguments();  // an object's name
                return true;
            }
            if (word.text != end) continue;
            if (placed_.empty() || placed_.back().end != end)
                failAtLine(word.line, std::string(end) + " without " + std::string(begin));
            space_ = placed_.back().space;
            unknown_place_ = placed_.back().unknown_place;
            is_object_ = placed_.back().is_object;
            placed_.pop_back();
            return true;
        }
        return false;
    }

    bool readTransform(const PbrtWord& word) {
        const std::string_view name = word.text;
        AffineSpace inner;
        if (name == "Identity" || name == "WorldBegin") {
            space_ = {};
            unknown_place_ = 0;
            return true;
        }
        if (name == "LookAt" || name == "CoordSysTransform") {
            unknown_place_ = word.line;
            skipArguments();
            return true;
        }
        if (name == "Translate") {
            inner.translation = vectorOf(numbers<3>(word), 0);
        } else if (name == "Scale") {
            const auto factors = numbers<3>(word);
            for (int axis = 0; axis < 3; ++axis)
                inner.linear[axis][axis] = factors[static_cast<std::size_t>(axis)];
        } else if (name == "Rotate") {
            inner.linear = rotation(word);
        } else if (name == "Transform" || name == "ConcatTransform") {
            // The translation is last, so columns of the matrix are one after another.
            const auto matrix = numbers<16>(word);
            if (matrix[3] != 0.0 || matrix[7] != 0.0 || matrix[11] != 0.0 || matrix[15] != 1.0)
                failAtLine(word.line, "a projection");
            for (int column = 0; column < 3; ++column)
                inner.linear[column] = vectorOf(matrix, 4 * static_cast<std::size_t>(column));
            inner.translation = vectorOf(matrix, 12);
            if (name == "Transform") {
                space_ = {};
                unknown_place_ = 0;
            }
        } else {
            return false;
        }
        space_ = space_.of(inner);
        return true;
    }

    template <std::size_t size>
    static glm::dvec3 vectorOf(const std::array<double, size>& numbers, std::size_t first) {
        return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }

    // Takes `size` finite numbers, perhaps in brackets.
    template <std::size_t size>
    std::array<double, size> numbers(const PbrtWord& directive) {
        std::array<double, size> all{};
        const bool is_list = words_.peek().kind == PbrtKind::open;
        if (is_list) words_.take();
        for (double& number : all) {
            const PbrtWord word = words_.take();
            const auto value = word.kind == PbrtKind::number ? doubleFrom(word.text) : std::nullopt;
            if (!value || !std::isfinite(*value))
                failAtLine(
                    directive.line, std::string(directive.text) + " needs " + std::to_string(size) +
                                        " finite numbers");
            number = *value;
        }
        if (is_list && words_.take().kind != PbrtKind::close)
            failAtLine(directive.line, "a list has no end");
        return all;
    }

    glm::dmat3 rotation(const PbrtWord& word) {
        const auto all = numbers<4>(word);
        const glm::dvec3 axis = vectorOf(all, 1);
        const double length = glm::length(axis);
        if (!(length > 0.0) || std::isinf(length))
            failAtLine(word.line, "a rotation about no axis");
        const glm::dvec3 n = axis / length;
        const double angle = all[0] * (std::numbers::pi / 180.0);
        // Rodrigues: I cos + (1 - cos) n nT + sin [n]x; [column][row].
        glm::dmat3 linear;
        for (int column = 0; column < 3; ++column) {
            glm::dvec3 unit(0.0);
            unit[column] = 1.0;
            linear[column] = std::cos(angle) * unit + (1.0 - std::cos(angle)) * n[column] * n +
                             std::sin(angle) * glm::cross(n, unit);
        }
        return linear;
    }

    // ---- Parameters of a curve ----

    void readCurve(std::size_t line) {
        PbrtCurve curve{.line = line};
        while (words_.peek().kind == PbrtKind::text) readParameter(curve);
        const std::size_t degree = curve.degree == 2.0 ? 2 : curve.degree == 3.0 ? 3 : 0;
        const auto basis = std::ranges::find_if(kPbrtBases, [&](const PbrtBasis& row) {
            return row.name == curve.basis && row.degree == degree;
        });
        if (basis == kPbrtBases.end())
            failAtLine(
                line, "a curve of the basis " + inQuotes(curve.basis) + " and the degree " +
                          std::to_string(curve.degree).substr(0, 4) +
                          ", expected bezier or bspline of degree 2 or 3");
        const std::size_t size = curve.vertices.size();
        if (size < degree + 1 || (size - degree - 1) % basis->step != 0)
            failAtLine(
                line, std::to_string(size) + " vertices, which do not make a " +
                          std::string(basis->name) + " curve of degree " + std::to_string(degree));
        if (unknown_place_ > 0)
            failAtLine(
                line, "the curve is placed by the LookAt or CoordSysTransform of line " +
                          std::to_string(unknown_place_) + ", which is not read");
        if (is_object_) {
            ++in_objects_;
            return;
        }
        addCurve(curve, *basis);
    }

    void readParameter(PbrtCurve& curve) {
        const PbrtWord declaration = words_.take();
        std::string_view rest = declaration.text;
        const std::string_view type = takeWord(rest);
        const std::string_view name = takeWord(rest);
        if (name.empty())
            failAtLine(
                declaration.line,
                inQuotes(declaration.text) + " is not the type and the name of a parameter");
        if (name == "P" && (type == "point3" || type == "point")) {
            readVertices(curve);
        } else if (name == "width") {
            curve.width = number(declaration);
        } else if (name == "width0") {
            curve.width0 = number(declaration);
        } else if (name == "width1") {
            curve.width1 = number(declaration);
        } else if (name == "degree") {
            curve.degree = number(declaration);
        } else if (name == "basis") {
            const bool is_list = words_.peek().kind == PbrtKind::open;
            if (is_list) words_.take();
            curve.basis = words_.take().text;
            if (is_list && words_.take().kind != PbrtKind::close)
                failAtLine(declaration.line, "one basis is expected");
        } else if (words_.peek().kind == PbrtKind::open) {
            skipList();
        } else {
            const PbrtKind kind = words_.take().kind;
            if (kind != PbrtKind::number && kind != PbrtKind::text)
                failAtLine(declaration.line, inQuotes(declaration.text) + " has no value");
        }
    }

    // A number that may not be finite.
    double number(const PbrtWord& declaration) {
        const bool is_list = words_.peek().kind == PbrtKind::open;
        if (is_list) words_.take();
        const auto value = doubleFrom(words_.take().text);
        if (!value || (is_list && words_.take().kind != PbrtKind::close))
            failAtLine(declaration.line, inQuotes(declaration.text) + ": one number is expected");
        return *value;
    }

    void readVertices(PbrtCurve& curve) {
        const PbrtWord open = words_.take();
        if (open.kind != PbrtKind::open)
            failAtLine(open.line, "the vertices P are not a list in brackets");
        std::array<float, 3> point{};
        std::size_t count = 0;
        while (words_.peek().kind == PbrtKind::number) {
            const PbrtWord word = words_.take();
            const auto value = floatFrom(word.text);
            if (!value) failAtLine(word.line, inQuotes(word.text) + " is not a number");
            point[count % 3] = *value;
            if (++count % 3 == 0) curve.vertices.emplace_back(point[0], point[1], point[2]);
        }
        if (words_.take().kind != PbrtKind::close) failAtLine(open.line, "a list has no end");
        if (count % 3 != 0)
            failAtLine(open.line, std::to_string(count) + " numbers are not whole vertices");
    }

    // ---- Points of a curve ----

    void addCurve(const PbrtCurve& curve, const PbrtBasis& basis) {
        constexpr double kWidth = 1.0;  // pbrt's default
        const double all = curve.width.value_or(kWidth);
        const std::array<double, 2> widths{curve.width0.value_or(all), curve.width1.value_or(all)};
        has_widths_ = has_widths_ || curve.width || curve.width0 || curve.width1;
        const std::size_t first = set_.points.size();
        const std::size_t segments = (curve.vertices.size() - basis.degree - 1) / basis.step + 1;
        const std::size_t pieces = (curve.vertices.size() - 1 + segments - 1) / segments;
        const auto add = [&](std::size_t segment, double t) {
            const double u = (double(segment) + t) / double(segments);
            const glm::dvec3 point = pointAt(curve, basis, segment, t);
            addPoint(point, (1.0 - u) * widths[0] + u * widths[1]);
        };
        for (std::size_t segment = 0; segment < segments; ++segment) {
            add(segment, 0.0);
            if (isStraight(curve, basis, segment)) continue;
            for (std::size_t k = 1; k < pieces; ++k) add(segment, double(k) / double(pieces));
        }
        add(segments - 1, 1.0);
        endCurve(curve, first, basis.name == "bezier");
    }

    static glm::dvec3
    pointAt(const PbrtCurve& curve, const PbrtBasis& basis, std::size_t segment, double t) {
        const auto own = std::span(curve.vertices).subspan(segment * basis.step, basis.degree + 1);
        if (basis.name == "bezier" && (t == 0.0 || t == 1.0))  // keeps -0
            return t == 0.0 ? own.front() : own.back();
        const std::array<double, 4> weights = weightsAt(*basis.weights, t);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < own.size(); ++i) sum += weights[i] * glm::dvec3(own[i]);
        return sum;
    }

    // Appends a point in the scene's space.
    void addPoint(const glm::dvec3& point, double width) {
        const bool is_there = space_.isIdentity();
        set_.points.emplace_back(is_there ? point : space_.place(point));
        set_.widths.values.push_back(
            static_cast<float>(is_there ? width : width * space_.widthFactor()));
    }

    static bool isStraight(const PbrtCurve& curve, const PbrtBasis& basis, std::size_t segment) {
        if (basis.weights != &kBezierBasis) return false;
        const auto own = std::span(curve.vertices).subspan(3 * segment, 4);
        return own[1] == pointOnTheWay(own[0], own[3], kFirstThird) &&
               own[2] == pointOnTheWay(own[0], own[3], kSecondThird);
    }

    // Makes a strand of the points from `first`, or of these and the last strand's.
    void endCurve(const PbrtCurve& curve, std::size_t first, bool is_bezier) {
        const bool can_continue = std::exchange(follows_curve_, is_bezier);
        if (set_.points.size() > std::numeric_limits<std::uint32_t>::max())
            failAtLine(curve.line, "the strands have 2^32 points, or more");
        const auto at = static_cast<std::ptrdiff_t>(first);
        if (can_continue && is_bezier && set_.points[first - 1] == set_.points[first] &&
            set_.widths.values[first - 1] == set_.widths.values[first]) {
            set_.points.erase(set_.points.begin() + at);
            set_.widths.values.erase(set_.widths.values.begin() + at);
            set_.ends.pop_back();
        }
        set_.ends.push_back(static_cast<std::uint32_t>(set_.points.size()));
    }

    void finishWidths() {
        std::vector<float>& values = set_.widths.values;
        const float first = values.front();
        const bool is_one =
            std::ranges::all_of(values, [&](float width) { return width == first; });
        if (is_one && has_widths_) set_.widths.everywhere = first;
        if (is_one || !has_widths_) values.clear();
    }

    PbrtWords words_;
    StrandSet set_;
    AffineSpace space_;
    std::vector<Block> placed_;  // what holds after each open block
    std::size_t unknown_place_ = 0;  // line of a transform that is not read; 0: there is none
    bool is_object_ = false;
    bool follows_curve_ = false;  // the directive before was a Bezier curve
    bool has_widths_ = false;
    std::size_t in_objects_ = 0;
    std::size_t included_ = 0;
};

}  // namespace

std::vector<std::string> exportPbrt(const StrandSet& strands, std::ostream& out) {
    if (greatestSize(strands) < 2) throw engine::Error("no strand has the two points of a curve");
    std::vector<std::string> warnings = leftOut(strands, {Part::widths, Part::comment});
    TextWriter text(out);
    text.add(commentLines(strands.comment, "# "));
    std::size_t single = 0;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        if (strands.size(i) < 2) {
            ++single;
            continue;
        }
        // A block keeps a reader from joining a strand to the last one, where that ends.
        const std::size_t first = strands.first(i);
        const bool touches = i > 0 && strands.points[first - 1] == strands.points[first];
        if (touches) text.add("AttributeBegin\n");
        addPbrtStrand(text, strands, i);
        if (touches) text.add("AttributeEnd\n");
    }
    text.flush();
    if (single > 0)
        warnings.push_back(
            std::to_string(single) + " strands of a single point are left out, because a curve "
                                     "has two ends");
    return warnings;
}

StrandSet importPbrt(const StrandFile& file) {
    return PbrtReader({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()}).read();
}

}  // namespace hair::groom
