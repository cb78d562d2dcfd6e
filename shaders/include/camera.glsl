// Intrinsics of a camera are (fx, fy, cx, cy) in pixels; integer coordinates are pixel centres.
// Distortion is (k1, k2, p1, p2) as in shared/geometry/camera_model.h.

vec2 PlaneFromPixel(vec2 pixel, vec4 intrinsics) {
  return (pixel - intrinsics.zw) / intrinsics.xy;
}

vec2 PixelFromPlane(vec2 plane, vec4 intrinsics, vec4 distortion) {
  float r2 = dot(plane, plane);
  float radial = 1.0 + r2 * (distortion.x + r2 * distortion.y);
  vec2 p = distortion.zw;
  vec2 tangential = 2.0 * plane.x * plane.y * p + p.yx * (r2 + 2.0 * plane * plane);
  return intrinsics.xy * (plane * radial + tangential) + intrinsics.zw;
}
