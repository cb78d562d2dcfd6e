// Irradiance at a unit normal from real spherical harmonics of degrees 0..2, index l(l+1)+m
// (Ramamoorthi & Hanrahan, SIGGRAPH 2001, equation 13). The basis is that of
// shared/light/spherical_harmonics.h; the coefficients of radiance are already multiplied by those
// of the clamped cosine (pi, 2 pi / 3, pi / 4) and by the constants of the basis.

// Added to unshadowed irradiance before dividing by it.
const float kLeastUnshadowed = 1e-3;

vec3 Irradiance(vec3 c[9], vec3 n) {
  vec3 irradiance = c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * (n.x * n.y) +
                    c[5] * (n.y * n.z) + c[6] * (3.0 * n.z * n.z - 1.0) + c[7] * (n.x * n.z) +
                    c[8] * (n.x * n.x - n.y * n.y);
  return max(irradiance, 0.0);
}
