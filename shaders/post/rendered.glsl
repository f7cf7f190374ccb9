// The rendered image, with one sample per pixel or, if HAIRBENCH_MULTISAMPLE is defined, with
// several.
#extension GL_EXT_samplerless_texture_functions : require

#ifdef HAIRBENCH_MULTISAMPLE
layout(binding = 0) uniform texture2DMS rendered;
#else
layout(binding = 0) uniform texture2D rendered;
#endif

// With one sample per pixel, `index` is the mip level 0; with several it is the sample.
vec4 renderedSample(ivec2 pixel, int index) { return texelFetch(rendered, pixel, index); }
