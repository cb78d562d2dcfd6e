// Converts a cell of the picture and its depth to a point in stage axes. Cells count from the
// bottom row.

uniform vec3 eye_in_stage;
uniform vec3 ray_at_corner;  // ray through the picture's corner, one metre deep
uniform vec3 ray_per_column;
uniform vec3 ray_per_row;
uniform vec2 near_far;

vec3 RayThrough(ivec2 cell) {
  vec2 at = vec2(cell) + 0.5;
  return ray_at_corner + at.x * ray_per_column + at.y * ray_per_row;
}

// Converts a value of the depth buffer to metres along the camera's axis.
float DepthInMetres(float buffered) {
  float clip = 2.0 * buffered - 1.0;
  return 2.0 * near_far.x * near_far.y /
         (near_far.y + near_far.x - clip * (near_far.y - near_far.x));
}

vec3 SurfacePoint(ivec2 cell, float depth) { return eye_in_stage + depth * RayThrough(cell); }
