// The nearest real surfaces in the picture, where shadows may fall on them. Cells count
// from the bottom row.

uniform sampler2D surface_normal;  // stage axes, 0.5 n + 0.5; alpha: it receives shadows
uniform sampler2D surface_depth;
uniform vec4 catcher_bounds;  // left, bottom, right, top: elsewhere the above means nothing
uniform vec3 eye_in_stage;
uniform vec3 ray_at_corner;  // from the eye, one metre deep, through the picture's corner
uniform vec3 ray_per_column;
uniform vec3 ray_per_row;
uniform vec2 near_far;

// Pixels of the picture for each of the ratio's, in both directions.
const int kCoarse = 4;

vec3 RayThrough(ivec2 cell) {
  vec2 at = vec2(cell) + 0.5;
  return ray_at_corner + at.x * ray_per_column + at.y * ray_per_row;
}

// Along the camera's axis.
float SurfaceDepth(ivec2 cell) {
  float clip = 2.0 * texelFetch(surface_depth, cell, 0).r - 1.0;
  return 2.0 * near_far.x * near_far.y /
         (near_far.y + near_far.x - clip * (near_far.y - near_far.x));
}

vec3 SurfacePoint(ivec2 cell, float depth) { return eye_in_stage + depth * RayThrough(cell); }

vec3 SurfaceNormal(vec4 texel) { return normalize(2.0 * texel.xyz - 1.0); }

// The cell that stands for a cell of the coarse image.
ivec2 CoarseSource(ivec2 coarse) {
  ivec2 low = ivec2(catcher_bounds.xy);
  ivec2 high = ivec2(catcher_bounds.zw) - 1;
  return clamp(coarse * kCoarse + kCoarse / 2, low, high);
}
