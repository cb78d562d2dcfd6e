// The camera's image as an undistorted pinhole sees it: each pixel of the
// display looks up where the camera saw its ray.

#include "camera.glsl"

uniform sampler2D image;  // raw, decoded to linear light
uniform vec4 display_intrinsics;
uniform vec4 camera_intrinsics;
uniform vec4 camera_distortion;
uniform vec2 display_size;

layout(location = 0) out vec4 colour;

void main() {
  vec2 pixel = vec2(gl_FragCoord.x, display_size.y - gl_FragCoord.y) - 0.5;  // y down
  vec2 plane = PlaneFromPixel(pixel, display_intrinsics);
  vec2 raw = PixelFromPlane(plane, camera_intrinsics, camera_distortion);
  vec2 position = (raw + 0.5) / vec2(textureSize(image, 0));
  bool inside = all(greaterThan(position, vec2(-1e-4))) && all(lessThan(position, vec2(1.0001)));
  colour = inside ? vec4(textureLod(image, position, 0.0).rgb, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}
