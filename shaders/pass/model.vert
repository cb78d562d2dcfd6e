// Skinning with four influences, the same as human::SkinningJob on the CPU: by matrices, or with
// SKIN_DUAL_QUATERNION by dual quaternions, or with SKIN_RIGID by the matrix of a single joint.
// LIT_AT_VERTICES: lighting is computed here, not for each pixel.

#include "spherical_harmonics.glsl"

uniform mat4 clip_from_model;
uniform vec3 unscattered[9];  // irradiance without subsurface scattering
uniform mat4 stage_from_model;
uniform int posed;  // 1: positions and normals are final, without skinning
// Matrices; with SKIN_DUAL_QUATERNION the columns of each are the real part, the dual part (both
// x, y, z, w), and the scale.
layout(std140) uniform Skin { mat4 skin[256]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;
layout(location = 5) in vec2 uv;
layout(location = 6) in vec3 irradiance_at_vertex;
layout(location = 7) in vec3 bind_normal;
layout(location = 8) in vec3 back_at_vertex;

#ifdef LIT_AT_VERTICES
vec3 position_in_stage;
vec3 normal_in_stage;
vec3 transferred;
vec3 transfer_share;
float transfer_open;
vec3 back_share;

#include "arriving.glsl"

uniform vec3 eye_in_stage;
uniform vec3 colour_factor;
uniform float roughness;

// Lighting, to be multiplied by the texture.
out vec3 matte_front;
out vec3 matte_back;
out vec3 matte_of_sun;  // negative: the sun lights the back
out vec3 highlight_front;
out vec3 highlight_of_sun;
#else
out vec3 position_in_stage;
out vec3 normal_in_stage;
out vec3 surface_albedo;
centroid out vec3 transferred;     // irradiance by light transfer
centroid out vec3 transfer_share;  // transferred divided by unshadowed irradiance
centroid out float transfer_open;  // luminance of that share, at most 1
centroid out vec3 back_share;      // share of unshadowed light that reaches the back
#endif
out vec2 surface_uv;

#ifdef SKIN_RIGID
mat4 Skinned() { return skin[joints.x]; }
#endif

#if !defined(SKIN_RIGID) && !defined(SKIN_DUAL_QUATERNION)
mat4 Skinned() {
  return weights.x * skin[joints.x] + weights.y * skin[joints.y] + weights.z * skin[joints.z] +
         weights.w * skin[joints.w];
}
#endif

#ifdef SKIN_DUAL_QUATERNION
// Adds a dual quaternion and its scale, with the sign that puts it in the hemisphere of the first.
void AddDualQuaternion(uint joint, float weight, inout vec4 real, inout vec4 dual,
                       inout float scale) {
  mat4 q = skin[joint];
  float side = dot(q[0], skin[joints.x][0]) < 0.0 ? -weight : weight;
  real += side * q[0];
  dual += side * q[1];
  scale += weight * q[2].x;
}

mat4 Skinned() {
  vec4 r = vec4(0.0);
  vec4 d = vec4(0.0);
  float scale = 0.0;
  AddDualQuaternion(joints.x, weights.x, r, d, scale);
  AddDualQuaternion(joints.y, weights.y, r, d, scale);
  AddDualQuaternion(joints.z, weights.z, r, d, scale);
  AddDualQuaternion(joints.w, weights.w, r, d, scale);
  float size = inversesqrt(max(dot(r, r), 1e-12));
  r *= size;
  d *= size;
  vec3 x = vec3(1.0 - 2.0 * (r.y * r.y + r.z * r.z), 2.0 * (r.x * r.y + r.w * r.z),
                2.0 * (r.x * r.z - r.w * r.y));
  vec3 y = vec3(2.0 * (r.x * r.y - r.w * r.z), 1.0 - 2.0 * (r.x * r.x + r.z * r.z),
                2.0 * (r.y * r.z + r.w * r.x));
  vec3 translation = 2.0 * (r.w * d.xyz - d.w * r.xyz + cross(r.xyz, d.xyz));
  return mat4(vec4(scale * x, 0.0), vec4(scale * y, 0.0), vec4(scale * cross(x, y), 0.0),
              vec4(translation, 1.0));
}
#endif

#ifdef LIT_AT_VERTICES
struct Reflected {
  vec3 matte;
  vec3 highlight;
};

Reflected ReflectedBy(vec3 normal, bool front, float sun_seen) {
  Arriving arriving = LightOn(normal, front);
  arriving.sun_seen = sun_seen;
  vec3 down = vec3(0.0, -1.0, 0.0);
  vec3 strand = down - dot(down, normal) * normal;  // assumes that hair hangs down
  strand *= inversesqrt(max(dot(strand, strand), 1e-20));
  vec3 to_eye = normalize(eye_in_stage - position_in_stage);
  Reflected reflected;
  Reflect(albedo * colour_factor, normal, strand, to_eye, roughness, arriving, reflected.matte,
          reflected.highlight);
  return reflected;
}

uniform int two_sided;

void Light() {
  vec3 normal = normalize(normal_in_stage);
  Reflected front = ReflectedBy(normal, true, 0.0);
  Reflected front_in_sun = ReflectedBy(normal, true, 1.0);
  matte_front = front.matte;
  matte_of_sun = front_in_sun.matte - front.matte;
  highlight_front = front.highlight;
  highlight_of_sun = front_in_sun.highlight - front.highlight;
  matte_back = vec3(0.0);
  for (int i = 0; i < two_sided; ++i) {
    Reflected back = ReflectedBy(-normal, false, 0.0);
    matte_back = back.matte;
    matte_of_sun -= ReflectedBy(-normal, false, 1.0).matte - back.matte;
  }
}
#endif

void main() {
  mat4 skinned = Skinned();
  mat4 model_from_bind = posed == 1 ? mat4(1.0) : skinned;
  vec4 in_model = model_from_bind * vec4(position, 1.0);
  gl_Position = clip_from_model * in_model;
  position_in_stage = (stage_from_model * in_model).xyz;
  normal_in_stage = mat3(stage_from_model) * (mat3(model_from_bind) * normal);
  surface_uv = uv;
  transferred = irradiance_at_vertex;
  back_share = back_at_vertex;
  vec3 transfer_normal = normalize(mat3(stage_from_model) * (mat3(skinned) * bind_normal));
  vec3 there = Irradiance(unscattered, transfer_normal) + kLeastUnshadowed;
  transfer_share = transferred / there;
  vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  transfer_open = clamp(dot(transferred, luminance) / dot(there, luminance), 0.0, 1.0);
#ifdef LIT_AT_VERTICES
  Light();
#else
  surface_albedo = albedo;
#endif
}
