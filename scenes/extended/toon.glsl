// Hair of a cartoon: the colour in few steps of light, a highlight with an edge, dark where the
// hair turns away. docs/extending.md says what a model is given.

// @parameter bands 3 [1, 12] count: steps between shade and light
// @parameter shade_color (0.3, 0.12, 0.28) [0, 1] 1: factor of the hair's colour in the darkest step
// @parameter light_color (1, 0.9, 0.72) [0, 1] 1: factor of it in the brightest
// @parameter sharpness 60 [1, 1000] 1: exponent of the highlight, before it gets its edge
// @parameter shine 0.3 [0, 1] 1: strength of the highlight
// @parameter outline 0.3 [0, 1] 1: part of a strand's half width that is drawn dark

// A number in [0, 1] in steps.
float stepped(float value) { return floor(clamp(value, 0.0, 0.999) * bands) / max(bands - 1.0, 1.0); }

vec3 shadeHair(HairPoint point) {
    float lit = 0.0;
    float highlight = 0.0;
    for (uint i = 0u; i < lightCount(); ++i) {
        HairLight light = hairLight(point, i);
        float strength = light.visible * max(light.color.r, max(light.color.g, light.color.b));
        // Wrapped round, so that the step falls on the side and not in front.
        lit += strength * (0.5 + 0.5 * dot(point.normal, light.to_light));
        // The cone of mirrored light, Kajiya and Kay 1989.
        float cone = dot(point.tangent, normalize(light.to_light + point.to_eye));
        highlight += strength * pow(max(1.0 - cone * cone, 0.0), 0.5 * sharpness);
    }
    vec3 factor = mix(workingColor(shade_color), workingColor(light_color), stepped(lit));
    vec3 color = point.color * factor;
    color += shine * step(0.6, highlight) * (1.0 - color);
    return abs(point.across) > 1.0 - outline ? color * workingColor(shade_color) : color;
}
