#include "benchmarks/groom_info.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/json_fwd.h"

namespace benchmarks {
namespace {

// JSON has no NaN and no infinity.
void put(Json& object, const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
}

Json toJson(const hair::Spread& spread, std::string_view unit, double factor = 1.0) {
    Json object = {{"unit", unit}};
    put(object, "minimum", spread.minimum * factor);
    put(object, "quartile1", spread.quartile1 * factor);
    put(object, "median", spread.median * factor);
    put(object, "quartile3", spread.quartile3 * factor);
    put(object, "maximum", spread.maximum * factor);
    put(object, "mean", spread.mean * factor);
    return object;
}

Json toJson(const glm::vec3& point, double metres_per_unit) {
    const glm::dvec3 p = glm::dvec3(point) * metres_per_unit;
    return {p.x, p.y, p.z};
}

template <class Value>
const char* whereKnown(const hair::PointAttribute<Value>& attribute) {
    if (!attribute.known()) return "none";
    return attribute.values.empty() ? "everywhere" : "points";
}

Json toJson(const hair::MeshFindings& mesh) {
    Json object = {
        {"tolerance", {{"unit", "m"}, {"value", mesh.tolerance}}},
        {"root_distances", toJson(mesh.root_distances, "m")},
        {"roots_off_surface", mesh.roots_off_surface},
        {"closed", mesh.not_closed.empty()}};
    if (!mesh.not_closed.empty()) object["not_closed"] = mesh.not_closed;
    if (mesh.strands_inside) object["strands_inside"] = *mesh.strands_inside;
    if (mesh.points_inside) object["points_inside"] = *mesh.points_inside;
    if (mesh.deepest) object["deepest"] = {{"unit", "m"}, {"value", *mesh.deepest}};
    return object;
}

void putLengths(Json& object, const GroomInfo& info) {
    const hair::StrandFindings& found = info.findings;
    const double scale = found.metres_per_unit;
    object["unit"] = {
        {"name", found.unit},
        {"metres", scale},
        {"stated", found.unit_stated},
        {"reason", found.unit_reason}};
    object["bounding_box"] = {
        {"unit", "m"},
        {"minimum", toJson(found.minimum, scale)},
        {"maximum", toJson(found.maximum, scale)}};
    object["lengths"] = toJson(found.lengths, "m", scale);
    object["segment_lengths"] = toJson(found.segment_lengths, "m", scale);
    if (info.strands.widths.known()) object["widths"] = toJson(found.widths, "m", scale);
}

}  // namespace

std::string groomInfoJson(const GroomInfo& info) {
    const hair::StrandFindings& found = info.findings;
    Json object = {{"schema", kGroomSchema}, {"file", info.file.string()}, {"format", info.format}};
    if (!info.strands.comment.empty()) object["comment"] = info.strands.comment;
    object["strands"] = found.strands;
    object["points"] = found.points;
    if (found.strands > 0) {
        object["points_per_strand"] = toJson(found.points_per_strand, "count");
        putLengths(object, info);
    }
    object["has"] = {
        {"widths", whereKnown(info.strands.widths)},
        {"transparencies", whereKnown(info.strands.transparencies)},
        {"colors", whereKnown(info.strands.colors)},
        {"root_uvs", !info.strands.root_uvs.empty()},
        {"root_triangles", info.strands.root_triangles.size()}};
    object["single_point_strands"] = found.single_point_strands;
    object["zero_length_strands"] = found.zero_length_strands;
    object["zero_length_segments"] = found.zero_length_segments;
    object["duplicate_strands"] = found.duplicate_strands;
    object["duplicate_roots"] = found.duplicate_roots;
    if (found.mesh) object["mesh"] = toJson(*found.mesh);
    object["left_out"] = info.strands.warnings;
    Json& odd = object["odd"] = Json::array();
    for (const Oddity& each : info.oddities)
        odd.push_back(
            {{"name", each.name},
             {"count", each.count},
             {"what", each.what},
             {"advice", each.advice}});
    // What files say of themselves need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
