uniform mat4 clip_from_stage;
uniform mat4 stage_from_mesh;

layout(location = 0) in vec3 position;

out vec3 position_in_stage;

void main() {
  vec4 in_stage = stage_from_mesh * vec4(position, 1.0);
  position_in_stage = in_stage.xyz;
  gl_Position = clip_from_stage * in_stage;
}
