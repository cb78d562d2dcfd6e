// Draws a grey picture. Its values are sRGB-encoded and are not converted.

uniform sampler2D picture;

in vec2 at;
in vec4 paint;
in vec2 half_px;

layout(location = 0) out vec4 colour;

void main() { colour = vec4(vec3(texture(picture, at).r) * paint.rgb, paint.a); }
