// Extensions that the structs shared with C++ need. Include this file before them.
#ifndef HAIRBENCH_COMMON_EXTENSIONS_GLSL
#define HAIRBENCH_COMMON_EXTENSIONS_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require

// A device address in two halves, the low half first. Not every device has 64-bit integers.
#define Address uvec2
const Address kNoAddress = Address(0u);

#endif
