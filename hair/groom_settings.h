#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

// Parameters of the guides at rest. settings.h has the other parameters and says how to add one.
namespace hair {

class Table;

// Hair that turns round a point of the scalp, such as the crown.
struct WhorlSettings {
    glm::vec3 position{0.0f, 0.11f, -0.06f};
    float strength = 0.0f;
    float radius = 0.05f;
};

const Table& tableOf(const WhorlSettings*);

// Hair that is combed away from a line on the scalp.
struct PartingSettings {
    glm::vec3 from{0.0f, 0.09f, 0.09f};
    glm::vec3 to{0.0f, 0.115f, -0.02f};
    float strength = 0.0f;
    float reach = 0.03f;
};

const Table& tableOf(const PartingSettings*);

// Short, thin hairs on both sides of the scalp's edge.
struct VellusSettings {
    float share = 0.0f;
    float length = 0.012f;
    float width = 0.00003f;
    float band = 0.01f;
};

const Table& tableOf(const VellusSettings*);

enum class RootPlacement { poisson_disc, random };

// Guides grown on the scalp of a mesh.
struct GrowSettings {
    std::string mesh = "assets/head.glb";
    std::string scalp = "scalp";
    std::string mask;
    RootPlacement placement = RootPlacement::poisson_disc;
    std::uint32_t strands = 0;
    std::uint32_t vertices = 8;
    float length = 0.15f;
    std::string length_map;
    float length_variation = 0.0f;
    glm::vec3 comb{0.0f, 0.0f, 0.0f};
    float droop = 0.0f;
    WhorlSettings whorl;
    PartingSettings parting;
    VellusSettings vellus;
};

const Table& tableOf(const GrowSettings*);

// ---- Styling, in the order of application -------------------------------------------------------

// Gathers all strands and plaits them in three parts from there on.
struct BraidSettings {
    float pitch = 0.0f;
    glm::vec3 tie{0.0f, -0.07f, -0.115f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};
    float width = 0.03f;
    float length = 0.0f;
};

const Table& tableOf(const BraidSettings*);

struct ClumpSettings {
    float strength = 0.0f;
    float variation = 0.0f;
    float spacing = 0.02f;
    std::uint32_t levels = 1;
    float start = 0.1f;
};

const Table& tableOf(const ClumpSettings*);

struct WaveSettings {
    float amplitude = 0.0f;
    float frequency = 20.0f;
    float phase_variation = 0.0f;
    float spacing = 0.0f;
    float drift = 0.0f;
    float start = 0.2f;
};

const Table& tableOf(const WaveSettings*);

struct CurlSettings {
    float radius = 0.0f;
    float frequency = 40.0f;
    float phase_variation = 0.0f;
    float spacing = 0.0f;
    float drift = 0.0f;
    float start = 0.2f;
};

const Table& tableOf(const CurlSettings*);

struct FrizzSettings {
    float amplitude = 0.0f;
    float frequency = 60.0f;
    float start = 0.1f;
};

const Table& tableOf(const FrizzSettings*);

// Single strands that lie apart from the rest.
struct FlyawaySettings {
    float share = 0.0f;
    float reach = 0.015f;
    float start = 0.3f;
};

const Table& tableOf(const FlyawaySettings*);

struct CutSettings {
    float length = 0.0f;
    glm::vec3 point{0.0f, 0.0f, 0.0f};
    glm::vec3 normal{0.0f, 0.0f, 0.0f};
    float variation = 0.0f;
};

const Table& tableOf(const CutSettings*);

struct TaperSettings {
    float root_width = 0.0f;
    float tip_width = 0.0f;
    float start = 0.0f;
};

const Table& tableOf(const TaperSettings*);

struct StyleSettings {
    BraidSettings braid;
    ClumpSettings clump;
    WaveSettings wave;
    CurlSettings curl;
    FrizzSettings frizz;
    FlyawaySettings flyaways;
    float clearance = 0.0f;
    CutSettings cut;
    TaperSettings taper;
};

const Table& tableOf(const StyleSettings*);

// ---- Sources of guides --------------------------------------------------------------------------

// Maps a file's coordinates to the scene's: scales, then rotates about x, y and z in this order,
// then translates.
struct FilePlacementSettings {
    float scale = 1.0f;
    glm::vec3 rotation{0.0f, 0.0f, 0.0f};
    glm::vec3 translation{0.0f, 0.0f, 0.0f};
};

const Table& tableOf(const FilePlacementSettings*);

// ---- Brushes, after styling ---------------------------------------------------------------------

enum class BrushTool { comb, cut, lengthen, push, clump };

// A point on a stroke's path.
struct StrokePoint {
    glm::vec3 position{0.0f, 0.0f, 0.0f};
};

const Table& tableOf(const StrokePoint*);

// A brush stroke over the hair at rest.
struct StrokeSettings {
    BrushTool tool = BrushTool::comb;
    float radius = 0.03f;
    float strength = 0.5f;
    std::vector<StrokePoint> path;
};

const Table& tableOf(const StrokeSettings*);

enum class CacheMode { none, play, follow };

// Motion of guides from a file of strands with samples over time.
struct CacheSettings {
    CacheMode mode = CacheMode::none;
    std::string file;
    float strength = 1000.0f;
};

const Table& tableOf(const CacheSettings*);

struct GroomSettings {
    std::string file;
    std::uint32_t points_per_strand = 0;
    std::string mesh;
    FilePlacementSettings placement;
    std::uint32_t vertices = 0;
    std::uint32_t guides = 0;
    std::string groups;
    GrowSettings grow;
    StyleSettings style;
    std::vector<StrokeSettings> edits;
    std::string fixed;
    CacheSettings cache;
};

const Table& tableOf(const GroomSettings*);

}  // namespace hair
