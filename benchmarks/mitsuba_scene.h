#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace benchmarks {

// What lies beside a Mitsuba scene.
struct MitsubaParts {
    struct Mesh {
        std::string file;
        std::size_t triangles = 0;
        glm::vec3 color{0.0f};  // display RGB
        float metallic = 0.0f;
        float roughness = 1.0f;
        std::string texture;  // instead of the colour; empty: none
        std::string wrap = "repeat";  // Mitsuba's: also "mirror", "clamp"
        bool two_sided = false;  // seen from behind too
    };
    std::string hair_file;  // empty: no hair
    std::vector<Mesh> meshes;
    std::string environment_file;  // empty: no environment
};

// A scene of Mitsuba 3 with the settings' camera, background and lights. Hair is Mitsuba's `hair`
// (Chiang et al. 2016) with the settings' absorption, roughnesses, tilt and index; nothing else of
// our shading is in it. The background is a light too, of the same radiance from everywhere. Pixels
// are means over their squares (a box filter), as in our supersampling. Samples a pixel: the
// parameter `spp`.
void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts);

}  // namespace benchmarks
