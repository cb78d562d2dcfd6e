// People as the camera would have recorded them: with the softness of its lens, the blur of its own
// motion and the noise of its sensor. The camera's image contains all this already.

uniform sampler2D people;     // linear light times coverage, coverage; bottom row first
uniform vec4 smeared_bounds;  // left, bottom, right, top; no people outside, blur included

// Homography to pixels of one frame ago, for a plane across the view at the distance of people.
// Rows of both count from the bottom.
uniform mat3 previous_from_pixel;
uniform float shutter;  // 0: no motion blur
// Number of equally weighted taps along the motion and across it.
uniform ivec2 taps;
uniform float lens_spread;      // length covered by the taps without motion, pixels
uniform float lens_variance12;  // 12 times the lens's variance, the squared length of an equal box
uniform float tap_stretch;      // factor that gives the taps the variance of the box

uniform int noise_is_on;
uniform vec2 noise;             // variance: floor^2, slope
uniform sampler2D noise_tile;   // normal numbers n as (1 + n / kNoiseRange) / 2
uniform vec2 noise_offset;      // offset for this frame, texels

const float kLongestSmear = 24.0;  // pixels
const float kNoiseRange = 4.0;

vec4 PeopleAt(vec2 cell) { return textureLod(people, cell / vec2(textureSize(people, 0)), 0.0); }

vec2 Motion(vec2 cell) {
  vec3 before = previous_from_pixel * vec3(cell, 1.0);
  vec2 motion = shutter * (cell - before.xy / before.z);
  return motion * min(1.0, kLongestSmear * inversesqrt(max(dot(motion, motion), 1e-12)));
}

// Averages people along the motion (the shutter's box, widened by the lens) and across it (the lens
// alone).
vec4 SmearedPeople(vec2 cell) {
  vec2 axis = vec2(1.0, 0.0);
  float spread = lens_spread;
  if (shutter > 0.0) {
    vec2 motion = Motion(cell);
    float length2 = dot(motion, motion);
    axis = length2 > 1e-8 ? motion * inversesqrt(length2) : axis;
    spread = tap_stretch * sqrt(length2 + lens_variance12);
  }
  vec2 along = spread / float(taps.x) * axis;
  vec2 across = lens_spread / float(taps.y) * vec2(-axis.y, axis.x);
  vec2 first = cell - 0.5 * (float(taps.x - 1) * along + float(taps.y - 1) * across);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < taps.x; ++i) {
    for (int k = 0; k < taps.y; ++k) {
      sum += PeopleAt(first + float(i) * along + float(k) * across);
    }
  }
  return sum / float(taps.x * taps.y);
}

// raw: pixel of the camera's image, so that the noise has the grain of the image as it is drawn.
vec3 CameraNoise(vec3 encoded, vec2 raw) {
  vec2 at = (raw + 0.5 + noise_offset) / vec2(textureSize(noise_tile, 0));
  vec3 normal = (2.0 * textureLod(noise_tile, at, 0.0).rgb - 1.0) * kNoiseRange;
  return sqrt(max(noise.x + noise.y * encoded, 0.0)) * normal;
}
