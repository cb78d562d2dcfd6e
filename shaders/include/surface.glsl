// The radiance of surfaces under distant light. Diffuse light comes from spherical harmonics.
// Highlights come from a prefiltered map and the sun; without a map, from the main direction of
// light. SURFACE_PLAIN, SURFACE_SKIN, SURFACE_HAIR, SURFACE_CLOTH, SURFACE_EYE or SURFACE_METAL
// selects the model; REFLECTIONS says that there is a map.

#ifdef REFLECTIONS
#include "glossy.glsl"
#endif
#include "lamps.glsl"
#include "spherical_harmonics.glsl"

uniform int has_sun;
uniform vec3 sun_direction;  // towards the sun, unit, stage axes
uniform vec3 irradiance[9];
uniform int matte_only;
uniform vec3 key_direction;   // towards the light, unit, stage axes
uniform vec3 key_irradiance;  // facing the light; the sun's if there is a sun

// For the current surface: the irradiance of the key light that arrives, and the share of all light
// that is not in shadow.
vec3 key_light;
float open_share;

const float kPi = 3.14159265358979;

// Reflectance of a smooth dielectric (Schlick). f0: reflectance at normal incidence.
float Fresnel(float f0, float cosine) {
  float rest = 1.0 - cosine;
  float squared = rest * rest;
  return f0 + (1.0 - f0) * squared * squared * rest;
}

// The share of uniform light that a rough dielectric reflects (Karis, "Physically Based Shading on
// Mobile", 2014).
float ReflectedShare(float f0, float roughness, float cosine) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
  return f0 * (-1.04 * a + r.z) + 1.04 * a + r.w;
}

// Radiance that a rough dielectric reflects per irradiance from one direction: GGX (Walter et al.,
// EGSR 2007), with the visibility term of Hammon, "PBR Diffuse Lighting for GGX+Smith", GDC 2017.
float Glint(vec3 direction, vec3 normal, vec3 to_eye, float f0, float alpha) {
  vec3 half_way = normalize(direction + to_eye);
  float n_l = max(dot(normal, direction), 0.0);
  float n_v = max(dot(normal, to_eye), 1e-3);
  float n_h = max(dot(normal, half_way), 0.0);
  float spread = n_h * n_h * (alpha * alpha - 1.0) + 1.0;
  float distribution = alpha * alpha / (kPi * spread * spread);
  float visibility = 0.5 / max(mix(2.0 * n_l * n_v, n_l + n_v, alpha), 1e-3);
  float fresnel = Fresnel(f0, max(dot(to_eye, half_way), 0.0));
  return distribution * visibility * fresnel * n_l;
}

// Plain surfaces (clay, wood, plaster) that are rougher than this count as matte.
const float kMatte = 0.75;

float LobeOf(float roughness) { return max(roughness * roughness, 2e-3); }

// The size of a lamp widens its highlight (Karis 2013, "Sphere Lights").
vec3 LampHighlights(vec3 normal, vec3 to_eye, float f0, float roughness) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lamp_count; ++i) {
    SeenLamp lamp = SeeLamp(i, position_in_stage);
    float alpha = min(LobeOf(roughness) + 0.5 * lamp.sine, 1.0);
    sum += lamp.irradiance * Glint(lamp.direction, normal, to_eye, f0, alpha);
  }
  return open_share * sum;
}

// Highlight without a map: the surroundings are as blurred as irradiance; the key light, which is
// subtracted from them, gives a sharp highlight.
vec3 KeyHighlight(vec3 normal, vec3 mirrored, vec3 to_eye, float f0, float roughness) {
  vec3 around = Irradiance(irradiance, mirrored);
  if (has_sun == 0) {  // the sun is not part of the harmonics
    around -= key_irradiance * max(dot(mirrored, key_direction), 0.0);
  }
  float share = ReflectedShare(f0, roughness, max(dot(normal, to_eye), 0.0));
  return open_share * share * max(around, 0.0) / kPi +
         key_light * Glint(key_direction, normal, to_eye, f0, LobeOf(roughness));
}

// All highlights of a rough dielectric.
vec3 Highlight(vec3 normal, vec3 to_eye, float f0, float roughness) {
  vec3 mirrored = reflect(-to_eye, normal);
  vec3 sum = LampHighlights(normal, to_eye, f0, roughness);
#ifndef REFLECTIONS
  return sum + KeyHighlight(normal, mirrored, to_eye, f0, roughness);
#else
  // Rough surfaces reflect from directions nearer to the normal (Lagarde & de Rousiers, "Moving
  // Frostbite to PBR", SIGGRAPH 2014 courses, "Dominant direction").
  float alpha = LobeOf(roughness);
  vec3 towards = mix(normal, mirrored, (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha));
  float n_v = max(dot(normal, to_eye), 0.0);
  // Shadows reduce reflections like irradiance, but less the sharper the reflection is (the same
  // course, "Specular occlusion").
  float open = clamp(pow(n_v + open_share, exp2(-16.0 * roughness - 1.0)) - 1.0 + open_share,
                     0.0, 1.0);
  sum += open * ReflectedShare(f0, roughness, n_v) * Mirrored(normalize(towards), roughness);
  for (int i = 0; i < has_sun; ++i) {
    sum += key_light * Glint(key_direction, normal, to_eye, f0, alpha);
  }
  return sum;
#endif
}

// One lobe of light along strands (Kajiya & Kay, SIGGRAPH 1989), shifted towards root or tip.
float StrandLobe(vec3 strand, vec3 normal, vec3 half_way, float shift, float exponent) {
  float along = dot(normalize(strand + shift * normal), half_way);
  return smoothstep(-1.0, 0.0, along) * pow(max(1.0 - along * along, 0.0), 0.5 * exponent);
}

// The white lobe comes from the surface of the strands, the coloured one from inside (Marschner et
// al., SIGGRAPH 2003; positions of the lobes after Scheuermann 2004).
vec3 HairHighlight(vec3 albedo, vec3 normal, vec3 strand, vec3 to_eye, float roughness) {
  vec3 half_way = normalize(key_direction + to_eye);
  float sharpness = mix(120.0, 12.0, roughness);
  float white = StrandLobe(strand, normal, half_way, -0.1, sharpness);
  float coloured = StrandLobe(strand, normal, half_way, 0.15, 0.25 * sharpness);
  float facing = clamp(0.3 + 0.7 * dot(normal, key_direction), 0.0, 1.0);
  return key_light * facing * (0.02 * white + 0.08 * sqrt(albedo) * coloured);
}

// Light scattered by fibres that stand off the cloth. It is strongest at grazing views, and when
// the light comes from the direction of the eye.
vec3 Fuzz(vec3 albedo, vec3 normal, vec3 to_eye, vec3 even) {
  float rim = 1.0 - max(dot(normal, to_eye), 0.0);
  rim *= rim;
  rim *= rim;
  float back = max(dot(key_direction, to_eye), 0.0);
  back *= back;
  back *= back;
  back *= back;
  return mix(albedo, vec3(1.0), 0.15) * (0.25 * rim + 0.05 * back) * even / kPi;
}

// The light that arrives at a surface after shadows.
struct Arriving {
  vec3 irradiance;
  float open;      // share of light that is not in shadow; 1: no shadow
  float sun_seen;  // visible share of the sun's disc
};

Arriving Unshadowed(vec3 normal) { return Arriving(Irradiance(irradiance, normal), 1.0, 0.0); }

// Light transfer was computed for the normal of a vertex. This applies it to another normal, in
// proportion to the unshadowed irradiance of both. share: transferred irradiance divided by the
// unshadowed irradiance at the vertex.
Arriving Transferred(vec3 transferred, vec3 share, float open, vec3 normal) {
  vec3 here = Irradiance(irradiance, normal) + kLeastUnshadowed;
  return Arriving(min(share * here, 4.0 * transferred), open, 0.0);
}

// strand: unit, along hair from root to tip. matte and highlight are separate, so that highlights
// can remain where coverage is low.
void Reflect(vec3 albedo, vec3 normal, vec3 strand, vec3 to_eye, float roughness,
             Arriving arriving, out vec3 matte, out vec3 highlight) {
  open_share = arriving.open;
  key_light = key_irradiance * (has_sun == 1 ? arriving.sun_seen : arriving.open);
  vec3 even = arriving.irradiance;
  if (has_sun == 1) {
    even += key_light * max(dot(normal, key_direction), 0.0);
  }
  matte = albedo / kPi * even;
  highlight = vec3(0.0);
  if (matte_only == 1) {
    return;
  }
#ifdef SURFACE_PLAIN
#ifdef REFLECTIONS
  if (roughness < kMatte) {
    highlight = Highlight(normal, to_eye, 0.04, roughness);
  }
#endif
#endif
#ifdef SURFACE_METAL
  // A perfect reflector tinted by albedo. That metals turn white at grazing angles is ignored.
  matte = vec3(0.0);
  highlight = albedo * Highlight(normal, to_eye, 1.0, roughness);
#endif
#ifdef SURFACE_SKIN
  highlight = Highlight(normal, to_eye, 0.028, roughness);
#endif
#ifdef SURFACE_HAIR
  highlight = HairHighlight(albedo, normal, strand, to_eye, roughness);
#endif
#ifdef SURFACE_CLOTH
  matte += Fuzz(albedo, normal, to_eye, even);
#endif
#ifdef SURFACE_EYE
  // Lids, lashes and brows block much of the surroundings, so that the pupil is dark. The tear film
  // is smooth, so roughness is not used.
  matte *= 0.8;
  vec3 glint = key_light * Glint(key_direction, normal, to_eye, 0.025, LobeOf(0.2));
#ifdef REFLECTIONS
  glint = has_sun == 0 ? vec3(0.0) : glint;
#endif
  glint += LampHighlights(normal, to_eye, 0.025, 0.2);
  highlight = glint + 0.5 * max(Highlight(normal, to_eye, 0.025, 0.2) - glint, 0.0);
#endif
}
