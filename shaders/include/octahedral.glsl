// The position of a direction in an octahedral map about +Y (shared/render/passes/sky_cones.h).

vec2 OctahedralPosition(vec3 direction) {
  vec3 d = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  vec2 side = vec2(d.x < 0.0 ? -1.0 : 1.0, d.z < 0.0 ? -1.0 : 1.0);
  vec2 at = d.y < 0.0 ? (1.0 - abs(d.zx)) * side : d.xz;
  return 0.5 * at + 0.5;
}
