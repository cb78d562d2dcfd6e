// The share of the sky's light that still reaches real surfaces when people block part of it, for
// each channel: the ratio of differential rendering (Debevec, SIGGRAPH 1998). The light comes from
// cones about the normal; a ball hides the overlap of two spherical caps of a cone (Oat & Sander,
// "Ambient Aperture Lighting", I3D 2007), here computed with cosines instead of angles.

#include "catcher.glsl"
#include "lamp_walls.glsl"
#include "lamps.glsl"
#include "octahedral.glsl"

const int kGroups = 6;  // groups of four cones, one in each component

uniform vec4 cones_x[kGroups];  // directions about cone_axis
uniform vec4 cones_y[kGroups];
uniform vec4 cones_z[kGroups];
uniform vec4 cones_cosine[kGroups];  // cosine of half the opening angle
uniform vec3 cone_axis;
uniform sampler2D sky;                 // radiance averaged over cones, octahedral map
uniform sampler2D picture_irradiance;  // irradiance at the time of the camera's image, by normal
uniform float least_share;
uniform int cluster_count;

struct Cluster {
  vec4 merged;  // centre, radius
  vec4 extent;  // radius that encloses all, index of the first ball, index after the last ball
};
layout(std140) uniform Blockers {
  Cluster clusters[128];
  vec4 balls[512];
};

layout(location = 0) out vec4 ratio;  // alpha: depth; 0: no receiving surface

// The cones of the current surface point.
vec4 cone_x[kGroups];
vec4 cone_y[kGroups];
vec4 cone_z[kGroups];
vec4 by_sine[kGroups];
vec4 by_cap[kGroups];
vec4 visible[kGroups];

vec3 SkyRadiance(vec3 direction) {
  return textureLod(sky, OctahedralPosition(direction), 0.0).rgb;
}

// Mirrors the cones so that their axis becomes the normal (Householder reflection).
void PlaceCones(vec3 normal) {
  vec3 mirror = normal - cone_axis;
  mirror *= inversesqrt(max(dot(mirror, mirror), 1e-8));
  for (int group = 0; group < kGroups; ++group) {
    vec4 along = 2.0 * (cones_x[group] * mirror.x + cones_y[group] * mirror.y +
                        cones_z[group] * mirror.z);
    cone_x[group] = cones_x[group] - along * mirror.x;
    cone_y[group] = cones_y[group] - along * mirror.y;
    cone_z[group] = cones_z[group] - along * mirror.z;
    vec4 cosine = cones_cosine[group];
    by_sine[group] = inversesqrt(1.0 - cosine * cosine);
    by_cap[group] = 1.0 / (1.0 - cosine);
    visible[group] = vec4(1.0);
  }
}

// Reduces the visible share of cones by a ball. For a point inside the ball, more than half of all
// directions are hidden, and all of them at the centre.
void Hide(vec3 to_centre, float radius) {
  float by_distance = inversesqrt(max(dot(to_centre, to_centre), 1e-12));
  float apparent = radius * by_distance;
  float fade = clamp((apparent * apparent - least_share) / least_share, 0.0, 1.0);
  float sine = max(apparent < 1.0 ? apparent : 1.0 / apparent, 1e-3);
  float cosine = sqrt(max(1.0 - sine * sine, 0.0)) * (apparent < 1.0 ? 1.0 : -1.0);
  vec3 direction = to_centre * by_distance;
  float cap = 1.0 - cosine;
  for (int group = 0; group < kGroups; ++group) {
    vec4 between =
        cone_x[group] * direction.x + cone_y[group] * direction.y + cone_z[group] * direction.z;
    // The overlap grows from 0 to 1 between caps that touch and caps that contain each other. It is
    // a cubic for equal caps and steeper for different ones, so that its integral over all
    // directions is the smaller cap.
    vec4 ratio_of_sines = sine * by_sine[group];
    vec4 t = clamp((between - cosine * cones_cosine[group]) * (0.5 * by_sine[group] / sine) + 0.5,
                   0.0, 1.0);
    vec4 alike = min(ratio_of_sines, 1.0 / ratio_of_sines);
    vec4 overlap = t * t * mix(3.0 - 2.0 * t, t, alike);
    visible[group] *= 1.0 - fade * overlap * min(cap * by_cap[group], 1.0);
  }
}

// A cluster with a smaller apparent radius than this (radius / distance) counts as one ball.
const float kMergedRadius = 0.3;

void HideCluster(Cluster cluster, vec3 point) {
  vec3 to_centre = cluster.merged.xyz - point;
  float near = cluster.extent.x / kMergedRadius;
  bool merged = dot(to_centre, to_centre) > near * near;
  int first = int(cluster.extent.y);
  int end = merged ? first + 1 : int(cluster.extent.z);
  for (int i = first; i < end; ++i) {
    vec4 ball = merged ? cluster.merged : balls[i];
    Hide(ball.xyz - point, ball.w);
  }
}

void AddCone(vec3 direction, float share, inout vec3 all, inout vec3 left) {
  vec3 radiance = SkyRadiance(direction);
  all += radiance;
  left += radiance * share;
}

vec3 VisibleShare() {
  vec3 all = vec3(0.0);
  vec3 left = vec3(0.0);
  for (int group = 0; group < kGroups; ++group) {
    vec4 x = cone_x[group];
    vec4 y = cone_y[group];
    vec4 z = cone_z[group];
    vec4 share = visible[group];
    AddCone(vec3(x.x, y.x, z.x), share.x, all, left);
    AddCone(vec3(x.y, y.y, z.y), share.y, all, left);
    AddCone(vec3(x.z, y.z, z.z), share.z, all, left);
    AddCone(vec3(x.w, y.w, z.w), share.w, all, left);
  }
  return mix(vec3(1.0), left / max(all, 1e-12), greaterThan(all, vec3(1e-9)));
}

// Must agree with shared/light/lamp.cc.
const float kLeastPenumbra = 0.03;

// The share of a lamp's light that passes a ball.
float LampPast(vec4 ball, SeenLamp lamp, vec4 place, vec3 point) {
  vec3 to = ball.xyz - point;
  float along = dot(to, lamp.direction);
  float off = sqrt(max(dot(to, to) - along * along, 0.0));
  float wide = max(place.w * along / lamp.distance, kLeastPenumbra);
  float t = clamp((ball.w + wide - off) / (ball.w + wide - abs(ball.w - wide)), 0.0, 1.0);
  float covered = t * t * (3.0 - 2.0 * t) * min(ball.w * ball.w / (wide * wide), 1.0);
  bool between = along > 0.0 && along < lamp.distance;
  bool holds = distance(ball.xyz, place.xyz) < ball.w + place.w;
  return between && !holds ? 1.0 - covered : 1.0;
}

float LampSeen(SeenLamp lamp, vec4 place, vec3 point) {
  float seen = 1.0;
  for (int i = 0; i < cluster_count; ++i) {
    vec3 to = clusters[i].merged.xyz - point;
    vec3 off = to - clamp(dot(to, lamp.direction), 0.0, lamp.distance) * lamp.direction;
    float near = clusters[i].extent.x + place.w + kLeastPenumbra;
    int end = dot(off, off) < near * near ? int(clusters[i].extent.z) : 0;
    for (int k = int(clusters[i].extent.y); k < end; ++k) {
      seen *= LampPast(balls[k], lamp, place, point);
    }
  }
  return seen;
}

uniform float least_lamp;  // irradiance below which a lamp is not visible

// The lamps' light divided by the sky's light in the camera's image, without people.
vec3 LampRatio(vec3 point, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lamp_count; ++i) {
    SeenLamp lamp = SeeLamp(i, point);
    vec3 irradiance = lamp.irradiance * LampCosine(lamp, normal);
    int shows = max(irradiance.r, max(irradiance.g, irradiance.b)) > least_lamp ? 1 : 0;
    for (int k = 0; k < shows; ++k) {
      sum += (irradiance - least_lamp) * LampSeen(lamp, lamp_places[i], point) *
             PastWalls(i, -lamp.direction, point);
    }
  }
  vec3 sky_here = textureLod(picture_irradiance, OctahedralPosition(normal), 0.0).rgb;
  return max(sum, 0.0) / max(sky_here, 1e-3);
}

void main() {
  ivec2 cell = CoarseSource(ivec2(gl_FragCoord.xy));
  vec4 surface = texelFetch(surface_normal, cell, 0);
  float depth = SurfaceDepth(cell);
  vec3 point = SurfacePoint(cell, depth);
  PlaceCones(SurfaceNormal(surface));
  bool receives = surface.a > 0.5;
  int count = receives ? cluster_count : 0;
  for (int i = 0; i < count; ++i) {
    HideCluster(clusters[i], point);
  }
  vec3 kept = VisibleShare();
  int lit = receives ? min(lamp_count, 1) : 0;
  for (int i = 0; i < lit; ++i) {
    kept += LampRatio(point, SurfaceNormal(surface));
  }
  ratio = receives ? vec4(kept, depth) : vec4(1.0, 1.0, 1.0, 0.0);
}
