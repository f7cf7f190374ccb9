// The part of a pixel that a straight strand covers, exactly. Across the strand, the pixel's square
// is the convolution of two boxes. Their widths are the changes of the distance from the strand's
// middle from pixel to pixel along x and along y. Duff 1989, Polygon scan conversion by exact
// convolution, does the same for edges.
#ifndef HAIRBENCH_COVERAGE_GLSL
#define HAIRBENCH_COVERAGE_GLSL

struct PixelFilter {
    vec2 widths;  // of the boxes
    float reach;  // the filter is 0 beyond this distance
};

// The filter of a pixel at a distance from the strand's middle, in any unit.
PixelFilter pixelFilter(float offset) {
    vec2 widths = abs(vec2(dFdx(offset), dFdy(offset)));
    float widest = max(max(widths.x, widths.y), 1e-12);
    // A vertical or horizontal strand has a box of zero width. A blur of 1/50 px keeps the
    // following exact to 1e-5.
    widths = max(widths, vec2(0.02 * widest));
    return PixelFilter(widths, 0.5 * (widths.x + widths.y));
}

// Distances from the four corners of the filter's trapezoid to x; 0 if x is before the corner.
vec4 beyondCorners(PixelFilter pixel, float x) {
    float difference = 0.5 * (pixel.widths.x - pixel.widths.y);
    vec4 corners = vec4(-pixel.reach, -difference, difference, pixel.reach);
    return max(vec4(clamp(x, -pixel.reach, pixel.reach)) - corners, 0.0);
}

const vec4 kTrapezoid = vec4(1.0, -1.0, -1.0, 1.0);

// The filter's integral from -infinity to x.
float filterBelow(PixelFilter pixel, float x) {
    vec4 beyond = beyondCorners(pixel, x);
    return dot(kTrapezoid, beyond * beyond) / (2.0 * pixel.widths.x * pixel.widths.y);
}

// The integral of filterBelow() from -infinity to x.
float filterBelowIntegral(PixelFilter pixel, float x) {
    vec4 beyond = beyondCorners(pixel, x);
    float inside = dot(kTrapezoid, beyond * beyond * beyond);
    return inside / (6.0 * pixel.widths.x * pixel.widths.y) + max(x - pixel.reach, 0.0);
}

float pixelCoverage(PixelFilter pixel, float offset, float half_width) {
    return filterBelow(pixel, offset + half_width) - filterBelow(pixel, offset - half_width);
}

// The position across the strand, -1 to 1, that represents what the pixel sees of it. It divides
// the coverage of a row of pixels in the same ratio as the strand's width. Wide strands keep their
// own position. For thin strands, the mean over pixels, weighted by coverage, equals the mean over
// the width for any shading.
float pixelAcross(PixelFilter pixel, float offset, float half_width) {
    float half_seen = max(half_width, 0.05 * pixel.reach);  // thinner strands are treated as this
                                                            // wide
    float covered = filterBelowIntegral(pixel, offset + half_seen) -
                    filterBelowIntegral(pixel, offset - half_seen);
    return clamp(covered / half_seen - 1.0, -1.0, 1.0);
}

#endif
