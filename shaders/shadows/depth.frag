#version 460
// Writes only depth.
void main() {}
