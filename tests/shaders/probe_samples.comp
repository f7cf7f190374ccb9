#version 460
// Writes the sample positions of the back end `software`. One invocation.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "strands/software/samples.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform Push { SamplePlacesPush push; };

layout(buffer_reference, scalar) buffer PlacesReference { SamplePlaces all; };

void main() {
    PlacesReference reference = PlacesReference(push.places);
    for (uint i = 0u; i < kSamples; ++i) {
        reference.all.places[i] = samplePosition(i);
        reference.all.row_samples[i] = entry(rowSamples(), i);
        reference.all.row_places[i] = float(entry(rowPositions(), i)) / 16.0;
        reference.all.column_samples[i] = entry(columnSamples(), i);
        reference.all.column_places[i] = float(entry(columnPositions(), i)) / 16.0;
    }
}
