#pragma once

#include <cstdint>
#include <string>

#include "hair/extension.h"

// Making strands from guides. settings.h has the other parameters and says how to add one.
namespace hair {

class Table;

enum class Backend {
    automatic,
    tessellation,
    pulling_geometry,
    lines,
    pulling,
    expanded,
    mesh,
    software
};
// Returns the name of a backend in scenes.
const char* backendName(Backend backend);

enum class Interpolation { multi, single, mixed };
enum class StrandCollision { none, push_out };
enum class Randomness { hashed, thesis };
enum class Curve { bspline, bspline_unpinned, catmull_rom };
enum class Taper { strand, segment };
enum class Submission { instanced, batched };
enum class StrandSource { root_triangles, groom };
enum class WidthSource { scene, groom };

// Curls of interpolated strands, in addition to their guides' curls: thesis 2.3.8.2.
struct StrandCurlSettings {
    float radius = 0.0f;
    float frequency = 60.0f;
    float frequency_variation = 0.2f;
    float start = 0.15f;
};

const Table& tableOf(const StrandCurlSettings*);

// Random offsets, computed once, of a fraction of the strands: thesis 2.3.8.3.
struct StrandVariationSettings {
    float amplitude = 0.0f;
    float frequency = 20.0f;
    float share = 0.5f;
    float start = 0.1f;
};

const Table& tableOf(const StrandVariationSettings*);

struct StrandSettings {
    Backend backend = Backend::automatic;
    StrandSource source = StrandSource::root_triangles;
    Interpolation interpolation = Interpolation::multi;
    float blend = 0.5f;
    bool collision_rule = false;
    StrandCollision collision = StrandCollision::none;
    Randomness randomness = Randomness::hashed;
    std::uint32_t density = 64;
    std::uint32_t tessellation = 4;
    WidthSource width = WidthSource::scene;
    float root_width = 0.002f;
    float tip_width = 0.0005f;
    StrandCurlSettings curl;
    StrandVariationSettings variation;
    std::string offsets;
    std::string offset_function;
    ExtensionParameters offset_parameters;
    float opacity = 1.0f;
    std::string texture;
    Curve curve = Curve::bspline;
    Taper taper = Taper::strand;
    float taper_start = 0.0f;
    Submission submission = Submission::instanced;
};

const Table& tableOf(const StrandSettings*);

}  // namespace hair
