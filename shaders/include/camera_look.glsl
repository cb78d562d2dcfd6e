// People as the camera would have taken them: as soft as its lens makes things, smeared by
// its own motion, and as noisy as its sensor. The camera's image has all this already.

uniform sampler2D people;     // linear light times coverage, coverage; bottom row first
uniform vec4 people_bounds;   // left, bottom, right, top: nothing is drawn outside
uniform vec4 smeared_bounds;  // the same with what spreads beyond

// Where a pixel's ray met people's distance one frame ago, and since: homographies of
// pixels (from the bottom row) for a plane across the view.
uniform mat3 previous_from_pixel;
uniform float shutter;  // 0: nothing smears
uniform float lens_variance;  // square pixels

uniform int noise_is_on;
uniform vec2 noise;       // floor^2, slope of the variance
uniform int noise_frame;

const float kLongestSmear = 24.0;  // pixels
// Along the motion, and across it, of a Gaussian to twice its deviation.
const int kAlong = 13;
const int kAcross = 5;

vec4 PeopleAt(vec2 cell) {
  bool there = all(greaterThan(cell, people_bounds.xy)) && all(lessThan(cell, people_bounds.zw));
  return there ? textureLod(people, cell / vec2(textureSize(people, 0)), 0.0) : vec4(0.0);
}

vec2 Motion(vec2 cell) {
  vec3 before = previous_from_pixel * vec3(cell, 1.0);
  vec2 motion = shutter * (cell - before.xy / before.z);
  return motion * min(1.0, kLongestSmear * inversesqrt(max(dot(motion, motion), 1e-12)));
}

// A Gaussian with the variance of the lens, and along the motion that of its box as well.
vec4 SmearedPeople(vec2 cell) {
  vec2 motion = shutter > 0.0 ? Motion(cell) : vec2(0.0);
  float along_variance = lens_variance + dot(motion, motion) / 12.0;
  int along = along_variance > 1e-4 ? kAlong : 1;
  int across = lens_variance > 1e-4 ? kAcross : 1;
  float length2 = dot(motion, motion);
  vec2 axis = length2 > 1e-8 ? motion * inversesqrt(length2) : vec2(1.0, 0.0);
  // Steps over +-2.2 deviations.
  float step_along = 4.4 * sqrt(along_variance) / float(kAlong - 1);
  float step_across = 4.4 * sqrt(lens_variance) / float(kAcross - 1);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < along; ++i) {
    float u = step_along * (float(i) - 0.5 * float(along - 1));
    for (int k = 0; k < across; ++k) {
      float v = step_across * (float(k) - 0.5 * float(across - 1));
      float weight = exp(-0.5 * (u * u / max(along_variance, 1e-6) + v * v / max(lens_variance, 1e-6)));
      sum += weight * PeopleAt(cell + u * axis + v * vec2(-axis.y, axis.x));
      weights += weight;
    }
  }
  return sum / weights;
}

// Jarzynski & Olano, "Hash Functions for GPU Rendering", JCGT 2020: pcg3d.
uvec3 Hash(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

// Normal numbers of a pixel (Box & Muller 1958), one for each channel.
vec3 NormalNumbers(ivec2 cell) {
  uvec3 place = uvec3(uint(cell.x), uint(cell.y), uint(noise_frame));
  vec3 a = (vec3(Hash(place) >> 8u) + 0.5) / 16777216.0;
  vec3 b = vec3(Hash(place + uvec3(0u, 0u, 0x80000000u)) >> 8u) / 16777216.0;
  return sqrt(-2.0 * log(a)) * cos(6.28318531 * b);
}

vec3 CameraNoise(vec3 encoded, ivec2 cell) {
  return sqrt(max(noise.x + noise.y * encoded, 0.0)) * NormalNumbers(cell);
}
