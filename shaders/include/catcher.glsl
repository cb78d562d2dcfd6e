// The nearest real surfaces in the picture, which may receive shadows. Cells are pixels of the
// layer, counted from the bottom row.

#include "picture_rays.glsl"

uniform sampler2D surface_normal;  // stage axes, 0.5 n + 0.5; alpha 1: receives shadows
uniform sampler2D surface_depth;
uniform vec4 catcher_bounds;  // left, bottom, right, top; both textures are valid inside

// Width and height of one cell of the coarse image of ratios, cells.
uniform int shadow_cell;

float SurfaceDepth(ivec2 cell) { return DepthInMetres(texelFetch(surface_depth, cell, 0).r); }

vec3 SurfaceNormal(vec4 texel) { return normalize(2.0 * texel.xyz - 1.0); }

// The cell that represents a cell of the coarse image.
ivec2 CoarseSource(ivec2 coarse) {
  ivec2 low = ivec2(catcher_bounds.xy);
  ivec2 high = ivec2(catcher_bounds.zw) - 1;
  return clamp(coarse * shadow_cell + shadow_cell / 2, low, high);
}
