#pragma once

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
        glm::vec3 color;  // display RGB
    };
    std::string hair_file;  // empty: no hair
    std::vector<Mesh> meshes;
};

// Of the fibres, along them and round them: Mitsuba's own default.
inline constexpr double kHairRoughness = 0.3;

// A scene of Mitsuba 3 with the settings' camera, background and light. Hair is Mitsuba's `hair`
// (Chiang et al. 2016), whose absorption is that of /shading/color; nothing else of our shading is
// in it. The background is a light too, of the same radiance from everywhere. Pixels are means over
// their squares (a box filter), as in our supersampling. Samples a pixel: the parameter `spp`.
void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts);

}  // namespace benchmarks
