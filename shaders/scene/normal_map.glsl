// Normals from normal maps.
#ifndef HAIRBENCH_NORMAL_MAP_GLSL
#define HAIRBENCH_NORMAL_MAP_GLSL

// `texel` is a normal with x towards growing u, y towards falling v and z outwards (glTF 2.0,
// section 3.9.3). The tangent is the triangle's, from screen-space derivatives. Vertex tangents
// (MikkTSpace) would be smoother.
vec3 mappedNormal(vec3 normal, vec3 position, vec2 coordinates, vec3 texel) {
    vec3 position_x = dFdx(position);
    vec3 position_y = dFdy(position);
    vec2 coordinates_x = dFdx(coordinates);
    vec2 coordinates_y = dFdy(coordinates);
    float turn = coordinates_x.x * coordinates_y.y - coordinates_y.x * coordinates_x.y;
    vec3 along_u = (position_x * coordinates_y.y - position_y * coordinates_x.y) * sign(turn);
    vec3 along_v = (position_y * coordinates_x.x - position_x * coordinates_y.x) * sign(turn);
    vec3 tangent = along_u - normal * dot(normal, along_u);
    if (dot(tangent, tangent) == 0.0) return normal;
    tangent = normalize(tangent);
    vec3 bitangent = cross(normal, tangent);
    if (dot(bitangent, along_v) > 0.0) bitangent = -bitangent;  // the texture is mirrored
    return normalize(texel.x * tangent + texel.y * bitangent + texel.z * normal);
}

#endif
