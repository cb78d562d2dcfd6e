// The finished picture where people or their shadows are: the camera's image darker where they
// keep light off, people over it, encoded as sRGB. Light brighter than white is clipped. The
// target's top row comes first. LOOK: people are as noisy, soft and smeared as the image;
// without it software does not pay for what is off. SEE_THROUGH: what is real is behind the
// picture and not in it: people alone, times their coverage, and in alpha how much of what is
// behind they and their shadows hide.

#ifndef SEE_THROUGH
#include "background.glsl"
#endif
#include "camera_look.glsl"
#include "colour.glsl"

uniform sampler2D caught;      // what real surfaces keep of their light
uniform vec4 catcher_bounds;   // left, bottom, right, top of the layer: it means nothing outside
uniform float caught_step;     // of the layer's pixels, for one of caught
// Of the layer, which has people and shadows; from a plane that both see, where it was drawn for
// an earlier picture. Its rows count from the bottom.
uniform mat3 layer_from_pixel;
uniform float people_opacity;  // of people and of what they do to the light

layout(location = 0) out vec4 colour;

bool Within(vec2 cell, vec4 bounds) {
  return all(greaterThan(cell, bounds.xy)) && all(lessThan(cell, bounds.zw));
}

void main() {
  vec3 in_layer = layer_from_pixel * vec3(gl_FragCoord.xy, 1.0);
  vec2 cell = in_layer.xy / in_layer.z;
  bool may_show = Within(cell, smeared_bounds);
#ifdef LOOK
  // Loops instead of ifs where they leave out much: shaders/include/sun.glsl.
  vec4 person = vec4(0.0);
  int shows = may_show ? 1 : 0;
  for (int i = 0; i < shows; ++i) {
    person = SmearedPeople(cell);
  }
#else
  vec4 person = may_show ? PeopleAt(cell) : vec4(0.0);
#endif
  vec2 at = (cell - 0.5 * (caught_step - 1.0)) / caught_step;
  at = clamp(at, floor(catcher_bounds.xy / caught_step) + 0.5,
             ceil(catcher_bounds.zw / caught_step) - 0.5);
  vec3 kept = textureLod(caught, at / vec2(textureSize(caught, 0)), 0.0).rgb;
  kept = Within(cell, catcher_bounds) ? kept : vec3(1.0);
  person *= people_opacity;
  kept = mix(vec3(1.0), kept, people_opacity);
#ifdef SEE_THROUGH
  // One number stands for what is kept of all colours; what is real cannot be brightened.
  float left = min(dot(kept, vec3(0.2126, 0.7152, 0.0722)), 1.0) * (1.0 - person.a);
  colour = vec4(SrgbFromLinear(clamp(person.rgb, 0.0, 1.0)), 1.0 - left);
#else
  vec2 raw = RawPixel();
  vec3 encoded = Background(raw);
  vec3 light = LinearFromSrgb(encoded) * kept * (1.0 - person.a) + person.rgb;
  bool changes = person.a > 0.0 || any(notEqual(kept, vec3(1.0)));
  encoded = changes ? SrgbFromLinear(clamp(light, 0.0, 1.0)) : encoded;
#ifdef LOOK
  int noisy = person.a > 0.0 ? noise_is_on : 0;
  for (int i = 0; i < noisy; ++i) {
    encoded += sqrt(person.a) * CameraNoise(encoded, raw);
  }
#endif
  colour = vec4(encoded, 1.0);
#endif
}
