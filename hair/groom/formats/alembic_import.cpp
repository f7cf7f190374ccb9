#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "hair/groom/formats/alembic_values.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/ogawa.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

using namespace std::string_view_literals;

// Most bytes of points and triangles for each byte of the file. Equal objects share data in it,
// but not without limit.
constexpr std::uint64_t kMostShared = 16;

// A day of 12 samples a second.
constexpr std::uint32_t kMostSamples = 1 << 20;

// The element that a parameter has a value for.
enum class PerWhat : std::uint8_t { object, curve, vertex, end };

// ---- Objects ------------------------------------------------------------------------------------

// Data of an object's curves; their points are already in the set.
struct AlembicCurves {
    std::uint32_t strands = 0;
    std::uint32_t points = 0;
    PointAttribute<float> widths;
    PointAttribute<glm::vec3> colors;
    std::vector<glm::vec2> root_uvs;
    std::vector<std::int32_t> groups;
    std::vector<std::uint8_t> guides;
};

// Data that an object inherits from those above it.
struct AlembicPlace {
    AffineSpace space;
    bool is_hidden = false;
    std::optional<float> width;
    std::optional<std::int32_t> group;
    std::optional<std::int32_t> guide;
};

// Properties that are read, or don't concern the strands.
constexpr std::array kKnownProperties{
    "P"sv,
    "nVertices"sv,
    "curveBasisAndType"sv,
    ".selfBnds"sv,
    ".childBnds"sv,
    ".arbGeomParams"sv,
    ".userProperties"sv,
    "w"sv,
    ".orders"sv,
    ".knots"sv,
    "width"sv,
    "uv"sv,
    "groom_width"sv,
    "groom_color"sv,
    "groom_root_uv"sv,
    "groom_group_id"sv,
    "groom_group_name"sv,
    "groom_guide"sv,
    "groom_version_major"sv,
    "groom_version_minor"sv,
    "groom_tool"sv,
    "groom_properties"sv};

// User's properties that are read.
constexpr std::array kUserProperties{
    "groom_width"sv, "groom_group_id"sv, "groom_group_name"sv, "groom_guide"sv};

class AlembicReader {
public:
    explicit AlembicReader(std::span<const std::byte> bytes, std::uint32_t sample = 0)
        : values_(bytes, sample) {}

    // Returns the times of the samples of all that moves, s from the first; after read(). Throws if
    // they differ between objects.
    std::vector<double> times() const {
        if (clocks_.empty()) return {0.0};
        std::vector<double> times;
        for (const auto& [sampling, samples] : clocks_) {
            if (samples > kMostSamples)
                failAt(
                    0, std::to_string(samples) + " samples, more than " +
                           std::to_string(kMostSamples));
            std::vector<double> own = values_.archive().timesOf(sampling, samples);
            if (!times.empty() && own != times)
                failAt(
                    0, "curves or transforms have samples at different times: export them with "
                       "the same");
            times = std::move(own);
        }
        const double first = times.front();
        for (double& time : times) time -= first;
        return times;
    }

    StrandSet read() {
        readObject(values_.archive().top(), "", {});
        if (set_.ends.empty()) {
            if (hidden_ > 0)
                failAt(0, "the archive has only hidden curves: show them, then export");
            std::string found;
            for (const std::string& name : left_out_)
                found.append(found.empty() ? "; it has " : ", ").append(name);
            failAt(0, "the archive has no curves" + found);
        }
        joinParts();
        if (moving_ > 0) {
            const std::string others =
                moving_ > 1 ? " and of " + std::to_string(moving_ - 1) + " more" : "";
            set_.warnings.push_back(
                first_moving_ + others + ": the first sample of " + std::to_string(most_samples_) +
                " is read");
        }
        warnOfStrands(hidden_, "of hidden objects", set_);
        if (!left_out_.empty()) {
            std::string names;
            for (const std::string& name : left_out_)
                names.append(names.empty() ? "" : ", ").append(name);
            set_.warnings.push_back(names + ": left out");
        }
        return std::move(set_);
    }

private:
    // ---- Objects ----

    void warnOfSamples(const AlembicProperty& property, const std::string& path) {
        if (property.stored < 2) return;
        clocks_.emplace(property.time_sampling, property.samples);
        if (moving_ == 0) first_moving_ = path;
        ++moving_;
        most_samples_ = std::max(most_samples_, property.samples);
    }

    void
    readObject(const AlembicObject& object, const std::string& path, const AlembicPlace& above) {
        const AlembicContents contents = values_.archive().contentsOf(object, path);
        const std::string_view schema = alembicValue(object.metadata, "schema");
        AlembicPlace place = above;
        place.is_hidden = isHidden(values_, contents.properties, path, above.is_hidden);
        if (schema.starts_with("AbcGeom_Xform_v")) {
            readTransform(contents.properties, path, place);
        } else if (schema.starts_with("AbcGeom_Curve_v")) {
            readCurves(contents.properties, schema, path, place);
        } else if (
            std::ranges::find(contents.properties, ".instanceSource", &AlembicProperty::name) !=
            contents.properties.end()) {
            left_out_.insert("instances");
        } else if (!schema.empty()) {
            leaveOut(schema);
        }
        for (const AlembicObject& child : contents.children)
            readObject(child, path + '/' + std::string(child.name), place);
    }

    // Keeps names short and few, so that they fit a sentence.
    void leaveOut(std::string_view name) {
        constexpr std::size_t kMostNames = 20;
        if (left_out_.size() < kMostNames) left_out_.insert(inQuotes(name));
    }

    void readTransform(
        const std::vector<AlembicProperty>& properties, const std::string& path,
        AlembicPlace& place) {
        const AlembicCompound transform = values_.compoundOf(properties, ".xform", path);
        const AlembicTransform below = alembicTransformOf(values_, transform, place.space);
        place.space = below.space;
        if (below.numbers) warnOfSamples(*below.numbers, transform.path);
        const AlembicCompound parameters = values_.compoundIn(transform, ".arbGeomParams");
        const AlembicCompound own = values_.compoundIn(transform, ".userProperties");
        warnOfUserProperties(own);
        const auto one = [&](std::string_view name) {
            auto parameter = eitherOf(parameters, own, name);
            if (parameter && parameter->count() != 1) parameter->fail("one value is expected");
            return parameter;
        };
        if (const auto width = one("groom_width")) place.width = widthsOf(*width, {}).front();
        if (const auto group = one("groom_group_id"))
            place.group = values_.integersOf(*group).front();
        if (const auto guide = one("groom_guide")) place.guide = values_.integersOf(*guide).front();
        warnOfVersion(parameters);
    }

    // Returns a parameter, or the user's property of this name: Blender writes an object's custom
    // properties there.
    std::optional<AlembicParameter>
    eitherOf(const AlembicCompound& parameters, const AlembicCompound& own, std::string_view name) {
        auto parameter = values_.parameterOf(parameters, name);
        return parameter ? std::move(parameter) : values_.parameterOf(own, name);
    }

    // Blender's own are settings of its curves.
    void warnOfUserProperties(const AlembicCompound& own) {
        for (const auto& [name, property] : own.properties)
            if (!name.starts_with("hairbench:") && !name.starts_with("blender:") &&
                std::ranges::find(kUserProperties, name) == kUserProperties.end())
                leaveOut(std::string("userProperties:").append(name));
    }

    void warnOfVersion(const AlembicCompound& parameters) {
        const auto major = values_.parameterOf(parameters, "groom_version_major");
        if (!major) return;
        const std::int32_t version = values_.integersOf(*major).front();
        if (version != 1)
            set_.warnings.push_back(
                parameters.path + ": version " + std::to_string(version) +
                " of Unreal's groom schema is read as 1");
    }

    // ---- Curves ----

    void readCurves(
        const std::vector<AlembicProperty>& properties, std::string_view schema,
        const std::string& path, const AlembicPlace& place) {
        if (schema != "AbcGeom_Curve_v2")
            failIn(
                properties.empty() ? 0 : properties.front().header, path,
                "curves of " + inQuotes(schema) + ", expected AbcGeom_Curve_v2");
        const AlembicCompound geometry = values_.compoundOf(properties, ".geom", path);
        const auto points = values_.parameterOf(geometry, "P");
        const auto sizes = values_.parameterOf(geometry, "nVertices");
        if (!points && !sizes) return;  // an object without its curves
        if (place.is_hidden) {
            hidden_ += sizes ? sizes->count() : 0;
            return;
        }
        if (!points || !sizes)
            failIn(
                (points ? points->property : sizes->property).header, geometry.path,
                points ? "positions without nVertices" : "nVertices without positions");
        warnOfSamples(points->property, path);
        if (sizes->property.stored > 1)
            clocks_.emplace(sizes->property.time_sampling, sizes->property.samples);
        AlembicTopology topology(values_, geometry, *sizes);
        const std::uint32_t first_strand = set_.strandCount();
        AlembicCurves curves;
        readPoints(*points, *sizes, topology, place.space, curves);
        const AlembicCompound own = values_.compoundIn(geometry, ".userProperties");
        warnOfUserProperties(own);
        readParameters(geometry, own, topology, place, curves);
        readUserProperties(own, first_strand, curves.strands);
        curves_.push_back(std::move(curves));
    }

    void share(std::uint64_t bytes, const AlembicParameter& parameter) {
        shared_ += bytes;
        if (shared_ / kMostShared > values_.bytes().size())
            parameter.fail("objects share the file's data more than 16 times over");
    }

    void readPoints(
        const AlembicParameter& points, const AlembicParameter& sizes, AlembicTopology& topology,
        const AffineSpace& space, AlembicCurves& curves) {
        if (points.count() != topology.vertices())
            points.fail(
                std::to_string(points.count()) + " positions, but nVertices are " +
                std::to_string(topology.vertices()));
        share(topology.vertices() * sizeof(glm::vec3), points);
        std::vector<glm::vec3> vertices;
        if (!topology.isLinear()) {
            vertices = values_.floatsOf<glm::vec3>(points);
            topology.draw(vertices, sizes);
        }
        const std::size_t start = set_.points.size();
        std::uint64_t end = start;
        if (set_.ends.empty()) set_.ends.reserve(topology.curves());
        for (std::size_t i = 0; i < topology.curves(); ++i) {
            end += topology.pointsOf(i);
            if (end > std::numeric_limits<std::uint32_t>::max())
                sizes.fail("the strands have 2^32 points, or more");
            set_.ends.push_back(static_cast<std::uint32_t>(end));
        }
        if (!topology.isLinear()) {
            if (start == 0) set_.points.reserve(end);
            topology.alongVertices(std::span<const glm::vec3>(vertices), [&](const glm::dvec3& p) {
                set_.points.push_back(placed(p, space));
            });
        } else {
            appendLinear(points, space);
        }
        curves.strands = static_cast<std::uint32_t>(topology.curves());
        curves.points = static_cast<std::uint32_t>(end - start);
    }

    // Appends the vertices as they are.
    void appendLinear(const AlembicParameter& points, const AffineSpace& space) {
        if (set_.points.empty() && !points.has_indices) {
            set_.points = values_.floatsOf<glm::vec3>(points);
        } else {
            const std::vector<glm::vec3> own = values_.floatsOf<glm::vec3>(points);
            set_.points.insert(set_.points.end(), own.begin(), own.end());
        }
        if (space.isIdentity()) return;
        const auto added = std::span(set_.points).last(points.count());
        for (glm::vec3& point : added) point = placed(point, space);
    }

    static glm::vec3 placed(const glm::dvec3& point, const AffineSpace& space) {
        return glm::vec3(space.isIdentity() ? point : space.place(point));
    }

    // ---- Parameters of curves ----

    static PerWhat perWhatOf(const AlembicParameter& parameter, const AlembicTopology& topology) {
        const std::uint64_t count = parameter.count();
        if (count == 1) return PerWhat::object;
        if (count == topology.curves()) return PerWhat::curve;
        if (count == topology.vertices()) return PerWhat::vertex;
        if (!topology.isLinear() && count == topology.ends()) return PerWhat::end;
        parameter.fail(
            std::to_string(count) + " values, expected 1, one for each of " +
            std::to_string(topology.curves()) + " curves, or of " +
            std::to_string(topology.vertices()) + " vertices");
    }

    // Returns values for the curves' points.
    template <class Value, class Rounded>
    static PointAttribute<Value> perPoint(
        const AlembicParameter& parameter, const AlembicTopology& topology,
        std::vector<Value> values, const Rounded& rounded) {
        const PerWhat what = perWhatOf(parameter, topology);
        if (what == PerWhat::object) return {.everywhere = values.front(), .values = {}};
        if (what == PerWhat::vertex && topology.isLinear())
            return {.everywhere = {}, .values = std::move(values)};
        PointAttribute<Value> result;
        const auto add = [&](const auto& value) { result.values.push_back(rounded(value)); };
        if (what == PerWhat::vertex)
            topology.alongVertices(std::span<const Value>(values), add);
        else if (what == PerWhat::end)
            topology.alongEnds(std::span<const Value>(values), add);
        else
            for (std::size_t i = 0; i < values.size(); ++i)
                result.values.insert(result.values.end(), topology.pointsOf(i), values[i]);
        return result;
    }

    // Returns values for the curves; absent unless there is one value, or one for each curve.
    template <class Value>
    static std::optional<std::vector<Value>>
    perCurve(std::vector<Value> values, const AlembicTopology& topology) {
        if (values.size() == 1) values.resize(topology.curves(), Value(values.front()));
        if (values.size() != topology.curves()) return {};
        return values;
    }

    // Returns diameters in the space of the file.
    std::vector<float> widthsOf(const AlembicParameter& parameter, const AffineSpace& space) const {
        parameter.require(AlembicType::float32, 1);
        auto widths = values_.stored<float>(parameter);
        const double factor = space.isIdentity() ? 1.0 : space.widthFactor();
        // A rotation has the factor 1 up to rounding.
        if (std::abs(factor - 1.0) > 1e-9)
            for (float& width : widths) width = static_cast<float>(width * factor);
        return parameter.arranged(std::move(widths));
    }

    void readParameters(
        const AlembicCompound& geometry, const AlembicCompound& own,
        const AlembicTopology& topology, const AlembicPlace& place, AlembicCurves& curves) {
        const AlembicCompound parameters = values_.compoundIn(geometry, ".arbGeomParams");
        for (const AlembicCompound* const all : {&geometry, &parameters})
            for (const auto& [name, property] : all->properties)
                if (std::ranges::find(kKnownProperties, name) == kKnownProperties.end() &&
                    (property.samples > 0 || property.group != 0))
                    leaveOut(name);
        warnOfVersion(parameters);

        auto width = eitherOf(parameters, own, "groom_width");
        if (!width && !place.width) width = values_.parameterOf(geometry, "width");
        if (width) {
            std::vector<float> widths = widthsOf(*width, place.space);
            // Between vertices with widths that are not negative, a curve may be below all of them.
            const bool is_cut = std::ranges::none_of(widths, isNegative);
            curves.widths = perPoint(*width, topology, std::move(widths), [is_cut](double value) {
                return static_cast<float>(is_cut && value < 0.0 ? 0.0 : value);
            });
        } else if (place.width) {
            const double factor = place.space.isIdentity() ? 1.0 : place.space.widthFactor();
            curves.widths.everywhere = static_cast<float>(*place.width * factor);
        }
        if (const auto color = values_.parameterOf(parameters, "groom_color"))
            readColors(*color, topology, curves);
        readRootUvs(geometry, parameters, topology, curves);
        curves.groups = integersIn(parameters, own, "groom_group_id", topology, place.group);
        if (const auto names = eitherOf(parameters, own, "groom_group_name")) {
            if (curves.groups.empty())
                curves.groups = groupsNamed(*names, topology);
            else
                leaveOut("groom_group_name");
        }
        for (const std::int32_t flag :
             integersIn(parameters, own, "groom_guide", topology, place.guide))
            curves.guides.push_back(flag != 0 ? 1 : 0);
    }

    void readColors(
        const AlembicParameter& color, const AlembicTopology& topology, AlembicCurves& curves) {
        std::vector<glm::vec3> values;
        if (color.property.isOf(AlembicType::float32, 4)) {
            for (const glm::vec4& rgba : values_.floatsOf<glm::vec4>(color))
                values.emplace_back(rgba);
        } else {
            values = values_.floatsOf<glm::vec3>(color);
        }
        curves.colors = perPoint(color, topology, std::move(values), [](const glm::dvec3& value) {
            return glm::vec3(value);
        });
    }

    void readRootUvs(
        const AlembicCompound& geometry, const AlembicCompound& parameters,
        const AlembicTopology& topology, AlembicCurves& curves) {
        const auto root_uv = values_.parameterOf(parameters, "groom_root_uv");
        const auto uv = values_.parameterOf(geometry, "uv");
        if (root_uv) {
            auto all = perCurve(values_.floatsOf<glm::vec2>(*root_uv), topology);
            if (!all) root_uv->fail("one is expected for each curve");
            curves.root_uvs = std::move(*all);
        } else if (uv && uv->count() == topology.curves()) {
            curves.root_uvs = values_.floatsOf<glm::vec2>(*uv);
        } else if (uv) {
            leaveOut("uv");
        }
    }

    // Returns an integer for each curve, its own or inherited; empty if there is neither.
    std::vector<std::int32_t> integersIn(
        const AlembicCompound& parameters, const AlembicCompound& own, std::string_view name,
        const AlembicTopology& topology, std::optional<std::int32_t> above) {
        const auto here = eitherOf(parameters, own, name);
        if (!here && !above) return {};
        auto all = perCurve(
            here ? values_.integersOf(*here) : std::vector<std::int32_t>{*above}, topology);
        if (!all) here->fail("one is expected, or one for each curve");
        return std::move(*all);
    }

    // Returns a number for each curve's group: 0 for the name that comes first in the archive, and
    // so on.
    std::vector<std::int32_t>
    groupsNamed(const AlembicParameter& names, const AlembicTopology& topology) {
        names.require(AlembicType::text, 1);
        share(names.elements.count, names);
        const std::vector<char> bytes = values_.stored<char>(names);
        if (bytes.back() != '\0') names.fail("a text has no end");
        std::vector<std::int32_t> numbers;
        for (auto at = bytes.begin(); at != bytes.end();) {
            const auto end = std::find(at, bytes.end(), '\0');
            const auto number = static_cast<std::int32_t>(group_names_.size());
            numbers.push_back(group_names_.try_emplace({at, end}, number).first->second);
            at = end + 1;
        }
        for (const std::uint32_t index : names.indices)
            if (index >= numbers.size())
                names.fail(
                    "index " + std::to_string(index) + " of " + std::to_string(numbers.size()) +
                    " names");
        auto all = perCurve(names.arranged(std::move(numbers)), topology);
        if (!all) names.fail("one is expected, or one for each curve");
        return std::move(*all);
    }

    // Reads additional data of hairbench's own archives.
    void readUserProperties(
        const AlembicCompound& own, std::uint32_t first_strand, std::uint32_t strands) {
        if (const auto unit = values_.parameterOf(own, "hairbench:metersPerUnit")) {
            const double metres = values_.doublesOf(*unit, 1).front();
            if (!(metres > 0.0)) unit->fail("the unit has no length");
            if (set_.metres_per_unit.value_or(metres) != metres)
                unit->fail("the unit differs from that of earlier objects");
            set_.metres_per_unit = metres;
        }
        if (const auto up = values_.parameterOf(own, "hairbench:upAxis")) {
            const std::int32_t axis = values_.integersOf(*up).front();
            if (axis < 0 || axis > 2) up->fail("the upward axis is none of 0, 1 and 2");
            set_.up = static_cast<std::uint8_t>(axis);
        }
        if (const auto triangles = values_.parameterOf(own, "hairbench:rootTriangles")) {
            using Triangle = std::array<std::uint32_t, 3>;
            triangles->require(AlembicType::uint32, 3);
            share(triangles->count() * sizeof(Triangle), *triangles);
            for (Triangle triangle : triangles->arranged(values_.stored<Triangle>(*triangles))) {
                for (std::uint32_t& strand : triangle) {
                    if (strand >= strands)
                        triangles->fail("a triangle names a strand that is not there");
                    strand += first_strand;
                }
                set_.root_triangles.push_back(triangle);
            }
        }
        const auto comment = values_.parameterOf(own, "hairbench:comment");
        if (comment && set_.comment.empty()) {
            comment->require(AlembicType::text, 1);
            const std::vector<char> text = values_.stored<char>(*comment);
            set_.comment.assign(text.begin(), std::ranges::find(text, '\0'));
        }
    }

    // ---- All objects together ----

    // Returns the points of objects without the part, which other objects have.
    template <class Value>
    std::vector<PointRange>
    joinAttribute(PointAttribute<Value> AlembicCurves::* part, PointAttribute<Value>& joined) {
        const auto is_known = [&](const AlembicCurves& curves) { return (curves.*part).known(); };
        if (std::ranges::none_of(curves_, is_known)) return {};
        const PointAttribute<Value>& first = curves_.front().*part;
        const bool is_one = std::ranges::all_of(curves_, [&](const AlembicCurves& curves) {
            return (curves.*part).values.empty() && (curves.*part).everywhere == first.everywhere;
        });
        if (is_one || curves_.size() == 1) {
            joined = std::move(curves_.front().*part);
            return {};
        }
        std::vector<PointRange> without;
        joined.values.reserve(set_.points.size());
        for (const AlembicCurves& curves : curves_) {
            const PointAttribute<Value>& own = curves.*part;
            if (!own.known()) without.push_back({joined.values.size(), curves.points});
            if (own.values.empty())
                joined.values.insert(
                    joined.values.end(), curves.points, own.everywhere.value_or(Value{}));
            else
                joined.values.insert(joined.values.end(), own.values.begin(), own.values.end());
        }
        return without;
    }

    template <class Value>
    void join(std::vector<Value> AlembicCurves::* part, std::vector<Value>& joined) {
        if (curves_.size() == 1) {
            joined = std::move(curves_.front().*part);
            return;
        }
        joined.reserve(set_.ends.size());
        for (const AlembicCurves& curves : curves_)
            joined.insert(joined.end(), (curves.*part).begin(), (curves.*part).end());
    }

    void joinParts() {
        completeWidths(set_, joinAttribute(&AlembicCurves::widths, set_.widths));
        completeColors(set_, joinAttribute(&AlembicCurves::colors, set_.colors));
        const auto has_uvs =
            std::ranges::count_if(curves_, [](const auto& c) { return !c.root_uvs.empty(); });
        if (has_uvs == std::ssize(curves_))
            join(&AlembicCurves::root_uvs, set_.root_uvs);
        else if (has_uvs > 0)
            set_.warnings.emplace_back(
                "groom_root_uv: left out, since some of the curves have none");
        joinGroups();
        // Guides are often objects of their own, and the other objects don't have the parameter.
        const bool has_guides = std::ranges::any_of(
            curves_, [](const AlembicCurves& curves) { return !curves.guides.empty(); });
        for (AlembicCurves& curves : curves_)
            if (has_guides && curves.guides.empty()) curves.guides.resize(curves.strands, 0);
        join(&AlembicCurves::guides, set_.guides);
    }

    // Strands without a group become a group of their own.
    void joinGroups() {
        if (std::ranges::all_of(curves_, [](const auto& c) { return c.groups.empty(); })) return;
        std::vector<StrandRange> without;
        std::uint32_t first = 0;
        for (AlembicCurves& curves : curves_) {
            if (curves.groups.empty()) {
                without.push_back({first, curves.strands});
                curves.groups.resize(curves.strands);
            }
            first += curves.strands;
        }
        join(&AlembicCurves::groups, set_.groups);
        completeGroups(set_, without);
    }

    AlembicValues values_;
    StrandSet set_;
    std::uint64_t hidden_ = 0;  // strands
    std::vector<AlembicCurves> curves_;
    std::uint64_t shared_ = 0;  // bytes of points and triangles that were read
    std::map<std::string, std::int32_t> group_names_;
    std::set<std::string> left_out_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> clocks_;  // time sampling, samples
    std::string first_moving_;
    std::size_t moving_ = 0;  // objects
    std::uint32_t most_samples_ = 0;
};

}  // namespace

StrandSet importAlembic(const StrandFile& file) { return AlembicReader(file.bytes).read(); }

StrandSamples importAlembicCache(const StrandFile& file) {
    AlembicReader first(file.bytes);
    const StrandSet strands = first.read();
    StrandSamples samples{
        .ends = strands.ends,
        .times = first.times(),
        .points = {},
        .metres_per_unit = strands.metres_per_unit};
    const std::uint64_t count = strands.points.size();
    if (count * samples.times.size() > kMostSampleBytes / sizeof(glm::vec3))
        failAt(0, "its samples have more than 2 GiB of points");
    samples.points.reserve(count * samples.times.size());
    for (std::uint32_t i = 0; i < samples.times.size(); ++i) {
        const StrandSet now = AlembicReader(file.bytes, i).read();
        if (now.ends != strands.ends) {
            std::ostringstream text;
            text << "at sample " << i << " (" << samples.times[i] << " s) there are "
                 << now.strandCount() << " strands with " << now.points.size() << " points, but "
                 << strands.strandCount() << " with " << count
                 << " at first, or other numbers of points: strands that change don't play";
            failAt(0, text.str());
        }
        samples.points.insert(samples.points.end(), now.points.begin(), now.points.end());
    }
    requireFinite(samples.points, 0, "a point of a sample");
    return samples;
}

}  // namespace hair::groom
