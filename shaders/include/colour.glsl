// The sRGB transfer function (IEC 61966-2-1).

vec3 SrgbFromLinear(vec3 c) {
  vec3 curve = 1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
  return mix(c * 12.92, curve, step(0.0031308, c));
}

vec3 LinearFromSrgb(vec3 c) {
  vec3 curve = pow((max(c, 0.04045) + 0.055) / 1.055, vec3(2.4));
  return mix(c / 12.92, curve, step(0.04045, c));
}
