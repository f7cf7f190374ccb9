#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- XML ----------------------------------------------------------------------------------------

struct XmlElement {
    std::string_view name;
    std::size_t line = 0;
    std::size_t size = 0;  // bytes, with all that is in it
    std::vector<std::pair<std::string_view, std::string_view>> attributes;
    // The texts before the first child, split at comments, each with the line that it begins on.
    std::vector<std::pair<std::string_view, std::size_t>> texts;
    std::vector<XmlElement> children;

    std::string_view attribute(std::string_view wanted) const {
        for (const auto& [name_of, value] : attributes)
            if (name_of == wanted) return value;
        return {};
    }
    const XmlElement* child(std::string_view wanted) const {
        const auto at = std::ranges::find(children, wanted, &XmlElement::name);
        return at == children.end() ? nullptr : &*at;
    }
};

// Reads the part of XML that Embree's scenes use: elements with attributes, text, comments and a
// declaration.
class XmlReader {
public:
    explicit XmlReader(std::string_view text) : rest_(text) {}

    XmlElement read() {
        skipBlank();
        if (rest_.starts_with("<?")) takeThrough("?>");
        skipBlank();
        XmlElement root = takeElement(0);
        skipBlank();
        if (!rest_.empty()) fail("text after the end of the scene");
        return root;
    }

private:
    static constexpr int kMostNested = 64;
    static constexpr std::string_view kBlank = " \t\r\n";
    static constexpr std::string_view kNameEnd = " \t\r\n=/<>\"'";

    [[noreturn]] void fail(const std::string& reason) const { failAtLine(line_, reason); }

    std::string_view take(std::size_t size) {
        const std::string_view taken = rest_.substr(0, size);
        line_ += static_cast<std::size_t>(std::ranges::count(taken, '\n'));
        rest_.remove_prefix(taken.size());
        return taken;
    }

    // Takes everything up to the mark, and the mark; returns the text before it.
    std::string_view takeThrough(std::string_view mark) {
        const std::size_t at = rest_.find(mark);
        if (at == std::string_view::npos) fail("truncated: " + inQuotes(mark) + " is expected");
        const std::string_view before = take(at);
        take(mark.size());
        return before;
    }

    void skipSpace() { take(std::min(rest_.find_first_not_of(kBlank), rest_.size())); }

    // Skips white space and comments.
    void skipBlank() {
        skipSpace();
        while (rest_.starts_with("<!--")) {
            takeThrough("-->");
            skipSpace();
        }
    }

    void expect(std::string_view mark) {
        if (!rest_.starts_with(mark)) {
            if (rest_.empty()) fail("truncated: " + inQuotes(mark) + " is expected");
            fail(inQuotes(mark) + " is expected");
        }
        take(mark.size());
    }

    std::string_view takeName() {
        const std::string_view name = take(std::min(rest_.find_first_of(kNameEnd), rest_.size()));
        if (name.empty())
            fail(rest_.empty() ? "truncated: a name is expected" : "a name is expected");
        return name;
    }

    void takeAttributes(XmlElement& element) {
        for (skipSpace(); !rest_.starts_with('>') && !rest_.starts_with("/>"); skipSpace()) {
            const std::string_view name = takeName();
            skipSpace();
            expect("=");
            skipSpace();
            const std::string_view quote = rest_.starts_with('\'') ? "'" : "\"";
            expect(quote);
            element.attributes.emplace_back(name, takeThrough(quote));
        }
    }

    XmlElement takeElement(int depth) {
        if (depth > kMostNested) fail("elements are nested more than 64 deep");
        const std::size_t before = rest_.size();
        expect("<");
        XmlElement element;
        element.line = line_;
        element.name = takeName();
        takeAttributes(element);
        if (rest_.starts_with("/>")) {
            take(2);
            element.size = before - rest_.size();
            return element;
        }
        expect(">");
        for (;;) {
            const std::size_t line = line_;
            element.texts.emplace_back(take(std::min(rest_.find('<'), rest_.size())), line);
            if (!rest_.starts_with("<!--")) break;
            takeThrough("-->");
        }
        for (;;) {
            skipBlank();
            if (rest_.starts_with("</")) break;
            if (!rest_.empty() && !rest_.starts_with('<'))
                fail("text after an element, or comment");
            element.children.push_back(takeElement(depth + 1));
        }
        take(2);
        if (takeName() != element.name)
            fail("the end of " + inQuotes(element.name) + " is expected");
        skipSpace();
        expect(">");
        element.size = before - rest_.size();
        return element;
    }

    std::string_view rest_;
    std::size_t line_ = 1;
};

// ---- Arrays -------------------------------------------------------------------------------------

// The arrays of a scene, which are in it or in the binary file beside it.
class EmbreeArrays {
public:
    EmbreeArrays(const StrandFile& file, ExpansionLimit& unfolding)
        : path_(file.path), check_(file.check), unfolding_(unfolding) {}

    // Returns vectors, which may have NaNs and infinities.
    std::vector<glm::vec4> vectors(const XmlElement& element) {
        if (isBeside(element)) return beside<glm::vec4>(element);
        const std::vector<float> numbers = words(element, [](float) { return true; });
        if (numbers.size() % 4 != 0)
            failAtLine(
                element.line, inQuotes(element.name) + " is not made of groups of x y z radius");
        std::vector<glm::vec4> vectors(numbers.size() / 4);
        if (!numbers.empty())
            std::memcpy(vectors.data(), numbers.data(), numbers.size() * sizeof(float));
        return vectors;
    }

    std::vector<float> floats(const XmlElement& element) const {
        return words(element, [](float number) { return std::isfinite(number); });
    }

    // The floats of an attribute.
    std::vector<float> floats(const XmlElement& element, std::string_view attribute) const {
        return floats({.name = attribute, .texts = {{element.attribute(attribute), element.line}}});
    }

    // `each`: numbers for each of the `size` entries of the array.
    std::vector<std::uint32_t> integers(const XmlElement& element, std::size_t each) {
        if (isBeside(element)) return beside<std::uint32_t>(element, each);
        std::vector<std::uint32_t> numbers;
        eachWord(element, [&](std::string_view word, std::size_t line) {
            const auto number = integerFrom(word);
            if (!number || *number < 0 || *number > std::numeric_limits<std::uint32_t>::max())
                failAtLine(line, inQuotes(word) + " is not an index");
            numbers.push_back(static_cast<std::uint32_t>(*number));
        });
        return numbers;
    }

private:
    static bool isBeside(const XmlElement& element) { return !element.attribute("ofs").empty(); }

    template <class Visit>
    static void eachWord(const XmlElement& element, const Visit& visit) {
        for (const auto& [text, first_line] : element.texts) {
            TextLines lines(text);
            while (!lines.atEnd()) {
                std::string_view line = lines.take();
                for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
                    visit(word, first_line + lines.number() - 1);
            }
        }
    }

    template <class Allowed>
    static std::vector<float> words(const XmlElement& element, const Allowed& allowed) {
        std::vector<float> numbers;
        eachWord(element, [&](std::string_view word, std::size_t line) {
            const auto number = floatFrom(word);
            if (!number || !allowed(*number))
                failAtLine(line, inQuotes(word) + " is not a finite number");
            numbers.push_back(*number);
        });
        return numbers;
    }

    static std::uint64_t count(const XmlElement& element, std::string_view attribute) {
        const std::string_view text = element.attribute(attribute);
        const auto number = integerFrom(text);
        if (!number || *number < 0)
            failAtLine(
                element.line,
                inQuotes(attribute) + " is " + inQuotes(text) + ", which is not a number");
        return static_cast<std::uint64_t>(*number);
    }

    template <class Value>
    std::vector<Value> beside(const XmlElement& element, std::size_t each = 1) {
        const std::uint64_t start = count(element, "ofs");
        const std::uint64_t size = count(element, "size");
        const auto bytes = std::as_bytes(std::span(fileBeside(element)));
        if (start > bytes.size() || size > (bytes.size() - start) / sizeof(Value) / each)
            failAtLine(
                element.line, "truncated: the file beside the scene has only " +
                                  std::to_string(bytes.size()) + " bytes");
        unfolding_.add(size * each * sizeof(Value), "the arrays in the binary file");
        return arrayAt<Value>(bytes, start, size * each);
    }

    const std::string& fileBeside(const XmlElement& element) {
        if (bytes_) return *bytes_;
        if (path_.empty())
            failAtLine(element.line, inQuotes(element.name) + " lies in a file beside the scene");
        std::filesystem::path beside = path_;
        beside.replace_extension(".bin");
        if (!std::filesystem::exists(beside)) beside = path_.string() + ".bin";
        if (check_) check_(beside);
        bytes_.emplace(engine::readFile(beside));
        unfolding_.allow(bytes_->size());
        return *bytes_;
    }

    std::filesystem::path path_;
    NamedFileCheck check_;
    ExpansionLimit& unfolding_;
    std::optional<std::string> bytes_;  // of the file beside the scene, once it is needed
};

// ---- Curves -------------------------------------------------------------------------------------

struct EmbreeBasis {
    std::string_view name;
    const CurveBasis* weights;  // null: linear
    std::uint32_t vertices;  // of a segment
    std::uint32_t step;  // vertices from a segment to the next of its curve
};

// Vertices with tangents, which are converted to Bezier curves.
constexpr std::string_view kHermite = "hermite";

constexpr std::array kEmbreeBases{
    EmbreeBasis{"linear", nullptr, 2, 1}, EmbreeBasis{"bezier", &kBezierBasis, 4, 3},
    EmbreeBasis{kHermite, &kBezierBasis, 4, 3}, EmbreeBasis{"bspline", &kBsplineBasis, 4, 1},
    EmbreeBasis{"catmull_rom", &kCatmullRomBasis, 4, 1}};

struct EmbreeCurvesRow {
    std::string_view element;
    std::string_view basis;  // empty: given by an attribute
    bool has_pairs = false;  // each index has the curve's number beside it
};

constexpr std::array kEmbreeCurves{
    EmbreeCurvesRow{"Curves", ""},
    EmbreeCurvesRow{"LineSegments", "linear"},
    EmbreeCurvesRow{"RoundLineSegments", "linear"},
    EmbreeCurvesRow{"ConeSegments", "linear"},
    EmbreeCurvesRow{"BSplineHair", "bspline"},
    EmbreeCurvesRow{"BSplineCurves", "bspline"},
    EmbreeCurvesRow{"Hair", "bezier", true},
    EmbreeCurvesRow{"BezierHair", "bezier", true},
    EmbreeCurvesRow{"BezierCurves", "bezier", true}};

// Segments of one strand: the first control vertex and the number of segments.
struct EmbreeStrand {
    std::uint32_t first;
    std::uint32_t segments;
};

class EmbreeScene {
public:
    explicit EmbreeScene(const StrandFile& file)
        : unfolding_(file.bytes.size()), arrays_(file, unfolding_) {}

    StrandSet read(const XmlElement& root) {
        if (root.name != "scene")
            failAtLine(root.line, inQuotes(root.name) + ", expected a scene of Embree, 'scene'");
        for (const XmlElement& child : root.children) readNode(child, {});
        if (set_.ends.empty())
            failAtLine(
                root.line,
                "the scene has no curves" + (left_out_.empty() ? "" : ", but " + leftOutNames()));
        if (!left_out_.empty())
            set_.warnings.push_back("the scene's " + leftOutNames() + " are left out");
        return std::move(set_);
    }

private:
    std::string leftOutNames() const {
        std::string names;
        for (const std::string_view name : left_out_)
            names.append(names.empty() ? "" : ", ").append(inQuotes(name));
        return names;
    }

    void readNode(const XmlElement& element, const AffineSpace& space) {
        if (const std::string_view id = element.attribute("id");
            !id.empty() && element.name != "ref" && element.name != "assign")
            named_.insert_or_assign(id, std::vector{&element});
        if (element.name == "assign") {
            define(element);
        } else if (element.name == "ref") {
            follow(element, space);
        } else if (element.name == "Group") {
            for (const XmlElement& child : element.children) readNode(child, space);
        } else if (element.name == "Transform") {
            readTransform(element, space);
        } else if (const auto row =
                       std::ranges::find(kEmbreeCurves, element.name, &EmbreeCurvesRow::element);
                   row != kEmbreeCurves.end()) {
            readCurves(element, *row, space);
        } else {
            left_out_.insert(element.name);
        }
    }

    void follow(const XmlElement& ref, const AffineSpace& space) {
        const auto named = named_.find(ref.attribute("id"));
        if (named == named_.end())
            failAtLine(ref.line, "no earlier element has the id " + inQuotes(ref.attribute("id")));
        if (++references_ > kMostReferences)
            failAtLine(
                ref.line, "references are nested more than 64 deep; does one refer to itself?");
        const std::vector<const XmlElement*> nodes = named->second;
        for (const XmlElement* const node : nodes) {
            repeated(*node, node->size);
            readNode(*node, space);
        }
        --references_;
    }

    // Counts the bytes that references read again, because a small scene could otherwise stand for
    // an endless one.
    void repeated(const XmlElement& element, std::size_t bytes) {
        try {
            unfolding_.add(bytes, "the scene's references");
        } catch (const engine::Error& error) {
            failAtLine(element.line, error.what());
        }
    }

    // Defines nodes for later references, without placing them.
    void define(const XmlElement& element) {
        std::vector<const XmlElement*> nodes;
        for (const XmlElement& child : element.children) {
            nodes.push_back(&child);
            if (const std::string_view id = child.attribute("id"); !id.empty())
                named_.insert_or_assign(id, std::vector{&child});
        }
        if (const std::string_view id = element.attribute("id"); !id.empty())
            named_.insert_or_assign(id, std::move(nodes));
    }

    AffineSpace spaceOf(const XmlElement& element) const {
        AffineSpace space;
        for (const std::string_view attribute : {"translate", "scale"}) {
            if (element.attribute(attribute).empty()) continue;
            const std::vector<float> numbers = arrays_.floats(element, attribute);
            if (numbers.size() != 3 || element.attributes.size() != 1)
                failAtLine(
                    element.line, "an AffineSpace without 3 numbers for 'translate' or "
                                  "'scale' alone");
            for (int axis = 0; axis < 3; ++axis) {
                const double number = numbers[static_cast<std::size_t>(axis)];
                (attribute == "scale" ? space.linear[axis] : space.translation)[axis] = number;
            }
            return space;
        }
        const std::vector<float> numbers =
            element.attributes.empty() ? arrays_.floats(element) : std::vector<float>();
        if (numbers.size() != 12)
            failAtLine(
                element.line, "an AffineSpace is 12 numbers, or has a 'translate' or 'scale' of 3");
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                space.linear[column][row] = numbers[static_cast<std::size_t>(4 * row + column)];
            space.translation[row] = numbers[static_cast<std::size_t>(4 * row + 3)];
        }
        return space;
    }

    void readTransform(const XmlElement& element, const AffineSpace& space) {
        if (element.children.empty() || element.children.front().name != "AffineSpace" ||
            !element.attribute("time_steps").empty())
            failAtLine(
                element.line, "a transform that doesn't begin with one AffineSpace is not "
                              "read");
        const AffineSpace all = space.of(spaceOf(element.children.front()));
        for (const XmlElement& child : std::span(element.children).subspan(1)) readNode(child, all);
    }

    const EmbreeBasis& basisOf(const XmlElement& element, const EmbreeCurvesRow& row) const {
        const std::string_view name = row.basis.empty() ? element.attribute("basis") : row.basis;
        const auto basis = std::ranges::find(kEmbreeBases, name, &EmbreeBasis::name);
        if (basis != kEmbreeBases.end()) return *basis;
        failAtLine(
            element.line, "curves of basis " + inQuotes(name) +
                              ", expected linear, bezier, bspline, hermite or catmull_rom");
    }

    // Returns an array of curves; for moving curves, the first one. Null if there is none.
    const XmlElement*
    arrayOf(const XmlElement& element, std::string_view name, std::string_view moving) {
        const XmlElement* const animated = element.child(moving);
        if (!animated || animated->children.empty()) return element.child(name);
        left_out_.insert(moving);
        return &animated->children.front();
    }

    std::vector<glm::vec4> positionsOf(const XmlElement& element) {
        const XmlElement* const positions = arrayOf(element, "positions", "animated_positions");
        if (element.child("positions2")) left_out_.insert("positions2");
        if (!positions) failAtLine(element.line, inQuotes(element.name) + " without positions");
        return arrays_.vectors(*positions);
    }

    // Returns three vertices for each vertex of a Hermite curve: before it by a third of its
    // tangent, itself, and after it.
    std::vector<glm::vec4>
    withTangents(const XmlElement& element, const std::vector<glm::vec4>& positions) {
        const XmlElement* const tangents = arrayOf(element, "tangents", "animated_tangents");
        if (!tangents) failAtLine(element.line, "curves of basis 'hermite' without tangents");
        const std::vector<glm::vec4> vectors = arrays_.vectors(*tangents);
        if (vectors.size() != positions.size())
            failAtLine(
                tangents->line, std::to_string(vectors.size()) + " tangents, but there are " +
                                    std::to_string(positions.size()) + " positions");
        std::vector<glm::vec4> all;
        all.reserve(3 * positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const glm::vec4 third = vectors[i] / 3.0f;
            for (const float side : {-1.0f, 0.0f, 1.0f}) all.push_back(positions[i] + side * third);
        }
        return all;
    }

    // Returns strands of consecutive segments, each within one curve if curves have numbers.
    std::vector<EmbreeStrand> strandsOf(
        const XmlElement& element, const EmbreeBasis& basis, bool has_pairs, std::size_t vertices) {
        const XmlElement* const indices = element.child("indices");
        if (!indices) failAtLine(element.line, inQuotes(element.name) + " without indices");
        const std::size_t each = has_pairs ? 2 : 1;
        std::vector<std::uint32_t> numbers = arrays_.integers(*indices, each);
        if (numbers.size() % each != 0)
            failAtLine(indices->line, "an index without the number of its curve");
        if (basis.name == kHermite) {
            for (std::uint32_t& number : numbers) {
                if (number >= vertices / 3)
                    failAtLine(
                        indices->line, "a segment from vertex " + std::to_string(number) +
                                           ", but there are " + std::to_string(vertices / 3));
                number = 3 * number + 1;
            }
        }
        std::vector<std::uint32_t> curves;
        if (const XmlElement* const ids = element.child("curveid")) {
            curves = arrays_.integers(*ids, 1);
            if (curves.size() != numbers.size())
                failAtLine(
                    ids->line, std::to_string(curves.size()) +
                                   " numbers of curves, but there are " +
                                   std::to_string(numbers.size()) + " segments");
        }
        std::vector<EmbreeStrand> strands;
        for (std::size_t i = 0; i < numbers.size(); i += each) {
            const std::uint64_t first = numbers[i];
            if (first + basis.vertices > vertices)
                failAtLine(
                    indices->line, "a segment of vertices " + std::to_string(first) + " to " +
                                       std::to_string(first + basis.vertices - 1) +
                                       ", but there are " + std::to_string(vertices));
            const bool same_curve = i > 0 && (has_pairs        ? numbers[i + 1] == numbers[i - 1]
                                              : curves.empty() ? true
                                                               : curves[i] == curves[i - 1]);
            const bool follows =
                same_curve && first == std::uint64_t{numbers[i - each]} + basis.step;
            if (follows) {
                ++strands.back().segments;
            } else {
                strands.push_back({numbers[i], 1});
            }
        }
        return strands;
    }

    void
    readCurves(const XmlElement& element, const EmbreeCurvesRow& row, const AffineSpace& space) {
        const EmbreeBasis& basis = basisOf(element, row);
        std::vector<glm::vec4> positions = positionsOf(element);
        if (basis.name == kHermite) positions = withTangents(element, positions);
        const std::vector<EmbreeStrand> strands =
            strandsOf(element, basis, row.has_pairs, positions.size());
        std::uint32_t pieces = 1;  // between the ends of a segment
        for (const EmbreeStrand& strand : strands) {
            if (!basis.weights) break;
            const std::uint32_t vertices = basis.vertices + (strand.segments - 1) * basis.step;
            pieces = std::max(pieces, (vertices - 1 + strand.segments - 1) / strand.segments);
        }
        std::uint64_t added = 0;
        for (const EmbreeStrand& strand : strands)
            added += std::uint64_t{strand.segments} * pieces + 1;
        if (references_ > 0) repeated(element, added * kBytesOfPoint);
        const std::uint64_t points = set_.points.size() + added;
        if (points > std::numeric_limits<std::uint32_t>::max())
            failAtLine(element.line, "the strands have 2^32 points, or more");
        for (const EmbreeStrand& strand : strands) {
            for (std::uint32_t i = 0; i < strand.segments; ++i) {
                const auto corners = std::span(positions).subspan(
                    strand.first + std::size_t{i} * basis.step, basis.vertices);
                for (std::uint32_t k = 0; k < pieces; ++k)
                    add(pointOf(basis, corners, double(k) / pieces), space);
                if (i + 1 == strand.segments) add(pointOf(basis, corners, 1.0), space);
            }
            set_.ends.push_back(static_cast<std::uint32_t>(set_.points.size()));
        }
    }

    // Returns a segment's place and radius at t from 0 to 1; for a linear segment, one of its
    // ends.
    static glm::dvec4
    pointOf(const EmbreeBasis& basis, std::span<const glm::vec4> corners, double t) {
        if (!basis.weights) return corners[t == 0.0 ? 0 : 1];
        const std::array<double, 4> weights = weightsAt(*basis.weights, t);
        glm::dvec4 point(0.0);
        for (std::size_t i = 0; i < corners.size(); ++i)
            point += weights[i] * glm::dvec4(corners[i]);
        // Between vertices with radii that are not negative, a curve's may be below all of them.
        const bool is_cut =
            std::ranges::none_of(corners, [](const glm::vec4& corner) { return corner.w < 0.0f; });
        if (is_cut && point.w < 0.0) point.w = 0.0;
        return point;
    }

    void add(const glm::dvec4& point, const AffineSpace& space) {
        glm::dvec3 place(point);
        double width = 2.0 * point.w;
        if (!space.isIdentity()) {
            place = space.place(place);
            width *= space.widthFactor();
        }
        set_.points.emplace_back(place);
        set_.widths.values.push_back(static_cast<float>(width));
    }

    static constexpr int kMostReferences = 64;
    static constexpr std::size_t kBytesOfPoint = sizeof(glm::vec3) + sizeof(float);

    ExpansionLimit unfolding_;
    EmbreeArrays arrays_;
    std::map<std::string_view, std::vector<const XmlElement*>> named_;
    int references_ = 0;  // references around the node
    std::set<std::string_view> left_out_;
    StrandSet set_;
};

}  // namespace

StrandSet importEmbreeXml(const StrandFile& file) {
    const XmlElement root =
        XmlReader({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()}).read();
    return EmbreeScene(file).read(root);
}

}  // namespace hair::groom
