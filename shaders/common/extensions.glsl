// What the structs that C++ shares need; include it before them.
#ifndef HAIRBENCH_COMMON_EXTENSIONS_GLSL
#define HAIRBENCH_COMMON_EXTENSIONS_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#endif
