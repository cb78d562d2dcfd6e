// The camera's image as an undistorted pinhole sees it: each pixel looks up where the camera
// saw its ray. The target's top row comes first.

#include "background.glsl"

layout(location = 0) out vec4 colour;

void main() { colour = vec4(Background(RawPixel()), 1.0); }
