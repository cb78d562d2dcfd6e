// Rectifies the camera's image: each pixel of the pinhole picture reads the pixel of the camera's
// image that has the same ray. The target's top row comes first.

#include "background.glsl"

layout(location = 0) out vec4 colour;

void main() { colour = vec4(Background(RawPixel()), 1.0); }
