uniform mat4 clip_from_mesh;
uniform mat4 camera_from_mesh;

layout(location = 0) in vec3 position;

out vec3 position_in_camera;

void main() {
  position_in_camera = (camera_from_mesh * vec4(position, 1.0)).xyz;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
