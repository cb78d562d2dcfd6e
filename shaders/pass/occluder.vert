uniform mat4 clip_from_mesh;

layout(location = 0) in vec3 position;

void main() { gl_Position = clip_from_mesh * vec4(position, 1.0); }
