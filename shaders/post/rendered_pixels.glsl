// The rendered image with one sample per pixel.
#extension GL_EXT_samplerless_texture_functions : require

layout(binding = 0) uniform texture2D rendered;

vec4 renderedSample(ivec2 pixel, int) { return texelFetch(rendered, pixel, 0); }
