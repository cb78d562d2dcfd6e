// Linear blend skinning, four influences: what human::SkinMesh does on the CPU.

uniform mat4 clip_from_actor;
uniform mat4 stage_from_actor;
layout(std140) uniform Skin { mat4 skin[256]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;

out vec3 normal_in_stage;
out vec3 surface_albedo;

void main() {
  mat4 blend = weights.x * skin[joints.x] + weights.y * skin[joints.y] +
               weights.z * skin[joints.z] + weights.w * skin[joints.w];
  gl_Position = clip_from_actor * (blend * vec4(position, 1.0));
  normal_in_stage = mat3(stage_from_actor) * (mat3(blend) * normal);
  surface_albedo = albedo;
}
