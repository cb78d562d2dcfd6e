// Depth of people and props for shadow maps. Pixels with little coverage are discarded.

uniform sampler2D colour_texture;
uniform float alpha_cutoff;

in vec2 surface_uv;

void main() {
#ifdef COVERED
  if (texture(colour_texture, surface_uv).a < max(alpha_cutoff, 0.5)) {
    discard;
  }
#endif
}
