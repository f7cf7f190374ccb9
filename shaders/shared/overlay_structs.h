#ifndef HAIRBENCH_OVERLAY_STRUCTS_H
#define HAIRBENCH_OVERLAY_STRUCTS_H

// Data that the overlays' host and shader code share. Scalar layout; addresses are device
// addresses.

// A line of a body's wire frame.
struct BodyLine {
    vec3 from;  // m
    vec3 to;
    uint moves;  // 1: moves with the picture's head
};

// Push constants of overlay/*.
struct OverlayPush {
    Address picture;  // PictureParameters
    Address lines;  // BodyLine [line]; read by overlay/bodies.vert
    vec3 color;
};

#endif
