// Lamps, which are balls of uniform radiance (shared/light/lamp.h).

uniform int lamp_count;
uniform vec4 lamp_places[8];       // centre (stage axes), radius
uniform vec3 lamp_intensities[8];  // irradiance on a facing surface at one metre

// A lamp as seen from a point.
struct SeenLamp {
  vec3 direction;
  float distance;
  vec3 irradiance;  // irradiance of a surface that faces the lamp
  float sine;       // sine of its angular radius
};

SeenLamp SeeLamp(int index, vec3 point) {
  vec4 place = lamp_places[index];
  vec3 to = place.xyz - point;
  float away = max(length(to), 1e-6);
  float outside = max(away, 1.02 * place.w);
  return SeenLamp(to / away, away, lamp_intensities[index] / (outside * outside),
                  place.w / outside);
}

// The cosine factor of irradiance from a ball that may be partly below the horizon: a parabola
// between the point where it begins to rise and the point where all of it is above.
float LampCosine(SeenLamp lamp, vec3 normal) {
  float cosine = dot(normal, lamp.direction);
  float risen = max(cosine + lamp.sine, 0.0);
  return cosine > lamp.sine ? cosine : risen * risen / (4.0 * lamp.sine);
}
