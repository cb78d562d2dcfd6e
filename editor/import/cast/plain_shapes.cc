#include "editor/import/cast/plain_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "editor/import/cast/plain_skeleton.h"

namespace lararium::import {
namespace {

// Axes of a limb segment: across (outwards), along it, across (backwards).
glm::mat3 LimbAxes(const glm::vec3& from, const glm::vec3& to) {
  const glm::vec3 along = glm::normalize(to - from);
  const glm::vec3 outward = glm::normalize(glm::cross(along, glm::vec3(0.0f, 0.0f, 1.0f)));
  const glm::vec3 side = glm::dot(outward, glm::vec3(1.0f, 0.0f, 0.0f)) > 0.0f ? outward : -outward;
  return glm::mat3(side, along, glm::cross(side, along));
}

constexpr glm::vec3 kSkullCenter(0.0f, 1.628f, 0.012f);
constexpr glm::vec3 kSkullRadii(0.0745f, 0.086f, 0.093f);
constexpr float kEyeRadius = 0.0125f;

float Neck(const glm::vec3& p) {
  float d = RoundCone(p, {0.0f, 1.39f, 0.036f}, 0.061f, {0.0f, 1.56f, 0.018f}, 0.0515f);
  // Trapezius, clavicles and upper chest, which are visible in the neckline.
  d = SmoothUnion(
      d, RoundCone(FoldX(p), {0.010f, 1.455f, 0.045f}, 0.028f, {0.135f, 1.400f, 0.030f}, 0.026f),
      0.04f);
  return SmoothUnion(d, Ellipsoid(p, {0.0f, 1.33f, 0.02f}, {0.155f, 0.105f, 0.088f}), 0.04f);
}

float Face(const glm::vec3& p) {
  const glm::vec3 q = FoldX(p);
  float d = Ellipsoid(p, kSkullCenter, kSkullRadii);
  d = SmoothUnion(d, Ellipsoid(p, {0.0f, 1.580f, -0.030f}, {0.0585f, 0.075f, 0.056f}), 0.04f);
  // Jaw and chin.
  d = SmoothUnion(
      d, RoundCone(q, {0.046f, 1.556f, -0.002f}, 0.0155f, {0.004f, 1.513f, -0.066f}, 0.016f),
      0.035f);
  d = SmoothUnion(d, Ellipsoid(p, {0.0f, 1.5075f, -0.070f}, {0.020f, 0.015f, 0.015f}), 0.02f);
  // Brow, cheekbones, and the sockets between them.
  d = SmoothUnion(
      d, RoundCone(q, {0.004f, 1.629f, -0.0745f}, 0.0085f, {0.045f, 1.628f, -0.056f}, 0.008f),
      0.022f);
  d = SmoothUnion(d, Ellipsoid(q, {0.044f, 1.588f, -0.056f}, {0.018f, 0.013f, 0.017f}), 0.02f);
  d = SmoothIntersection(d, -Ellipsoid(q, {0.0315f, 1.611f, -0.089f}, {0.019f, 0.011f, 0.014f}),
                         0.012f);
  d = SmoothUnion(d, glm::distance(q, kPlainEye) - kEyeRadius, 0.003f);
  // Nose: bridge, tip, wings.
  d = SmoothUnion(
      d, RoundCone(p, {0.0f, 1.622f, -0.079f}, 0.0065f, {0.0f, 1.583f, -0.099f}, 0.0095f), 0.012f);
  d = SmoothUnion(d, Ellipsoid(q, {0.011f, 1.578f, -0.090f}, {0.0075f, 0.0075f, 0.010f}), 0.008f);
  // Lips.
  d = SmoothUnion(d, Ellipsoid(p, {0.0f, 1.5525f, -0.0835f}, {0.023f, 0.0055f, 0.0075f}), 0.006f);
  d = SmoothUnion(d, Ellipsoid(p, {0.0f, 1.5430f, -0.0820f}, {0.020f, 0.0060f, 0.0080f}), 0.006f);
  // Ears.
  const float shell = Ellipsoid(q, {0.0765f, 1.598f, 0.014f}, {0.0075f, 0.031f, 0.019f});
  const float bowl = Ellipsoid(q, {0.0850f, 1.600f, 0.011f}, {0.0070f, 0.019f, 0.010f});
  return SmoothUnion(d, SmoothIntersection(shell, -bowl, 0.005f), 0.008f);
}

// Positive where hair grows: above a plane from the forehead to the nape, and slightly in front
// of the ears.
float HairRegion(const glm::vec3& p) {
  const float hairline = 1.676f - 0.92f * std::max(p.z + 0.068f, 0.0f) -
                         0.010f * glm::smoothstep(0.02f, 0.05f, std::abs(p.x));
  const float sideburn = 0.030f * glm::smoothstep(0.050f, 0.068f, std::abs(p.x)) *
                         (1.0f - glm::smoothstep(0.012f, 0.020f, std::abs(p.z + 0.016f)));
  const float above_ear = 0.022f * glm::smoothstep(0.055f, 0.07f, std::abs(p.x)) *
                          (1.0f - glm::smoothstep(0.015f, 0.035f, std::abs(p.z - 0.014f)));
  return p.y - (hairline - sideburn + above_ear);
}

constexpr float kSoleHeight = 0.012f;

const glm::mat3 kDownAxis(glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1));
const glm::mat3 kForwards(glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0));

// In the footprint the half heights are large, because only its outline matters.
std::vector<Loft::Station> FootStations(bool footprint) {
  struct Section {
    float t, x, half_width, height;
  };
  constexpr Section kSections[] = {
      {0.000f, 0.0955f, 0.022f, 0.040f},  {0.020f, 0.096f, 0.0305f, 0.058f},
      {0.055f, 0.0965f, 0.0325f, 0.075f}, {0.095f, 0.098f, 0.0335f, 0.078f},
      {0.135f, 0.102f, 0.0380f, 0.062f},  {0.175f, 0.105f, 0.0445f, 0.045f},
      {0.205f, 0.105f, 0.0450f, 0.035f},  {0.232f, 0.103f, 0.0390f, 0.027f},
      {0.252f, 0.101f, 0.0270f, 0.022f}};
  std::vector<Loft::Station> stations;
  for (const Section& s : kSections) {
    const float half_height = footprint ? 1.0f : 0.5f * s.height;
    stations.push_back({s.t, {s.x, 0.5f * s.height}, {s.half_width, half_height}, 2.4f});
  }
  return stations;
}

constexpr float kBeltHeight = 1.030f;
constexpr float kShoulderHeight = 1.445f;
constexpr float kSleeveLength = 0.205f;

}  // namespace

// ---- Head and neck ----

float PlainHead(const glm::vec3& p) { return SmoothUnion(Face(p), Neck(p), 0.018f); }

float PlainHair(const glm::vec3& p) {
  // Short locks combed forward from the crown.
  const glm::vec3 q = p - kSkullCenter;
  const float around = std::atan2(q.x, -q.z);
  const float from_crown = std::atan2(glm::length(glm::vec2(q.x, q.z - 0.02f)), q.y);
  const float locks = 0.0014f * std::sin(19.0f * around + 6.0f * std::sin(5.0f * from_crown)) *
                          glm::smoothstep(0.1f, 0.5f, from_crown) +
                      0.0012f * std::sin(16.0f * from_crown + 3.0f * std::sin(4.0f * around));
  const float volume = Ellipsoid(p, kSkullCenter + glm::vec3(0.0f, 0.0f, 0.003f),
                                 kSkullRadii + glm::vec3(0.008f, 0.0075f, 0.010f));
  const float nape = Ellipsoid(p, {0.0f, 1.572f, 0.060f}, {0.060f, 0.050f, 0.042f});
  return SmoothIntersection(SmoothUnion(volume, nape, 0.03f) - locks, -HairRegion(p), 0.010f);
}

// ---- Arm and hand ----

PlainArm::PlainArm(const human::Skeleton& skeleton)
    : shoulder_(RestPosition(skeleton, "r_shoulder")),
      elbow_(RestPosition(skeleton, "r_elbow")),
      wrist_(RestPosition(skeleton, "r_wrist")),
      hand_axes_(LimbAxes(elbow_, wrist_)),
      upper_(shoulder_,
             LimbAxes(shoulder_, elbow_),
             {{-0.03f, {0.0f, 0.0f}, {0.040f, 0.044f}},
              {0.05f, {0.003f, 0.0f}, {0.050f, 0.055f}},
              {0.12f, {0.002f, 0.0f}, {0.046f, 0.053f}},
              {0.20f, {0.0f, 0.0f}, {0.042f, 0.047f}},
              {0.26f, {0.0f, 0.0f}, {0.040f, 0.039f}},
              {0.32f, {0.0f, 0.0f}, {0.037f, 0.035f}}}),
      fore_(elbow_,
            LimbAxes(elbow_, wrist_),
            {{-0.03f, {0.0f, 0.0f}, {0.036f, 0.036f}},
             {0.00f, {0.0f, 0.0f}, {0.040f, 0.038f}},
             {0.06f, {0.002f, 0.0f}, {0.043f, 0.042f}},
             {0.12f, {0.0f, 0.0f}, {0.036f, 0.037f}},
             {0.19f, {0.0f, 0.0f}, {0.025f, 0.030f}},
             {0.235f, {0.0f, 0.0f}, {0.020f, 0.0275f}},
             {0.27f, {0.0f, 0.0f}, {0.018f, 0.028f}}}),
      palm_(wrist_,
            LimbAxes(elbow_, wrist_),
            {{-0.02f, {0.0f, 0.0f}, {0.018f, 0.026f}},
             {0.02f, {-0.001f, 0.0f}, {0.0185f, 0.031f}},
             {0.055f, {-0.002f, 0.0f}, {0.0165f, 0.0395f}},
             {0.085f, {-0.001f, 0.0f}, {0.0135f, 0.0410f}},
             {0.105f, {-0.002f, 0.0f}, {0.0100f, 0.0390f}}}) {}

glm::vec3 PlainArm::direction() const { return glm::normalize(elbow_ - shoulder_); }
// A point of the hand: out of its back, along the fingers, towards the thumb.
glm::vec3 PlainArm::HandPoint(float back, float along, float thumb) const {
  return wrist_ + hand_axes_ * glm::vec3(back, along, -thumb);
}

glm::vec3 PlainArm::InHand(const glm::vec3& p) const {
  const glm::vec3 local = glm::transpose(hand_axes_) * (p - wrist_);
  return {local.x, local.y, -local.z};
}

float PlainArm::Distance(const glm::vec3& p) const {
  const float limb = SmoothUnion(upper_.Distance(p, 0.02f), fore_.Distance(p, 0.02f), 0.03f);
  return SmoothUnion(limb, Hand(p), 0.012f);
}

float PlainArm::Hand(const glm::vec3& p) const {
  float d = palm_.Distance(p, 0.012f);
  d = SmoothUnion(d, Thumb(p), 0.014f);
  return SmoothUnion(d, Fingers(p), 0.006f);
}

float PlainArm::Thumb(const glm::vec3& p) const {
  const glm::vec3 root = HandPoint(-0.006f, 0.022f, 0.024f);
  const glm::vec3 middle = HandPoint(-0.018f, 0.062f, 0.050f);
  const glm::vec3 tip = HandPoint(-0.022f, 0.093f, 0.055f);
  return SmoothUnion(RoundCone(p, root, 0.0155f, middle, 0.0105f),
                     RoundCone(p, middle, 0.0105f, tip, 0.0080f), 0.005f);
}

float PlainArm::Fingers(const glm::vec3& p) const {
  struct Finger {
    float thumb_side, knuckle, length, radius;
  };
  constexpr Finger kFingers[] = {{0.0290f, 0.092f, 0.070f, 0.0092f},
                                 {0.0098f, 0.097f, 0.078f, 0.0094f},
                                 {-0.0095f, 0.094f, 0.073f, 0.0090f},
                                 {-0.0275f, 0.086f, 0.058f, 0.0080f}};
  float d = 1.0f;
  for (const Finger& f : kFingers) {
    // Relaxed fingers bend slightly towards the palm.
    const float fan = 1.06f;
    const glm::vec3 a = HandPoint(-0.001f, f.knuckle - 0.01f, f.thumb_side);
    const glm::vec3 b = HandPoint(-0.008f, f.knuckle + 0.45f * f.length, f.thumb_side * fan);
    const glm::vec3 c = HandPoint(-0.027f, f.knuckle + 0.93f * f.length, f.thumb_side * fan);
    const float finger =
        SmoothUnion(RoundCone(p, a, f.radius, b, 0.95f * f.radius),
                    RoundCone(p, b, 0.95f * f.radius, c, 0.80f * f.radius), 0.004f);
    d = SmoothUnion(d, finger, 0.007f);
  }
  return d;
}

// ---- Leg, foot and sandal ----

PlainLeg::PlainLeg()
    : limb_({0.0f, 0.0f, 0.0f},
            kDownAxis,
            {{-0.86f, {0.090f, 0.000f}, {0.080f, 0.088f}},
             {-0.74f, {0.091f, 0.000f}, {0.076f, 0.082f}},
             {-0.62f, {0.092f, -0.003f}, {0.066f, 0.071f}},
             {-0.54f, {0.093f, -0.005f}, {0.058f, 0.062f}},
             {-0.487f, {0.093f, -0.008f}, {0.0545f, 0.0595f}},
             {-0.445f, {0.093f, -0.004f}, {0.050f, 0.055f}},
             {-0.40f, {0.093f, 0.004f}, {0.0515f, 0.0565f}},
             {-0.345f, {0.092f, 0.010f}, {0.0535f, 0.0590f}},
             {-0.28f, {0.092f, 0.014f}, {0.0475f, 0.0530f}},
             {-0.21f, {0.094f, 0.017f}, {0.0380f, 0.0425f}},
             {-0.14f, {0.096f, 0.020f}, {0.0310f, 0.0360f}},
             {-0.10f, {0.096f, 0.021f}, {0.0310f, 0.0375f}},
             {-0.05f, {0.096f, 0.022f}, {0.0320f, 0.0400f}}}),
      // Along the foot from the heel; the section is width and height above the sole.
      foot_({0.0f, kSoleHeight, 0.072f}, kForwards, FootStations(false)),
      footprint_({0.0f, kSoleHeight, 0.072f}, kForwards, FootStations(true)) {}

float PlainLeg::Distance(const glm::vec3& p) const {
  return SmoothUnion(limb_.Distance(p, 0.02f), Foot(p), 0.03f);
}

float PlainLeg::Sandal(const glm::vec3& p) const {
  const float outline = footprint_.Distance(p, 0.02f) - 0.005f;
  const float sole = SmoothIntersection(outline, std::abs(p.y - 0.008f) - 0.008f, 0.004f);
  const float near_skin = Distance(p) - 0.0045f;
  float d = sole;
  // Straps: around the ankle, over the instep, over the toes.
  const float planes[] = {p.y - 0.105f, (p.z + 0.085f - 0.6f * p.y) / 1.17f,
                          p.z + 0.108f - 0.10f * p.x};
  for (const float plane : planes) {
    d = SmoothUnion(
        d, SmoothIntersection(near_skin, std::max(std::abs(plane) - 0.0105f, p.y - 0.118f), 0.005f),
        0.004f);
  }
  return d;
}

float PlainLeg::Foot(const glm::vec3& p) const {
  float d = foot_.Distance(p, 0.03f);
  for (int toe = 0; toe < 5; ++toe) {
    const float x = 0.0735f + 0.0165f * static_cast<float>(toe) + (toe > 0 ? 0.004f : 0.0f);
    const float z = -0.172f + 0.0022f * static_cast<float>(toe * toe);
    const float radius = toe == 0 ? 0.0125f : 0.0095f - 0.0004f * static_cast<float>(toe);
    d = SmoothUnion(d,
                    RoundCone(p, {x, kSoleHeight + 0.015f, z + 0.03f}, radius,
                              {x, kSoleHeight + 0.0095f, z}, radius),
                    0.006f);
  }
  return SmoothIntersection(d, kSoleHeight - 0.004f - p.y, 0.006f);
}

// ---- Tunic and belt ----

PlainTunic::PlainTunic(const PlainArm& arm)
    : arm_(arm),
      trunk_({0.0f, 0.0f, 0.0f},
             kDownAxis,
             {{-1.425f, {0.0f, 0.030f}, {0.085f, 0.060f}, 2.2f},
              {-1.390f, {0.0f, 0.022f}, {0.150f, 0.088f}, 2.3f},
              {-1.330f, {0.0f, 0.012f}, {0.178f, 0.117f}, 2.4f},
              {-1.250f, {0.0f, 0.006f}, {0.182f, 0.126f}, 2.4f},
              {-1.160f, {0.0f, 0.006f}, {0.172f, 0.122f}, 2.3f},
              {-1.085f, {0.0f, 0.004f}, {0.172f, 0.124f}, 2.2f},
              {-1.055f, {0.0f, 0.005f}, {0.162f, 0.116f}, 2.2f},
              {-1.030f, {0.0f, 0.006f}, {0.152f, 0.107f}, 2.2f},
              {-1.000f, {0.0f, 0.007f}, {0.160f, 0.113f}, 2.2f},
              {-0.930f, {0.0f, 0.010f}, {0.178f, 0.130f}, 2.2f},
              {-0.860f, {0.0f, 0.010f}, {0.187f, 0.138f}, 2.2f},
              {-0.740f, {0.0f, 0.006f}, {0.196f, 0.145f}, 2.2f},
              {-0.600f, {0.0f, 0.004f}, {0.208f, 0.157f}, 2.2f},
              {-kPlainHem, {0.0f, 0.004f}, {0.217f, 0.166f}, 2.2f}}) {}

float PlainTunic::Distance(const glm::vec3& p) const {
  float d = SmoothUnion(Trunk(p), Sleeve(p), 0.06f);
  // Hollow from below, open around the neck and at the sleeves.
  d = SmoothIntersection(d, -HollowBelow(p), 0.014f);
  d = SmoothIntersection(d, -Neckline(p), 0.014f);
  return SmoothIntersection(d, -HollowSleeve(p), 0.014f);
}

float PlainTunic::Belt(const glm::vec3& p) const {
  const float band = SmoothIntersection(trunk_.SideDistance(p) - 0.008f,
                                        std::abs(p.y - kBeltHeight) - 0.019f, 0.009f);
  const glm::vec3 knot(0.025f, kBeltHeight, -0.107f);
  const float tie = SmoothUnion(
      Ellipsoid(p, knot, {0.017f, 0.017f, 0.012f}),
      SmoothUnion(RoundCone(p, knot, 0.009f, knot + glm::vec3(0.012f, -0.115f, -0.022f), 0.0065f),
                  RoundCone(p, knot, 0.009f, knot + glm::vec3(-0.010f, -0.085f, -0.020f), 0.0065f),
                  0.006f),
      0.006f);
  return SmoothUnion(band, tie, 0.006f);
}

// The trunk with folds that hang from the belt and, more weakly, rise from it.
float PlainTunic::Cloth(const glm::vec3& p) const {
  const float around = std::atan2(p.x, -p.z);
  const float wave = 0.55f * std::sin(9.0f * around + 1.2f * std::sin(2.0f * around + 0.7f)) +
                     0.35f * std::sin(15.0f * around + 2.0f) +
                     0.25f * std::sin(5.0f * around + 6.0f * p.y);
  const float skirt = 0.0125f * glm::smoothstep(1.01f, 0.55f, p.y);
  const float bodice =
      0.0055f * glm::smoothstep(1.04f, 1.09f, p.y) * glm::smoothstep(1.34f, 1.12f, p.y);
  return trunk_.SideDistance(p) - (skirt + bodice) * wave;
}

float PlainTunic::Trunk(const glm::vec3& p) const {
  const float ends = std::max(p.y - kShoulderHeight, kPlainHem - p.y);
  return SmoothIntersection(Cloth(p), ends, 0.016f);
}

glm::vec3 PlainTunic::SleeveAxis(float t) const {
  return arm_.shoulder() + t * arm_.direction() + glm::vec3(0.0f, -0.10f * t, 0.0f);
}

// Distance along the sleeve from the shoulder, metres.
float PlainTunic::Along(const glm::vec3& q) const {
  return glm::dot(q - arm_.shoulder(), arm_.direction());
}

float PlainTunic::SleeveTube(const glm::vec3& q) const {
  const glm::vec3 local = q - arm_.shoulder();
  const glm::vec3 outward(-arm_.direction().y, arm_.direction().x, 0.0f);
  const float around = std::atan2(local.z, glm::dot(local, outward));
  const float folds =
      0.004f * std::sin(6.0f * around + 15.0f * local.x) * glm::smoothstep(0.02f, 0.14f, Along(q));
  return RoundCone(q, SleeveAxis(0.0f), 0.0565f, SleeveAxis(0.26f), 0.076f) - folds;
}

float PlainTunic::Sleeve(const glm::vec3& p) const {
  const glm::vec3 q = FoldX(p);
  const float yoke =
      RoundCone(q, {0.055f, 1.412f, 0.030f}, 0.038f, {0.155f, 1.392f, 0.018f}, 0.051f);
  return SmoothIntersection(SmoothUnion(yoke, SleeveTube(q), 0.03f), Along(q) - kSleeveLength,
                            0.010f);
}

float PlainTunic::HollowSleeve(const glm::vec3& p) const {
  const glm::vec3 q = FoldX(p);
  return SmoothIntersection(SleeveTube(q) + 0.026f, kSleeveLength - 0.05f - Along(q), 0.02f);
}

float PlainTunic::HollowBelow(const glm::vec3& p) const {
  return SmoothIntersection(Cloth(p) + 0.024f, p.y - (kPlainHem + 0.13f), 0.03f);
}

float PlainTunic::Neckline(const glm::vec3& p) const {
  return Ellipsoid(p, {0.0f, 1.475f, -0.022f}, {0.088f, 0.075f, 0.105f});
}

}  // namespace lararium::import
