// A diffuse surface under distant light.

#include "spherical_harmonics.glsl"

uniform vec3 irradiance[9];
uniform vec3 gain;   // exposure and the camera's gain
uniform float knee;  // of the camera's response

in vec3 normal_in_stage;
in vec3 surface_albedo;

layout(location = 0) out vec4 colour;

const float kPi = 3.14159265358979;

// Linear up to the knee, then an exponential shoulder of equal slope that reaches
// 1 at infinity.
vec3 CameraResponse(vec3 x) {
  float range = max(1.0 - knee, 1e-4);
  return min(x, knee) + range * (1.0 - exp(-max(x - knee, 0.0) / range));
}

void main() {
  vec3 normal = normalize(gl_FrontFacing ? normal_in_stage : -normal_in_stage);
  vec3 radiance = surface_albedo / kPi * Irradiance(irradiance, normal);
  colour = vec4(CameraResponse(radiance * gain), 1.0);  // opaque; edges get their coverage from samples
}
