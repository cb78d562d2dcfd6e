// The radiance of surfaces under distant light: spherical harmonics for all of it, and for
// highlights a prefiltered map and the sun; without a map, the one direction that most of
// the light comes from. SURFACE_PLAIN,
// SURFACE_SKIN, SURFACE_HAIR, SURFACE_CLOTH, SURFACE_EYE or SURFACE_METAL chooses the model,
// REFLECTIONS whether there is a map.

#ifdef REFLECTIONS
#include "glossy.glsl"
#endif
#include "lamps.glsl"
#include "spherical_harmonics.glsl"

uniform int has_sun;
uniform vec3 sun_direction;  // towards it, unit, stage axes
uniform vec3 irradiance[9];
uniform int matte_only;
uniform vec3 key_direction;   // towards the light, unit, stage axes
uniform vec3 key_irradiance;  // of a surface that faces it; of the sun where there is one

// Of the surface at hand: what arrives of the key light, and how much of all is not in
// somebody's shadow.
vec3 key_light;
float open_share;

const float kPi = 3.14159265358979;

// Of a smooth dielectric at a cosine (Schlick).
float Fresnel(float f0, float cosine) {
  float rest = 1.0 - cosine;
  float squared = rest * rest;
  return f0 + (1.0 - f0) * squared * squared * rest;
}

// The share of even light that a rough dielectric reflects (Karis, "Physically Based
// Shading on Mobile", 2014).
float ReflectedShare(float f0, float roughness, float cosine) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
  return f0 * (-1.04 * a + r.z) + 1.04 * a + r.w;
}

// What a rough dielectric reflects of an irradiance from one direction: GGX (Walter et al.,
// EGSR 2007), with the visibility of Hammon, "PBR Diffuse Lighting for GGX+Smith", GDC 2017.
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

// Clay, wood and plaster that are rougher count as matte.
const float kMatte = 0.75;

float LobeOf(float roughness) { return max(roughness * roughness, 2e-3); }

// A lamp's own size widens its glint (Karis 2013, "Sphere Lights").
vec3 LampHighlights(vec3 normal, vec3 to_eye, float f0, float roughness) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lamp_count; ++i) {
    SeenLamp lamp = SeeLamp(i, position_in_stage);
    float alpha = min(LobeOf(roughness) + 0.5 * lamp.sine, 1.0);
    sum += lamp.irradiance * Glint(lamp.direction, normal, to_eye, f0, alpha);
  }
  return open_share * sum;
}

// What comes from around without a map is as blurred as irradiance is; the key light, from
// which it is apart, glints.
vec3 KeyHighlight(vec3 normal, vec3 mirrored, vec3 to_eye, float f0, float roughness) {
  vec3 around = Irradiance(irradiance, mirrored);
  if (has_sun == 0) {  // which is not in the harmonics
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
  // Rough surfaces mirror from nearer the normal (Lagarde & de Rousiers, "Moving Frostbite to
  // PBR", SIGGRAPH 2014 courses, "Dominant direction").
  float alpha = LobeOf(roughness);
  vec3 towards = mix(normal, mirrored, (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha));
  float n_v = max(dot(normal, to_eye), 0.0);
  // What irradiance lost to shadows the mirrored light lost too, the less the sharper it is
  // (likewise, "Specular occlusion").
  float open = clamp(pow(n_v + open_share, exp2(-16.0 * roughness - 1.0)) - 1.0 + open_share,
                     0.0, 1.0);
  sum += open * ReflectedShare(f0, roughness, n_v) * Mirrored(normalize(towards), roughness);
  for (int i = 0; i < has_sun; ++i) {
    sum += key_light * Glint(key_direction, normal, to_eye, f0, alpha);
  }
  return sum;
#endif
}

// One lobe of light along strands (Kajiya & Kay, SIGGRAPH 1989), moved towards root
// or tip.
float StrandLobe(vec3 strand, vec3 normal, vec3 half_way, float shift, float exponent) {
  float along = dot(normalize(strand + shift * normal), half_way);
  return smoothstep(-1.0, 0.0, along) * pow(max(1.0 - along * along, 0.0), 0.5 * exponent);
}

// The white lobe comes from the strands' surface, the coloured one from within
// (Marschner et al., SIGGRAPH 2003; lobes as Scheuermann 2004 places them).
vec3 HairHighlight(vec3 albedo, vec3 normal, vec3 strand, vec3 to_eye, float roughness) {
  vec3 half_way = normalize(key_direction + to_eye);
  float sharpness = mix(120.0, 12.0, roughness);
  float white = StrandLobe(strand, normal, half_way, -0.1, sharpness);
  float coloured = StrandLobe(strand, normal, half_way, 0.15, 0.25 * sharpness);
  float facing = clamp(0.3 + 0.7 * dot(normal, key_direction), 0.0, 1.0);
  return key_light * facing * (0.02 * white + 0.08 * sqrt(albedo) * coloured);
}

// Light caught by fibres that stand off the cloth: strongest at grazing sight, and
// where sight and light have one direction.
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

// Light that transfer left of what falls on a surface, and how much of it that is.
struct Arriving {
  vec3 irradiance;
  float open;      // 1: nothing is in its way
  float sun_seen;  // share of the sun's disc
};

Arriving Unshadowed(vec3 normal) { return Arriving(Irradiance(irradiance, normal), 1.0, 0.0); }

// Transfer was worked out for a vertex and its normal; what the normal at hand would see
// without shadows, over what that one would, carries it over. share: transferred over what
// the vertex would see without shadows.
Arriving Transferred(vec3 transferred, vec3 share, float open, vec3 normal) {
  vec3 here = Irradiance(irradiance, normal) + kLeastUnshadowed;
  return Arriving(min(share * here, 4.0 * transferred), open, 0.0);
}

// strand: unit, along hair from root to tip. Highlights apart, so that they can stay
// where the surface is hardly there.
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
  // As what reflects all light, dyed: that metals turn white at grazing sight is left out.
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
  // Lids, lashes and brows keep most of what is around off, so that the pupil is dark; the
  // film of tears is smooth whatever lies beneath.
  matte *= 0.8;
  vec3 glint = key_light * Glint(key_direction, normal, to_eye, 0.025, LobeOf(0.2));
#ifdef REFLECTIONS
  glint = has_sun == 0 ? vec3(0.0) : glint;
#endif
  glint += LampHighlights(normal, to_eye, 0.025, 0.2);
  highlight = glint + 0.5 * max(Highlight(normal, to_eye, 0.025, 0.2) - glint, 0.0);
#endif
}
