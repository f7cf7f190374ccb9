// The rendered image with kSamples samples per pixel.
#extension GL_EXT_samplerless_texture_functions : require

layout(binding = 0) uniform texture2DMS rendered;

vec4 renderedSample(ivec2 pixel, int sample_index) {
    return texelFetch(rendered, pixel, sample_index);
}
