// Writes the normal of real surfaces, and whether they receive shadows.

uniform float receives;
uniform vec3 eye_in_stage;

in vec3 position_in_stage;

layout(location = 0) out vec4 surface;

void main() {
  vec3 normal = normalize(cross(dFdx(position_in_stage), dFdy(position_in_stage)));
  // The normal points towards the eye, independent of the winding of the triangles.
  normal = dot(normal, eye_in_stage - position_in_stage) < 0.0 ? -normal : normal;
  surface = vec4(0.5 * normal + 0.5, receives);
}
