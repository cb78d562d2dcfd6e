// The finished picture: the camera's image as an undistorted pinhole sees it
// (each pixel looks up where the camera saw its ray), darker where people keep light
// off, people over it, encoded as sRGB. Light brighter than white is clipped. The
// target's top row comes first. LOOK: people are as noisy, soft and smeared as the image;
// without it software does not pay for what is off.

#include "camera.glsl"
#include "camera_look.glsl"
#include "caught_shadow.glsl"
#include "colour.glsl"

uniform bool has_image;
uniform sampler2D image;  // raw, decoded to linear light
uniform vec4 display_intrinsics;
uniform vec4 camera_intrinsics;
uniform vec4 camera_distortion;

layout(location = 0) out vec4 colour;

// Of the camera's image.
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

bool Within(vec2 cell, vec4 bounds) {
  return all(greaterThan(cell, bounds.xy)) && all(lessThan(cell, bounds.zw));
}

void main() {
  vec2 raw = RawPixel();
  vec2 cell = vec2(gl_FragCoord.x, float(textureSize(people, 0).y) - gl_FragCoord.y);
  vec3 light = Background(raw);
#ifdef LOOK
  vec4 person = vec4(0.0);
  // Loops instead of ifs: shaders/include/sun.glsl.
  int may_show = Within(cell, smeared_bounds) ? 1 : 0;
  for (int i = 0; i < may_show; ++i) {
    person = SmearedPeople(cell);
  }
#else
  vec4 person = Within(cell, smeared_bounds) ? PeopleAt(cell) : vec4(0.0);
#endif
  // People hide what is behind them, shadows too.
  int may_catch = Within(cell, catcher_bounds) && person.a < 0.999 ? 1 : 0;
  for (int i = 0; i < may_catch; ++i) {
    light *= CaughtShadow(ivec2(cell));
  }
  light = light * (1.0 - person.a) + person.rgb;
  vec3 encoded = SrgbFromLinear(clamp(light, 0.0, 1.0));
#ifdef LOOK
  int noisy = person.a > 0.0 ? noise_is_on : 0;
  for (int i = 0; i < noisy; ++i) {
    encoded += sqrt(person.a) * CameraNoise(encoded, raw);
  }
#endif
  colour = vec4(encoded, 1.0);
}
