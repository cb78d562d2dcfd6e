// The camera's image at a pixel of the picture, sRGB-encoded. RECTIFIED: the image has the pixels
// of the picture already.

#ifdef RECTIFIED
uniform sampler2D image;

vec2 RawPixel() { return gl_FragCoord.xy - 0.5; }

vec3 Background(vec2 raw) { return texelFetch(image, ivec2(raw), 0).rgb; }
#else
#include "camera.glsl"

uniform bool has_image;
uniform sampler2D image;  // not rectified
uniform vec4 display_intrinsics;
uniform vec4 camera_intrinsics;
uniform vec4 camera_distortion;

// The position in the camera's image, pixels.
vec2 RawPixel() {
  vec2 plane = PlaneFromPixel(gl_FragCoord.xy - 0.5, display_intrinsics);
  return has_image ? PixelFromPlane(plane, camera_intrinsics, camera_distortion)
                   : gl_FragCoord.xy - 0.5;
}

vec3 Background(vec2 raw) {
  vec2 position = (raw + 0.5) / vec2(textureSize(image, 0));
  bool inside = all(greaterThan(position, vec2(-1e-4))) && all(lessThan(position, vec2(1.0001)));
  return has_image && inside ? textureLod(image, position, 0.0).rgb : vec3(0.0);
}
#endif
