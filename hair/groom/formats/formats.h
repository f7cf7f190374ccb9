#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// The readers and writers of formats of strands, which the tables in files.h list. Each format has
// a .cpp in this folder. Only formats with declarations for other code have headers of their own:
// npy.h, ply.h, usd_export.h and usd_import.h.
namespace hair::groom {

// ---- Cem Yuksel's HAIR --------------------------------------------------------------------------

// Cem Yuksel's hair models, cemyuksel.com/research/hairmodels. Little-endian: a header of 128
// bytes, then the arrays that its bits name, without padding:
//   uint16 segments[hair_count]           1 less than the strand's points
//   float32 points[point_count][3]
//   float32 thickness[point_count]        diameters
//   float32 transparency[point_count]
//   float32 colors[point_count][3]
// Without an array, the header's value holds everywhere. The format states no unit.

// Writes strands of 1 to 65,536 points, or of any number if all have the same. Unknown widths
// become a default thickness of 0, unknown colours white. Returns a warning for all data that is
// left out. Throws engine::Error if there are no strands or they are too long.
std::vector<std::string> exportHair(const StrandSet& strands, std::ostream& out);

// Refuses files that are not exactly of the format: no strands, no points, an unknown array,
// segments that don't add up to the points, a size that doesn't match the header (checked before
// any allocation), a number that is not finite. A thickness of 0 in the header means that widths
// are not known. Throws engine::Error "byte N: reason".
StrandSet importHair(const StrandFile& file);

// ---- TressFX ------------------------------------------------------------------------------------

// TressFX 4 (AMD, TressFXFileFormat.h), guide strands. Little-endian: a header of 160 bytes, which
// says where these arrays lie:
//   float32 positions[strands][vertices_per_strand][4]    xyz and inverse mass, 0 if fixed
//   float32 strand_uvs[strands][2]
//   float32 vertex_uvs[strands][vertices_per_strand][2]
//   float32 strand_thickness[strands]                     diameters
//   float32 vertex_colors[strands][vertices_per_strand][4]    RGB and alpha
// All except the positions may be absent. The format states no unit.
// Version 3 (TressFXFileFormat.h of TressFX 3.1) has a header of 296 bytes, positions of three
// floats and one more array, with each strand's guide. Version 2 is text:
//   version 2.0
//   scale 1.0, rotation 0 0 0, translation 0 0 0, bothEndsImmovable 0, maxNumVerticesInStrand 16,
//   numFollowHairsPerGuideHair 4, maxRadiusAroundGuideHair 0.5, numStrands 1, is sorted 1: a line
//   each strand 0 numVerts 16 texcoord 0.5 0.5, then its points, a line each

// Writes the arrays at multiples of 8 bytes. Each strand has one width, that of its root. Its
// first two vertices are fixed, as by AMD's exporters. Strands with differing numbers of points
// are resampled to a number that TressFX takes: 4, 8, 16, 32 or 64. Returns a warning for all data
// that is changed or left out. Throws engine::Error if there are no strands, or more bytes than
// 32-bit offsets reach.
std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out);

// Transparency is 1 - alpha. Inverse masses are left to TressFX; a warning reports fixed vertices
// beyond the first two, which TressFX always fixes, and texture coordinates of vertices. From
// earlier versions, which let TressFX make followers on loading, the strands of the file are read,
// and a warning reports the number of followers of each. Text with a transform is refused, because
// nothing states how it is applied. Refuses other versions, no strands, strands of less than 2
// vertices, arrays that overlap, lie outside the file (checked before any allocation) or not at a
// multiple of 4 bytes, numbers that are not finite. Throws engine::Error "byte N: reason", or
// "line N: reason".
StrandSet importTfx(const StrandFile& file);

// ---- The thesis's guides ------------------------------------------------------------------------

// The thesis's guide file. Little-endian, nothing between the parts:
//   int32 strands, int32 segments, int32 triangles
//   float32 points[strands][segments + 1][3]    m, root first
//   int32 root_triangles[triangles][3]          guide indices

// Writes points and root triangles; the format has no place for anything else. Strands with
// differing numbers of points, or with fewer than 2 or more than 256, are resampled. Returns a
// warning for all data that is changed or left out. Throws engine::Error if there are no strands,
// or too many of them.
std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out);

// Refuses files that are not exactly of the format: no strands, segments outside [1, 255], a size
// that doesn't match the counts (checked before any allocation), a point that is not finite, a
// triangle of a guide that isn't there. A triangle may name a guide twice: hair between two
// guides. Throws the first of the file's errors as engine::Error "byte N: reason".
StrandSet importHgl(const StrandFile& file);

// ---- OBJ ----------------------------------------------------------------------------------------

// Strands of a Wavefront OBJ file: its line elements, `l`, of vertices, `v x y z [r g b]`, root
// first.

// A StrandExporter's `write`. Numbers are the shortest decimals that give the same floats.
std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out);

// A StrandImporter's `read`. Consecutive elements of two points that continue each other become
// one strand, because some programs write only segments. The comment at the beginning of the file
// is kept. Everything except vertices and lines is skipped, faces with a warning.
StrandSet importObj(const StrandFile& file);

// ---- glTF ---------------------------------------------------------------------------------------

// Writes one LINES primitive, as importGltfStrands() reads it, and a node that scales to metres if
// the strands' unit is known to be another. Keeps StrandExporter's contract.
std::vector<std::string> exportGltf(const StrandSet& strands, std::ostream& out);  // data in JSON
std::vector<std::string> exportGlb(const StrandSet& strands, std::ostream& out);  // binary

// Reads strands of a glTF 2.0 file, .glb or .gltf: its line primitives. LINES are chained as
// polylines.h says; without indices, a line continues the previous one if it begins at its end.
// LINE_STRIP is root first. Points are POSITION under the node's transform, in metres. Widths are
// `_WIDTH`, scaled by the cube root of the transform's change of volume. COLOR_0 gives colours,
// and transparencies if there is no `_TRANSPARENCY`. Strands of hidden nodes are counted and left
// out; extras may have groups and guides. Other primitives are skipped with a warning. Errors begin
// with the mesh and primitive, the accessor, or the byte where JSON ends.
StrandSet importGltfStrands(const StrandFile& file);

// ---- Lists of strands ---------------------------------------------------------------------------

// Three formats of research on hair, which have counts and points but no header. They are
// little-endian and state no unit. Two list strand after strand:
//   int32 strands
//   for each strand: int32 points, then its points
// .data has points of float32[3]: USC-HairSalon (Hu et al. 2015, Single-view hair modeling using a
// hairstyle database), the Hair Photobooth (Paris et al. 2008) and models trained with them.
// .bin has points of float32[7]: position, tangent or colour, and a label that is always 0; CT2Hair
// (Shen et al. 2023, CT2Hair: high-fidelity 3D hair modeling using computed tomography).
// The third has the extension of Cem Yuksel's HAIR. MonoHair writes it (Wu et al. 2024, MonoHair:
// high-fidelity hair modeling from a monocular video):
//   uint32 strands, uint32 points of all strands
//   uint16 points[strands]     of each strand, not its segments
//   float32 points[points][3]

// Returns a warning for all data that is left out. Throws engine::Error if there are no strands or
// more of them than an int32 can hold.
std::vector<std::string> exportHairData(const StrandSet& strands, std::ostream& out);

// Strands without points are left out with a warning. Refuses files that are not exactly of the
// format: no strands with points, negative counts, counts that the file is too short for (checked
// before any allocation), trailing bytes, numbers that are not finite. Throws engine::Error "byte
// N: reason".
StrandSet importHairData(const StrandFile& file);

// Like CT2Hair's own reader, it leaves out strands with a position that is not a number and those
// of fewer than 5 points, with warnings; infinite positions are refused. Only the position of a
// point is read, because the file doesn't say whether a tangent or a colour follows it.
StrandSet importCt2Hair(const StrandFile& file);

// Whether a file that doesn't begin with "HAIR" can have as many strands as its first number says.
bool looksLikeCountedHair(std::span<const std::byte> head, std::uint64_t size);

// The sizes of the strands count; MonoHair's reader ignores the number of all points, so another
// one is only a warning. Refuses files that are longer or shorter than the sizes say (checked
// before the points are allocated) and files without a strand. Throws engine::Error "byte N:
// reason".
StrandSet importCountedHair(const StrandFile& file);

// ---- Embree's scenes ----------------------------------------------------------------------------

// The curves of a scene of Embree's tutorials (Intel, tutorials/common/scenegraph/xml_loader.cpp):
//   <scene>
//     <Curves basis="linear" type="flat">
//       <positions>x y z radius ...</positions>
//       <indices>first vertex of each segment ...</indices>    and perhaps <curveid>
//     </Curves>
//   </scene>
// The basis is linear, bezier, bspline, catmull_rom or, with <tangents>, hermite. Older names are
// LineSegments, ConeSegments, RoundLineSegments, BSplineHair, BSplineCurves, and, with a curve's
// number beside each index, Hair, BezierHair and BezierCurves. Arrays with `ofs` and `size` are in
// the file of the same name that ends in .bin. The format states no unit.

// Consecutive segments make a strand. Linear segments are their vertices. Cubic segments are
// sampled like those of USD, evenly in t, by the fewest points that give no strand fewer points
// than control vertices. Widths are twice the radii. Groups, transforms (a matrix, `translate` or
// `scale`) and references (`ref`) to nodes with an `id` or in an `assign` are followed. Other
// contents of the scene, and strands with a vertex that is NaN, are left out with a warning.
// Refuses other files, other bases, transforms in other forms, indices out of range, arrays of a
// wrong length, infinite numbers and references to over 256 MB, counted as often as they are
// followed. Throws engine::Error "line N: reason".
StrandSet importEmbreeXml(const StrandFile& file);

// ---- Alembic ------------------------------------------------------------------------------------

// The curves of an Alembic archive (Ogawa; AbcGeom_Curve_v2), in its world's space and its order.
// Alembic has no unit and no up axis; hairbench's own archives state the unit.
//   P, nVertices   of every object with curves; several are joined, each placed by the transforms
//                  (AbcGeom_Xform_v3) above it
//   curveBasisAndType   linear or cubic curves; without it linear ones
//   width          diameters; groom_width takes precedence
//   and the members of .arbGeomParams in Epic's "Using Alembic for Grooms" (version 1.5):
//   groom_root_uv (else uv, one for each curve), groom_group_id, groom_guide, groom_color;
//   groom_group_name, where there is no number: 0 for the first name, and so on.
//   groom_width, groom_group_id and groom_guide may also belong to the transforms above.
// A parameter has one value, one for each curve, or one for each vertex. The number of values
// decides, whatever the parameter's scope. It may have indices.

// Reads the first sample of moving data, with a warning. Cubic curves are sampled like those of
// USD: evenly in t, by the fewest points that give no curve fewer points than vertices. Bézier and
// B-spline curves are those of their vertices. Catmull-Rom curves run through all of their
// vertices, as Blender draws them. They run between the second vertex and the last but one only if
// each curve begins and ends with two vertices in one place, as RenderMan requires. Curves with
// knots, of any order to 16, follow their knots. Parameters that only some of the objects have are
// left out with a warning; objects without the guide parameter are no guides. Refuses archives that
// AlembicArchive refuses; closed curves, other bases (Hermite, power), weights that differ; counts
// that don't fit, values of other types, numbers that are not finite; projections. Throws
// engine::Error "byte N: path of the object or property: reason".
StrandSet importAlembic(const StrandFile& file);

// The strands of importAlembic() at all samples. All that moves must have samples at the same
// times.
StrandSamples importAlembicCache(const StrandFile& file);

// Strands as an Alembic archive (Ogawa): linear curves, "/hair/strands". importAlembic() reads
// them back equal to the last bit, except for transparencies, which have no place in it. Roots,
// groups, guides and colours are parameters with the names of Epic's "Using Alembic for Grooms"
// (version 1.5). The unit, the upward axis, root triangles and the comment are properties that
// only hairbench knows. Alembic has neither unit nor upward axis: points are written as they are.

// Equal strands make equal bytes: no date is written. Returns a warning for all data that is left
// out. Throws engine::Error if there are no strands, or one has 2^31 points.
std::vector<std::string> exportAlembic(const StrandSet& strands, std::ostream& out);
std::vector<std::string>
exportAlembicWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out);

using AlembicBounds = std::array<glm::dvec3, 2>;  // least, greatest corner

// The frames of a file, without their points.
struct AlembicMotion {
    double frame_time = 0.0;  // s
    std::vector<AlembicBounds> bounds;  // [frame]
    std::string keys;  // 16 bytes of a hash for each frame
};

// Writes moving strands a frame at a time, without keeping them: one sample per frame, the first at
// 0 s. No data is sought in the stream, so that a pipe will do.
class AlembicAnimation {
public:
    // Every frame has the data of `strands`, except for the points. Throws as exportAlembic() does,
    // and for a frame time of 0.
    AlembicAnimation(std::ostream& out, const StrandSet& strands, const FrameTiming& timing);

    // Writes the points of the next frame, as many as the strands have.
    void frame(std::span<const glm::vec3> points);
    // Ends the file, after the last frame.
    void finish();

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    std::uint64_t end() const;  // byte behind the points of all frames

    std::ostream* out_;
    StrandSet strands_;
    FrameTiming timing_;
    AlembicMotion motion_;
    std::uint64_t root_ = 0;
    std::vector<std::string> warnings_;
};

// ---- Mitsuba's hair -----------------------------------------------------------------------------

// Files of hair of the Mitsuba renderer, in two forms without a unit:
//   binary  of its plug-in `hair` (versions 0.5 and 0.6), little-endian: "BINARY_HAIR", uint32
//           vertices of all strands, then float32 x, y, z of each vertex. An infinite number before
//           a vertex begins a strand
//   text    a line "x y z" or "x y z radius" for each vertex. An empty line, or one that begins
//           with '#', is between strands. Three numbers are those of `hair`; four are those of
//           Mitsuba 3's `linearcurve` and `bsplinecurve`
// The text doesn't say which of the two curves it is for, so strands are the polylines of its
// vertices.

// Writes the binary form, without widths. Returns a warning for all data that is left out. Throws
// engine::Error if there are no strands.
std::vector<std::string> exportMitsubaBinary(const StrandSet& strands, std::ostream& out);

// Writes the text: with radii, which are half the widths, if widths are known. Numbers are the
// shortest decimals that give the same floats. Returns and throws as above.
std::vector<std::string> exportMitsubaText(const StrandSet& strands, std::ostream& out);

// Whether the first bytes are digits, as in a file in text.
bool looksLikeMitsubaText(std::span<const std::byte> head, std::uint64_t size);

// Reads both forms; widths are twice the radii. Refuses other files: a number of vertices that
// doesn't match the file's size (checked before any allocation), words that are not numbers, lines
// with more or fewer numbers than the first. Throws engine::Error "byte N: reason" or "line N:
// reason".
StrandSet importMitsubaHair(const StrandFile& file);

// ---- pbrt's scenes ------------------------------------------------------------------------------

// Curves of a scene of pbrt, versions 3 and 4 (Pharr, Jakob and Humphreys 2023, Physically based
// rendering, 4th edition, section 6.7, and pbrt-v4's file format):
//   Shape "curve" "string type" "cylinder" "string basis" "bezier" "integer degree" 3
//       "point3 P" [x y z ...] "float width0" 0.1 "float width1" 0.05
// The basis is bezier (the default) or bspline, uniform, of degree 3 (the default) or 2. Widths are
// diameters and change evenly with the curve's parameter; `width` is both. The format states no
// unit.

// Writes shapes to be named by an `Include` of a scene: each segment is a straight cubic Bézier
// segment. A strand is one shape if it has one width, otherwise a shape for each segment. Strands
// of one point are left out. Returns a sentence for all data that is left out. Throws engine::Error
// if no strand has two points.
std::vector<std::string> exportPbrt(const StrandSet& strands, std::ostream& out);

// Curves in the order of the file, placed by the transforms around them. A segment is sampled
// evenly in its parameter, by the fewest points that give no curve fewer points than vertices; a
// cubic Bézier segment with its inner vertices at its thirds is straight and has none between its
// ends. Bézier curves in successive shapes become one strand if each begins where the one before
// ends, with the same width, because some programs write only segments. The comment at the
// beginning is kept. Curves in objects (ObjectBegin) and included files are left out with a
// warning. If no curve has a width, widths are not known. Refuses other text, degrees and bases,
// numbers of vertices that make no curve, and curves after LookAt or CoordSysTransform. Throws
// engine::Error "line N: reason".
StrandSet importPbrt(const StrandFile& file);

}  // namespace hair::groom
