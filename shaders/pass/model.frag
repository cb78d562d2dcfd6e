// Surfaces of people and props. COVERED: partly covered ones, drawn in two passes, the dense core
// and the fringe around it. LIT_AT_VERTICES: the vertex shader has computed the lighting.

#include "stripes.glsl"

uniform vec3 gain;   // exposure and the camera's gain
uniform float knee;  // knee of the camera's response, unused if the response is measured
uniform int response_is_measured;
uniform sampler2D response;  // light::SeenTable
uniform sampler2D sun_seen;  // shaders/pass/sun_seen.frag

uniform sampler2D colour_texture;  // colour times coverage, coverage
uniform vec3 emission;
uniform float alpha_cutoff;
uniform int fringe;
uniform vec4 mark;  // SceneMark: linear colour, share
uniform int mark_stripes;
uniform float mark_stripe_px;

in vec2 surface_uv;

layout(location = 0) out vec4 colour;

uniform float core_coverage;  // least coverage of the core

float Measured(float x, int channel) {
  float steps = float(textureSize(response, 0).x);
  float u = (x / (1.0 + x) * (steps - 1.0) + 0.5) / steps;
  return texture(response, vec2(u, 0.5))[channel];
}

// The measured response; or linear up to the knee, then an exponential shoulder with the same slope
// at the knee that reaches 1 at infinity.
vec3 CameraResponse(vec3 x) {
  if (response_is_measured == 1) {
    return vec3(Measured(x.r, 0), Measured(x.g, 1), Measured(x.b, 2));
  }
  float range = max(1.0 - knee, 1e-4);
  return min(x, knee) + range * (1.0 - exp(-max(x - knee, 0.0) / range));
}

float SunSeen() { return texelFetch(sun_seen, ivec2(gl_FragCoord.xy), 0).r; }

#ifdef LIT_AT_VERTICES
uniform int has_sun;
in vec3 matte_front;
in vec3 matte_back;
in vec3 matte_of_sun;  // negative: the sun lights the back
in vec3 highlight_front;
in vec3 highlight_of_sun;

void Reflected(vec4 texel, out vec3 matte, out vec3 highlight) {
  float seen = has_sun == 1 ? SunSeen() : 0.0;
  float side = gl_FrontFacing ? 1.0 : -1.0;
  matte = (gl_FrontFacing ? matte_front : matte_back) + seen * max(side * matte_of_sun, 0.0);
  matte *= texel.rgb / max(texel.a, 1.0 / 255.0);
  highlight = highlight_front + seen * highlight_of_sun;
#ifdef SURFACE_HAIR
  highlight *= sqrt(texel.rgb);  // most of it comes from inside the strands
#endif
#ifdef SURFACE_METAL
  highlight *= texel.rgb / max(texel.a, 1.0 / 255.0);
#endif
}
#else
in vec3 position_in_stage;
in vec3 normal_in_stage;
in vec3 surface_albedo;
// Centroid sampling, because extrapolation beyond the triangle can give invalid shares.
centroid in vec3 transferred;
centroid in vec3 transfer_share;
centroid in float transfer_open;
centroid in vec3 back_share;

#include "arriving.glsl"

uniform vec3 eye_in_stage;
uniform sampler2D normal_texture;  // x and y in tangent space, green up
uniform int has_normal_texture;
uniform vec3 colour_factor;
uniform float roughness;

// Directions on the surface in which u and v of the texture grow, computed from screen derivatives
// (Schueler, "Normal Mapping without Precomputed Tangents", ShaderX5, 2006). They are not unit
// vectors; they are zero if there are no texture coordinates.
mat2x3 TangentsAlong(vec3 normal) {
  vec3 across = cross(dFdy(position_in_stage), normal);
  vec3 down = cross(normal, dFdx(position_in_stage));
  vec2 du = dFdx(surface_uv);
  vec2 dv = dFdy(surface_uv);
  return mat2x3(across * du.x + down * dv.x, across * du.y + down * dv.y);
}

vec3 MappedNormal(vec3 normal, mat2x3 tangents) {
  vec2 tilt = texture(normal_texture, surface_uv).xy * 2.0 - 1.0;
  vec3 bump = vec3(tilt, sqrt(max(1.0 - dot(tilt, tilt), 0.0)));
  float size = max(dot(tangents[0], tangents[0]), dot(tangents[1], tangents[1]));
  float scale = inversesqrt(max(size, 1e-20));
  // v grows downwards in the image, the green channel of the map upwards.
  return normalize(scale * (bump.x * tangents[0] - bump.y * tangents[1]) + bump.z * normal);
}

// In a coarse level of detail, folds of cloth show back faces whose normals point to the eye. They
// count as front faces, because the light baked for the back (next to the body) would give black
// slits.
bool IsFront() {
#ifdef SURFACE_CLOTH
  vec3 to_eye = eye_in_stage - position_in_stage;
  float facing = dot(normal_in_stage, to_eye);
  const float kLeastCosine = 0.2;
  if (facing > kLeastCosine * length(normal_in_stage) * length(to_eye)) {
    return true;
  }
#endif
  return gl_FrontFacing;
}

// outward: geometric normal of the visible side, without the normal map.
Arriving SunnyLightOn(vec3 normal, vec3 outward, bool front) {
  Arriving arriving = LightOn(normal, front);
  if (has_sun == 1 && dot(outward, sun_direction) > 0.0) {
    arriving.sun_seen = SunSeen();
  }
  return arriving;
}

void Reflected(vec4 texel, out vec3 matte, out vec3 highlight) {
  vec3 albedo = surface_albedo * colour_factor * texel.rgb / max(texel.a, 1.0 / 255.0);
  bool front = IsFront();
  vec3 outward = normalize(front ? normal_in_stage : -normal_in_stage);
  vec3 normal = outward;
  mat2x3 tangents = TangentsAlong(normal);
  if (has_normal_texture == 1) {
    normal = MappedNormal(normal, tangents);
  }
  vec3 strand = tangents[1] - dot(tangents[1], normal) * normal;
  strand *= inversesqrt(max(dot(strand, strand), 1e-20));
  vec3 to_eye = normalize(eye_in_stage - position_in_stage);
  Reflect(albedo, normal, strand, to_eye, roughness, SunnyLightOn(normal, outward, front),
          matte, highlight);
}
#endif

// Keeps light and shade, so that shapes remain visible under a mark.
vec3 Marked(vec3 seen, float coverage) {
  vec3 paint = mix(mark.rgb, vec3(1.0), 0.35 * Stripes(mark_stripes, mark_stripe_px));
  float shade = 0.15 * coverage + 1.1 * dot(seen, vec3(0.2126, 0.7152, 0.0722));
  return mix(seen, paint * shade, mark.a);
}

void main() {
  vec4 texel = texture(colour_texture, surface_uv);
  float coverage = 1.0;
#ifdef COVERED
  coverage = texel.a;
#ifdef SURFACE_EYE
  // The cornea is transparent but has highlights.
  coverage = texel.a < alpha_cutoff ? 0.0 : texel.a;
#else
  // Antialiases the edge at alpha_cutoff over one pixel.
  float rim = (texel.a - alpha_cutoff) / max(fwidth(texel.a), 1e-4) + 0.5;
  coverage *= clamp(rim, 0.0, 1.0);
  if (coverage < 1.0 / 255.0) {
    discard;
  }
#endif
  bool core = coverage >= core_coverage;
  if (core == (fringe == 1)) {
    discard;
  }
  coverage = core ? 1.0 : coverage;
#endif
  vec3 matte;
  vec3 highlight;
  Reflected(texel, matte, highlight);
#ifndef SURFACE_EYE
  highlight *= coverage;
#endif
  vec3 radiance = (matte + emission) * coverage + highlight;
  vec3 seen = CameraResponse(max(radiance * gain, 0.0));
  colour = vec4(mark.a > 0.0 ? Marked(seen, coverage) : seen, coverage);
}
