// Standard sample positions: Vulkan specification, Multisampling. A pixel is divided into as many
// rows, and as many columns, as it has samples, with one sample in each. Tables hold sixteenths of
// a pixel or indices of samples, four bits each, the first lowest.
#ifndef HAIRBENCH_SOFTWARE_SAMPLES_GLSL
#define HAIRBENCH_SOFTWARE_SAMPLES_GLSL

#include "strands/pixel_margin.glsl"

// Returns the entry for the pipeline's number of samples.
uint bySamples(uint of_1, uint of_2, uint of_4, uint of_8) {
    return kSamples == 1u ? of_1 : kSamples == 2u ? of_2 : kSamples == 4u ? of_4 : of_8;
}

uint entry(uint table, uint index) { return table >> (4u * index) & 15u; }

// The position along a row of its sample, and the sample's index.
uint rowPositions() { return bySamples(0x8u, 0xC4u, 0xA2E6u, 0xB37D195Fu); }
uint rowSamples() { return bySamples(0x0u, 0x01u, 0x3210u, 0x64125037u); }
// The position along a column of its sample, and the sample's index.
uint columnPositions() { return bySamples(0x8u, 0xC4u, 0x6E2Au, 0x19F5B3D7u); }
uint columnSamples() { return bySamples(0x0u, 0x01u, 0x1302u, 0x72601345u); }

// The position of a sample in its pixel, px.
vec2 samplePosition(uint index) {
    uint x = bySamples(0x8u, 0x4Cu, 0xA2E6u, 0xFB135D79u);
    uint y = bySamples(0x8u, 0x4Cu, 0xEA62u, 0x1F7D39B5u);
    return vec2(entry(x, index), entry(y, index)) / 16.0;
}

#endif
