// Scales a picture. Software renderers do this faster than a copy between framebuffers.

uniform sampler2D picture;
uniform vec2 target_size;  // pixels

layout(location = 0) out vec4 colour;

void main() { colour = textureLod(picture, gl_FragCoord.xy / target_size, 0.0); }
