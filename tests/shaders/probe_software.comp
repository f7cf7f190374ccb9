#version 460
// Writes the sample positions of the back end `software`, and covers quads in the given order. One
// work group, whose invocations share each quad.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "strands/software/raster.glsl"

layout(local_size_x_id = kGroupConstant) in;

layout(buffer_reference, scalar) buffer PlacesReference { SamplePlaces all; };
layout(buffer_reference, scalar) readonly buffer QuadsReference { QuadProbe at[]; };

ScreenEnd screenEnd(QuadProbeEnd end) {
    return ScreenEnd(end.place, end.side, end.depth, end.side_depth, 1.0);
}

void main() {
    PlacesReference reference = PlacesReference(push.colors);
    for (uint i = 0u; i < kSamples; ++i) {
        reference.all.places[i] = samplePosition(i);
        reference.all.row_samples[i] = entry(rowSamples(), i);
        reference.all.row_places[i] = float(entry(rowPositions(), i)) / 16.0;
        reference.all.column_samples[i] = entry(columnSamples(), i);
        reference.all.column_places[i] = float(entry(columnPositions(), i)) / 16.0;
    }
    PictureParameters picture;  // only merged hairs need it
    for (uint i = 0u; i < push.strands; ++i) {
        QuadProbe probe = QuadsReference(push.list).at[i];
        PieceQuad quad =
            PieceQuad(screenEnd(probe.from), screenEnd(probe.to), vec2(0.0, 1.0), true);
        RasterQuad raster = setUpQuad(quad);
        RowShare share =
            shareOfGroup(raster, int(gl_LocalInvocationID.x), int(gl_WorkGroupSize.x));
        rasterizeRows(picture, raster, share, probe.number);
    }
}
