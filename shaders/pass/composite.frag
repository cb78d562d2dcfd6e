// The finished picture in the pixels of people and their shadows: the camera's image, darkened by
// the shadows, and people over it, encoded as sRGB. Light brighter than white is clipped. The
// target's top row comes first. LOOK: people get the noise, softness and motion blur of the image;
// it is a variant so that software renderers do not pay for it when it is off. SEE_THROUGH: the
// picture contains only people, times their coverage; alpha says how much they and their shadows
// hide of the real world behind it.

#ifndef SEE_THROUGH
#include "background.glsl"
#endif
#include "camera_look.glsl"
#include "colour.glsl"

uniform sampler2D caught;      // factor on the light of real surfaces
uniform vec4 catcher_bounds;   // left, bottom, right, top in the layer; caught is valid inside
uniform float caught_step;     // width and height of one pixel of caught, pixels of the layer
// Homography to pixels of the layer of people and shadows, whose rows count from the bottom. If the
// layer was drawn for an earlier picture, it is exact for one plane at the distance of people.
uniform mat3 layer_from_pixel;
// The time at which a pixel of the picture was exposed, in frame times after its middle, is the dot
// product with (x, y, 1); 0 without a rolling shutter. Meanwhile people move in the layer as by the
// homography to the pixels of a frame time ago.
uniform vec3 exposure_time;
uniform mat3 frame_ago;
uniform float people_opacity;  // opacity of people and of their shadows and light
#ifndef SEE_THROUGH
uniform int foreground_is_on;
uniform sampler2D foreground;  // RenderScene::foreground with the rays of the picture: r, g, b, offset
uniform vec2 picture_size;     // pixels
#endif

layout(location = 0) out vec4 colour;

bool Within(vec2 cell, vec4 bounds) {
  return all(greaterThan(cell, bounds.xy)) && all(lessThan(cell, bounds.zw));
}

void main() {
  vec3 in_layer = layer_from_pixel * vec3(gl_FragCoord.xy, 1.0);
  vec2 cell = in_layer.xy / in_layer.z;
  vec3 ago = frame_ago * vec3(cell, 1.0);
  cell -= dot(exposure_time, vec3(gl_FragCoord.xy, 1.0)) * (cell - ago.xy / ago.z);
  bool may_show = Within(cell, smeared_bounds);
#ifdef LOOK
  // Loops replace ifs that skip much work: see SeenPast in shaders/include/sun.glsl.
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
  float opacity = people_opacity;
#ifndef SEE_THROUGH
  vec2 raw = RawPixel();
  vec3 encoded = Background(raw);
  for (int i = 0; i < foreground_is_on; ++i) {
    vec4 guide = textureLod(foreground, gl_FragCoord.xy / picture_size, 0.0);
    opacity *= 1.0 - clamp(dot(guide, vec4(encoded, 1.0)), 0.0, 1.0);
  }
#endif
  person *= opacity;
  kept = mix(vec3(1.0), kept, opacity);
#ifdef SEE_THROUGH
  // Alpha is one number for all colours, and it cannot brighten the real world.
  float left = min(dot(kept, vec3(0.2126, 0.7152, 0.0722)), 1.0) * (1.0 - person.a);
  colour = vec4(SrgbFromLinear(clamp(person.rgb, 0.0, 1.0)), 1.0 - left);
#else
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
