// Flat facets lit by a lamp at the camera.

uniform vec4 mesh_colour;

in vec3 position_in_camera;

layout(location = 0) out vec4 colour;

void main() {
  vec3 normal = normalize(cross(dFdx(position_in_camera), dFdy(position_in_camera)));
  float facing = abs(dot(normal, normalize(position_in_camera)));
  colour = vec4(mesh_colour.rgb * (0.35 + 0.65 * facing), mesh_colour.a);
}
