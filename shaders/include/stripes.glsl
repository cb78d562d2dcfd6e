// Stripes across the picture, which distinguish objects without colours.

// Returns 1 on a stripe, whose width is a third of step_px.
float Stripe(float across_px, float step_px) {
  float from_middle = abs(fract(across_px / step_px) - 0.5) * step_px;
  return clamp(0.5 + step_px / 6.0 - from_middle, 0.0, 1.0);
}

// directions: 0: none, 1: rising stripes, 2: crossed stripes.
float Stripes(int directions, float step_px) {
  const float kHalfTurn = 0.70710678;
  vec2 across = kHalfTurn * vec2(gl_FragCoord.x - gl_FragCoord.y, gl_FragCoord.x + gl_FragCoord.y);
  float first = directions > 0 ? Stripe(across.x, step_px) : 0.0;
  return max(first, directions > 1 ? Stripe(across.y, step_px) : 0.0);
}
