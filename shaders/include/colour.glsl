// The sRGB transfer function (IEC 61966-2-1) for 0 to 1, by minimax polynomials with an error below
// a tenth of an 8-bit step. In a software renderer, pow() would take a seventh of the composite's
// time.

vec3 SrgbFromLinear(vec3 c) {
  vec3 t = sqrt(sqrt(max(c, 0.0031308)));
  vec3 curve = ((-0.13682676 * t + 0.95257817) * t + 0.25579461) * t - 0.07176078;
  return mix(c * 12.92, curve, step(0.0031308, c));
}

vec3 LinearFromSrgb(vec3 c) {
  vec3 curve =
      (((-0.11679469 * c + 0.52651848) * c + 0.56036774) * c + 0.02840493) * c + 0.00104624;
  return mix(c / 12.92, curve, step(0.04045, c));
}
