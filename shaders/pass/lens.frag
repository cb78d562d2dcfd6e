// One eye's part of a panel: each pixel shows the point of the picture that the eye sees there
// through the lens. Rows count from the top, in the panel and in the picture.

#include "camera.glsl"

uniform sampler2D picture;
uniform vec4 lens_intrinsics;
uniform vec3 radial[3];          // radial distortion for red, green and blue
uniform bool has_fringes;        // the three distortions differ
// Homography from the plane one metre in front of the eye to pixels of the picture.
uniform mat3 picture_from_eye;
uniform vec2 corner_px;          // corner of the eye's part in the panel

layout(location = 0) out vec4 colour;

// Returns black outside the picture; its edge is blended over one pixel.
vec3 PictureAt(vec2 at, vec3 k) {
  float r2 = dot(at, at);
  vec3 seen = picture_from_eye * vec3(at * (1.0 + r2 * (k.x + r2 * (k.y + r2 * k.z))), 1.0);
  vec2 size = vec2(textureSize(picture, 0));
  vec2 place = seen.xy / max(seen.z, 1e-6) + 0.5;
  vec2 within = min(place, size - place);
  float share = seen.z > 0.0 ? clamp(min(within.x, within.y) + 0.5, 0.0, 1.0) : 0.0;
  return share * textureLod(picture, place / size, 0.0).rgb;
}

void main() {
  vec2 at = PlaneFromPixel(gl_FragCoord.xy - 0.5 - corner_px, lens_intrinsics);
  vec3 seen = PictureAt(at, radial[1]);
  if (has_fringes) {
    seen.r = PictureAt(at, radial[0]).r;
    seen.b = PictureAt(at, radial[2]).b;
  }
  colour = vec4(seen, 1.0);
}
