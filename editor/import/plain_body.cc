#include "editor/import/plain_body.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "editor/import/implicit_surface.h"
#include "editor/import/plain_skeleton.h"
#include "shared/core/parallel.h"

namespace lararium::import {
namespace {

using Weights = std::vector<std::pair<size_t, float>>;  // joint, weight; any sum

// One closed surface of a part.
struct Piece {
  size_t part;
  DistanceField solid;  // what is triangulated
  Box box;
  float cell;  // metres
  // Where pieces overlap they take normals from the solid that they share, so
  // that no seam shows.
  DistanceField shading;
  std::function<glm::vec3(const glm::vec3&)> albedo;
  std::function<Weights(const glm::vec3&)> weights;
  bool both_sides = false;  // modelled on the right, mirrored to the left
};

enum Part : size_t { kSkinPart, kHairPart, kTunicPart, kBeltPart, kSandalsPart, kPartCount };
constexpr const char* kPartNames[kPartCount] = {"skin", "hair", "tunic", "belt", "sandals"};

float Smoothstep(float low, float high, float x) { return glm::smoothstep(low, high, x); }

glm::vec3 FoldX(const glm::vec3& p) { return {std::abs(p.x), p.y, p.z}; }

// Axes of a limb segment: across (outwards), along it, across (backwards).
glm::mat3 LimbAxes(const glm::vec3& from, const glm::vec3& to) {
  const glm::vec3 along = glm::normalize(to - from);
  const glm::vec3 outward = glm::normalize(glm::cross(along, glm::vec3(0.0f, 0.0f, 1.0f)));
  const glm::vec3 side = glm::dot(outward, glm::vec3(1.0f, 0.0f, 0.0f)) > 0.0f ? outward : -outward;
  return glm::mat3(side, along, glm::cross(side, along));
}

// ---- Head and neck -------------------------------------------------------

constexpr glm::vec3 kSkullCenter(0.0f, 1.628f, 0.012f);
constexpr glm::vec3 kSkullRadii(0.0745f, 0.086f, 0.093f);
constexpr glm::vec3 kEye(0.0315f, 1.611f, -0.0665f);  // of the right side
constexpr float kEyeRadius = 0.0125f;

float Neck(const glm::vec3& p) {
  float d = RoundCone(p, {0.0f, 1.39f, 0.036f}, 0.061f, {0.0f, 1.56f, 0.018f}, 0.0515f);
  // Trapezius, clavicles and the upper chest, seen in the neckline.
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
  d = SmoothUnion(d, glm::distance(q, kEye) - kEyeRadius, 0.003f);
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

float HeadAndNeck(const glm::vec3& p) { return SmoothUnion(Face(p), Neck(p), 0.018f); }

// Positive where hair grows: above a plane from the forehead to the nape, and a
// little in front of the ears.
float HairRegion(const glm::vec3& p) {
  const float hairline = 1.676f - 0.92f * std::max(p.z + 0.068f, 0.0f) -
                         0.010f * Smoothstep(0.02f, 0.05f, std::abs(p.x));
  const float sideburn = 0.030f * Smoothstep(0.050f, 0.068f, std::abs(p.x)) *
                         (1.0f - Smoothstep(0.012f, 0.020f, std::abs(p.z + 0.016f)));
  const float above_ear = 0.022f * Smoothstep(0.055f, 0.07f, std::abs(p.x)) *
                          (1.0f - Smoothstep(0.015f, 0.035f, std::abs(p.z - 0.014f)));
  return p.y - (hairline - sideburn + above_ear);
}

float Hair(const glm::vec3& p) {
  // Short locks combed forward from the crown.
  const glm::vec3 q = p - kSkullCenter;
  const float around = std::atan2(q.x, -q.z);
  const float from_crown = std::atan2(glm::length(glm::vec2(q.x, q.z - 0.02f)), q.y);
  const float locks = 0.0014f * std::sin(19.0f * around + 6.0f * std::sin(5.0f * from_crown)) *
                          Smoothstep(0.1f, 0.5f, from_crown) +
                      0.0012f * std::sin(16.0f * from_crown + 3.0f * std::sin(4.0f * around));
  const float volume = Ellipsoid(p, kSkullCenter + glm::vec3(0.0f, 0.0f, 0.003f),
                                 kSkullRadii + glm::vec3(0.008f, 0.0075f, 0.010f));
  const float nape = Ellipsoid(p, {0.0f, 1.572f, 0.060f}, {0.060f, 0.050f, 0.042f});
  return SmoothIntersection(SmoothUnion(volume, nape, 0.03f) - locks, -HairRegion(p), 0.010f);
}

// ---- Arm and hand, of the right side ----------------------------------------

class ArmShape {
 public:
  explicit ArmShape(const human::Skeleton& skeleton)
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

  const glm::vec3& shoulder() const { return shoulder_; }
  glm::vec3 direction() const { return glm::normalize(elbow_ - shoulder_); }
  // A point of the hand: back of the hand, fingers, thumb side.
  glm::vec3 HandPoint(float back, float along, float thumb) const {
    return wrist_ + hand_axes_ * glm::vec3(back, along, -thumb);
  }
  glm::vec3 InHand(const glm::vec3& p) const {
    const glm::vec3 local = glm::transpose(hand_axes_) * (p - wrist_);
    return {local.x, local.y, -local.z};
  }

  float Distance(const glm::vec3& p) const {
    const float limb = SmoothUnion(upper_.Distance(p, 0.02f), fore_.Distance(p, 0.02f), 0.03f);
    return SmoothUnion(limb, Hand(p), 0.012f);
  }

  // Positive on the hand's side of the wrist.
  float BeyondWrist(const glm::vec3& p) const { return InHand(p).y; }

 private:
  float Hand(const glm::vec3& p) const {
    float d = palm_.Distance(p, 0.012f);
    d = SmoothUnion(d, Thumb(p), 0.014f);
    return SmoothUnion(d, Fingers(p), 0.006f);
  }

  float Thumb(const glm::vec3& p) const {
    const glm::vec3 root = HandPoint(-0.006f, 0.022f, 0.024f);
    const glm::vec3 middle = HandPoint(-0.018f, 0.062f, 0.050f);
    const glm::vec3 tip = HandPoint(-0.022f, 0.093f, 0.055f);
    return SmoothUnion(RoundCone(p, root, 0.0155f, middle, 0.0105f),
                       RoundCone(p, middle, 0.0105f, tip, 0.0080f), 0.005f);
  }

  float Fingers(const glm::vec3& p) const {
    struct Finger {
      float thumb_side, knuckle, length, radius;
    };
    constexpr Finger kFingers[] = {{0.0290f, 0.092f, 0.070f, 0.0092f},
                                   {0.0098f, 0.097f, 0.078f, 0.0094f},
                                   {-0.0095f, 0.094f, 0.073f, 0.0090f},
                                   {-0.0275f, 0.086f, 0.058f, 0.0080f}};
    float d = 1.0f;
    for (const Finger& f : kFingers) {
      // Relaxed: each finger bends a little towards the palm.
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

  glm::vec3 shoulder_, elbow_, wrist_;
  glm::mat3 hand_axes_;
  Loft upper_, fore_, palm_;
};

// ---- Leg, foot and sandal, of the right side -----------------------------------

constexpr float kSoleHeight = 0.012f;

const glm::mat3 kDownwards(glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1));
const glm::mat3 kForwards(glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0));

class LegShape {
 public:
  LegShape()
      : limb_({0.0f, 0.0f, 0.0f},
              kDownwards,
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
        // Along the foot, from the heel: across and height, above the sole.
        foot_({0.0f, kSoleHeight, 0.072f}, kForwards, FootStations(false)),
        footprint_({0.0f, kSoleHeight, 0.072f}, kForwards, FootStations(true)) {}

  float Distance(const glm::vec3& p) const {
    return SmoothUnion(limb_.Distance(p, 0.02f), Foot(p), 0.03f);
  }

  float Sandal(const glm::vec3& p) const {
    const float outline = footprint_.Distance(p, 0.02f) - 0.005f;
    const float sole = SmoothIntersection(outline, std::abs(p.y - 0.008f) - 0.008f, 0.004f);
    const float near_skin = Distance(p) - 0.0045f;
    float d = sole;
    // Straps: around the ankle, over the instep, over the toes.
    const float planes[] = {p.y - 0.105f, (p.z + 0.085f - 0.6f * p.y) / 1.17f,
                            p.z + 0.108f - 0.10f * p.x};
    for (const float plane : planes) {
      d = SmoothUnion(
          d,
          SmoothIntersection(near_skin, std::max(std::abs(plane) - 0.0105f, p.y - 0.118f), 0.005f),
          0.004f);
    }
    return d;
  }

 private:
  // Half heights of the footprint are large: only its outline counts.
  static std::vector<Loft::Station> FootStations(bool footprint) {
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

  float Foot(const glm::vec3& p) const {
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

  Loft limb_, foot_, footprint_;
};

// ---- Tunic and belt -------------------------------------------------------------

constexpr float kBeltHeight = 1.030f;
constexpr float kHemHeight = 0.490f;
constexpr float kShoulderHeight = 1.445f;
constexpr float kSleeveLength = 0.205f;

class TunicShape {
 public:
  explicit TunicShape(const ArmShape& arm)
      : arm_(arm),
        trunk_({0.0f, 0.0f, 0.0f},
               kDownwards,
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
                {-kHemHeight, {0.0f, 0.004f}, {0.217f, 0.166f}, 2.2f}}) {}

  float Distance(const glm::vec3& p) const {
    float d = SmoothUnion(Trunk(p), Sleeve(p), 0.06f);
    // Hollow from below, open around the neck and at the sleeves.
    d = SmoothIntersection(d, -HollowBelow(p), 0.014f);
    d = SmoothIntersection(d, -Neckline(p), 0.014f);
    return SmoothIntersection(d, -HollowSleeve(p), 0.014f);
  }

  float Belt(const glm::vec3& p) const {
    const float band = SmoothIntersection(trunk_.SideDistance(p) - 0.008f,
                                          std::abs(p.y - kBeltHeight) - 0.019f, 0.009f);
    const glm::vec3 knot(0.025f, kBeltHeight, -0.107f);
    const float tie = SmoothUnion(
        Ellipsoid(p, knot, {0.017f, 0.017f, 0.012f}),
        SmoothUnion(
            RoundCone(p, knot, 0.009f, knot + glm::vec3(0.012f, -0.115f, -0.022f), 0.0065f),
            RoundCone(p, knot, 0.009f, knot + glm::vec3(-0.010f, -0.085f, -0.020f), 0.0065f),
            0.006f),
        0.006f);
    return SmoothUnion(band, tie, 0.006f);
  }

 private:
  // The trunk with its folds: they hang from the belt and, more weakly, rise
  // from it.
  float Cloth(const glm::vec3& p) const {
    const float around = std::atan2(p.x, -p.z);
    const float wave = 0.55f * std::sin(9.0f * around + 1.2f * std::sin(2.0f * around + 0.7f)) +
                       0.35f * std::sin(15.0f * around + 2.0f) +
                       0.25f * std::sin(5.0f * around + 6.0f * p.y);
    const float skirt = 0.0125f * Smoothstep(1.01f, 0.55f, p.y);
    const float bodice = 0.0055f * Smoothstep(1.04f, 1.09f, p.y) * Smoothstep(1.34f, 1.12f, p.y);
    return trunk_.SideDistance(p) - (skirt + bodice) * wave;
  }

  float Trunk(const glm::vec3& p) const {
    const float ends = std::max(p.y - kShoulderHeight, kHemHeight - p.y);
    return SmoothIntersection(Cloth(p), ends, 0.016f);
  }

  glm::vec3 SleeveAxis(float t) const {
    return arm_.shoulder() + t * arm_.direction() + glm::vec3(0.0f, -0.10f * t, 0.0f);
  }
  // Along the sleeve, from the shoulder, metres.
  float Along(const glm::vec3& q) const { return glm::dot(q - arm_.shoulder(), arm_.direction()); }
  float SleeveTube(const glm::vec3& q) const {
    const glm::vec3 local = q - arm_.shoulder();
    const glm::vec3 outward(-arm_.direction().y, arm_.direction().x, 0.0f);
    const float around = std::atan2(local.z, glm::dot(local, outward));
    const float folds =
        0.004f * std::sin(6.0f * around + 15.0f * local.x) * Smoothstep(0.02f, 0.14f, Along(q));
    return RoundCone(q, SleeveAxis(0.0f), 0.0565f, SleeveAxis(0.26f), 0.076f) - folds;
  }
  float Sleeve(const glm::vec3& p) const {
    const glm::vec3 q = FoldX(p);
    const float yoke =
        RoundCone(q, {0.055f, 1.412f, 0.030f}, 0.038f, {0.155f, 1.392f, 0.018f}, 0.051f);
    return SmoothIntersection(SmoothUnion(yoke, SleeveTube(q), 0.03f), Along(q) - kSleeveLength,
                              0.010f);
  }
  float HollowSleeve(const glm::vec3& p) const {
    const glm::vec3 q = FoldX(p);
    return SmoothIntersection(SleeveTube(q) + 0.026f, kSleeveLength - 0.05f - Along(q), 0.02f);
  }
  float HollowBelow(const glm::vec3& p) const {
    return SmoothIntersection(Cloth(p) + 0.024f, p.y - (kHemHeight + 0.13f), 0.03f);
  }
  float Neckline(const glm::vec3& p) const {
    return Ellipsoid(p, {0.0f, 1.475f, -0.022f}, {0.088f, 0.075f, 0.105f});
  }

  const ArmShape& arm_;
  Loft trunk_;
};

// ---- Skin weights ---------------------------------------------------------------

// The joint of the left side that answers to one of the right.
size_t MirroredJoint(const human::Skeleton& skeleton, size_t joint) {
  const std::string& name = skeleton.names[joint];
  return name.starts_with("r_") ? JointIndex(skeleton, "l_" + name.substr(2)) : joint;
}

struct Link {
  size_t joint;
  glm::vec3 position;
  glm::vec3 direction;  // unit, across the plane where the joint takes over
  float half_width;     // of the blend, metres
};

// Along a chain of joints each takes over from the one before where the chain
// bends, so that only neighbours share a vertex.
Weights ChainWeights(const glm::vec3& p, const std::vector<Link>& chain) {
  Weights weights;
  float remaining = 1.0f;
  for (size_t i = chain.size(); i-- > 1;) {
    const Link& link = chain[i];
    const float share =
        Smoothstep(-link.half_width, link.half_width, glm::dot(p - link.position, link.direction));
    weights.emplace_back(link.joint, remaining * share);
    remaining *= 1.0f - share;
  }
  weights.emplace_back(chain.front().joint, remaining);
  return weights;
}

Weights Mix(const Weights& a, const Weights& b, float share_of_b) {
  Weights mixed;
  for (const auto& [joint, weight] : a) {
    mixed.emplace_back(joint, weight * (1.0f - share_of_b));
  }
  for (const auto& [joint, weight] : b) {
    mixed.emplace_back(joint, weight * share_of_b);
  }
  return mixed;
}

class Rig {
 public:
  explicit Rig(const human::Skeleton& skeleton) : skeleton_(skeleton) {
    const glm::vec3 up(0.0f, 1.0f, 0.0f), down(0.0f, -1.0f, 0.0f);
    spine_ = {Joint("sacroiliac", up, 0.0f), Joint("vl5", up, 0.06f),  Joint("vt10", up, 0.08f),
              Joint("vt4", up, 0.08f),       Joint("vc4", up, 0.035f), HeadLink()};
    leg_ = {Joint("sacroiliac", down, 0.0f), Joint("r_hip", down, 0.06f),
            Joint("r_knee", down, 0.045f), Joint("r_ankle", {0.0f, -0.8f, -0.6f}, 0.030f),
            Joint("r_midtarsal", {0.0f, 0.0f, -1.0f}, 0.025f)};
    const glm::vec3 upper = Direction("r_shoulder", "r_elbow");
    const glm::vec3 fore = Direction("r_elbow", "r_wrist");
    arm_ = {Joint("r_sternoclavicular", upper, 0.0f), Joint("r_shoulder", upper, 0.05f),
            Joint("r_elbow", glm::normalize(upper + fore), 0.035f), Joint("r_wrist", fore, 0.022f),
            Joint("r_middle1", fore, 0.012f)};
    thumb_ = skeleton.Find("r_thumb1").value();
    for (size_t i = 0; i < 6; ++i) {
      skirt_[i] = JointIndex(skeleton, kSkirtJoints[i]);
    }
  }

  Weights Spine(const glm::vec3& p) const { return ChainWeights(p, spine_); }
  Weights Leg(const glm::vec3& p) const { return ChainWeights(p, leg_); }

  Weights Arm(const glm::vec3& p, const ArmShape& arm) const;

  Weights Cloth(const glm::vec3& p) const {
    const Weights trunk = Mix(Spine(p), Skirt(p), Smoothstep(0.94f, 0.80f, p.y));
    const glm::vec3 q = FoldX(p);
    const Weights sleeve =
        p.x >= 0.0f ? ChainWeights(q, arm_) : MirrorJoints(ChainWeights(q, arm_));
    // A plane through the armpit, leaning with the space between arm and trunk.
    const float beyond =
        glm::dot(q - glm::vec3(0.172f, 1.36f, 0.0f), glm::vec3(0.985f, 0.174f, 0.0f));
    const float share = Smoothstep(-0.055f, 0.035f, beyond) * Smoothstep(1.02f, 1.10f, p.y);
    return Mix(trunk, sleeve, share);
  }

  Weights MirrorJoints(Weights weights) const {
    for (auto& [joint, weight] : weights) {
      joint = MirroredJoint(skeleton_, joint);
    }
    return weights;
  }

 private:
  Link Joint(const char* name, const glm::vec3& direction, float half_width) const {
    return {JointIndex(skeleton_, name), RestPosition(skeleton_, name), glm::normalize(direction),
            half_width};
  }
  // The head ends at the jaw's edge, which leans.
  Link HeadLink() const {
    return {JointIndex(skeleton_, "skullbase"),
            {0.0f, 1.530f, 0.0f},
            glm::normalize(glm::vec3(0.0f, 0.86f, -0.50f)),
            0.030f};
  }
  glm::vec3 Direction(const char* from, const char* to) const {
    return glm::normalize(RestPosition(skeleton_, to) - RestPosition(skeleton_, from));
  }

  // Between the two panels on either side of the vertex.
  Weights Skirt(const glm::vec3& p) const {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float around = std::atan2(p.x, -p.z);  // 0 in front, positive to the right
    const float panel = (around < 0.0f ? around + 2.0f * kPi : around) / (kPi / 3.0f) - 0.5f;
    const float floor = std::floor(panel);
    const size_t first = static_cast<size_t>(static_cast<int>(floor) + 6) % 6;
    const float share = Smoothstep(0.0f, 1.0f, panel - floor);
    return {{skirt_[first], 1.0f - share}, {skirt_[(first + 1) % 6], share}};
  }

  const human::Skeleton& skeleton_;
  std::vector<Link> spine_, leg_, arm_;
  size_t thumb_ = 0;
  size_t skirt_[6] = {};
};

Weights Rig::Arm(const glm::vec3& p, const ArmShape& arm) const {
  const Weights limb = ChainWeights(p, arm_);
  const glm::vec3 q = arm.InHand(p);
  // The thumb's side of a line from its root to the cleft beside the index finger.
  const float thumb_side = q.z - (0.028f + 0.25f * (q.y - 0.02f));
  const float share = Smoothstep(-0.004f, 0.012f, thumb_side) * Smoothstep(0.005f, 0.035f, q.y) *
                      (1.0f - Smoothstep(0.098f, 0.112f, q.y));
  return Mix(limb, {{thumb_, 1.0f}}, share);
}

// ---- Colours -------------------------------------------------------------------

glm::vec3 FaceAlbedo(const glm::vec3& p, const PlainFigureOptions& options) {
  const glm::vec3 q = FoldX(p);
  glm::vec3 albedo = options.skin;
  const auto paint = [&](const glm::vec3& colour, float share) {
    albedo = glm::mix(albedo, colour, glm::clamp(share, 0.0f, 1.0f));
  };
  if (p.z > 0.0f) {
    return albedo;
  }
  const float cheek = glm::length((q - glm::vec3(0.042f, 1.575f, -0.065f)) / 0.026f);
  paint(options.skin * glm::vec3(1.10f, 0.86f, 0.82f), 0.6f * (1.0f - cheek));
  const float beard = Smoothstep(1.566f, 1.545f, p.y) * Smoothstep(1.485f, 1.505f, p.y);
  paint(options.skin * 0.72f, 0.45f * beard);
  const glm::vec2 mouth((q.x) / 0.023f, (p.y - 1.5485f) / 0.0095f);
  paint(options.skin * glm::vec3(0.82f, 0.58f, 0.58f), 3.0f * (1.0f - glm::length(mouth)));
  const float lip_line = std::abs(p.y - 1.5480f + 2.0f * q.x * q.x);
  paint(options.skin * 0.30f, (1.0f - lip_line / 0.0028f) * Smoothstep(0.026f, 0.020f, q.x));
  const glm::vec2 brow((q.x - 0.031f) / 0.022f,
                       (p.y - 1.631f + 4.0f * (q.x - 0.034f) * (q.x - 0.034f)) / 0.0065f);
  paint(options.hair, 2.0f * (1.0f - glm::length(brow)));
  const glm::vec2 lid((q.x - kEye.x) / 0.0155f, (p.y - kEye.y) / 0.0070f);
  paint(options.skin * 0.35f, 2.5f * (1.0f - glm::length(lid)));
  const glm::vec2 ball((q.x - kEye.x) / 0.0125f, (p.y - kEye.y) / 0.0042f);
  paint(glm::vec3(0.42f, 0.39f, 0.36f), 3.0f * (1.0f - glm::length(ball)));
  const glm::vec2 iris((q.x - kEye.x) / 0.0058f, (p.y - kEye.y) / 0.0060f);
  paint(glm::vec3(0.045f, 0.028f, 0.018f), 4.0f * (1.0f - glm::length(iris)));
  return albedo;
}

glm::vec3 TunicAlbedo(const glm::vec3& p, const PlainFigureOptions& options) {
  // Two clavi run over the shoulders to the hem, which has a band of its own.
  const float spread = 0.078f + 0.030f * Smoothstep(1.0f, kHemHeight, p.y);
  const float clavus = std::abs(std::abs(p.x) - spread) - 0.011f;
  const float hem = std::abs(p.y - (kHemHeight + 0.040f)) - 0.011f;
  const float stripe = Smoothstep(0.006f, -0.005f, std::min(clavus, hem));
  return glm::mix(options.tunic, options.stripe, stripe);
}

// ---- Assembly -------------------------------------------------------------------

// All that the pieces refer to.
struct Body {
  Body(const human::Skeleton& skeleton, const PlainFigureOptions& figure_options)
      : options(figure_options), arm(skeleton), tunic(arm), rig(skeleton) {}

  PlainFigureOptions options;
  ArmShape arm;
  LegShape leg;
  TunicShape tunic;
  Rig rig;
};

// The face has finer cells than the rest of the head.
void AddHead(const Body& body, std::vector<Piece>& pieces) {
  const auto albedo = [&body](const glm::vec3& p) { return FaceAlbedo(p, body.options); };
  const auto weights = [&body](const glm::vec3& p) { return body.rig.Spine(p); };
  const auto face_side = [](const glm::vec3& p) {
    return std::max({p.z + 0.030f, 1.498f - p.y, p.y - 1.69f});
  };
  const DistanceField face = [=](const glm::vec3& p) {
    return SmoothIntersection(HeadAndNeck(p), face_side(p), 0.004f);
  };
  const DistanceField rest = [=](const glm::vec3& p) {
    return SmoothIntersection(HeadAndNeck(p), -face_side(p) - 0.010f, 0.006f);
  };
  pieces.push_back({kSkinPart,
                    face,
                    {{-0.08f, 1.48f, -0.13f}, {0.08f, 1.70f, -0.02f}},
                    0.0036f,
                    HeadAndNeck,
                    albedo,
                    weights});
  pieces.push_back({kSkinPart,
                    rest,
                    {{-0.19f, 1.21f, -0.10f}, {0.19f, 1.73f, 0.14f}},
                    0.0100f,
                    HeadAndNeck,
                    albedo,
                    weights});
  pieces.push_back({kHairPart,
                    Hair,
                    {{-0.11f, 1.50f, -0.12f}, {0.11f, 1.74f, 0.14f}},
                    0.0085f,
                    Hair,
                    [&body](const glm::vec3&) { return body.options.hair; },
                    weights});
}

void AddArms(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField whole = [&body](const glm::vec3& p) { return body.arm.Distance(p); };
  const auto albedo = [&body](const glm::vec3&) { return body.options.skin; };
  const auto weights = [&body](const glm::vec3& p) { return body.rig.Arm(p, body.arm); };
  const DistanceField limb = [&body, whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), body.arm.BeyondWrist(p) - 0.004f, 0.003f);
  };
  const DistanceField hand = [&body, whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), -body.arm.BeyondWrist(p) - 0.004f, 0.003f);
  };
  pieces.push_back({kSkinPart,
                    limb,
                    {{0.10f, 0.90f, -0.08f}, {0.52f, 1.47f, 0.11f}},
                    0.0120f,
                    whole,
                    albedo,
                    weights,
                    true});
  pieces.push_back({kSkinPart,
                    hand,
                    {{0.38f, 0.73f, -0.13f}, {0.58f, 0.96f, 0.07f}},
                    0.0065f,
                    whole,
                    albedo,
                    weights,
                    true});
}

void AddLegs(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField whole = [&body](const glm::vec3& p) { return body.leg.Distance(p); };
  const DistanceField sandal = [&body](const glm::vec3& p) { return body.leg.Sandal(p); };
  const auto weights = [&body](const glm::vec3& p) { return body.rig.Leg(p); };
  const DistanceField limb = [whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), 0.101f - p.y, 0.004f);
  };
  const DistanceField foot = [whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), p.y - 0.109f, 0.004f);
  };
  const auto skin = [&body](const glm::vec3&) { return body.options.skin; };
  pieces.push_back({kSkinPart,
                    limb,
                    {{0.0f, 0.08f, -0.10f}, {0.19f, 0.88f, 0.11f}},
                    0.0170f,
                    whole,
                    skin,
                    weights,
                    true});
  pieces.push_back({kSkinPart,
                    foot,
                    {{0.03f, 0.0f, -0.21f}, {0.17f, 0.16f, 0.10f}},
                    0.0085f,
                    whole,
                    skin,
                    weights,
                    true});
  pieces.push_back({kSandalsPart,
                    sandal,
                    {{0.02f, -0.01f, -0.22f}, {0.18f, 0.18f, 0.11f}},
                    0.0070f,
                    sandal,
                    [&body](const glm::vec3&) { return body.options.sandals; },
                    weights,
                    true});
}

void AddClothes(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField tunic = [&body](const glm::vec3& p) { return body.tunic.Distance(p); };
  const DistanceField belt = [&body](const glm::vec3& p) { return body.tunic.Belt(p); };
  const auto weights = [&body](const glm::vec3& p) { return body.rig.Cloth(p); };
  pieces.push_back({kTunicPart,
                    tunic,
                    {{-0.42f, 0.46f, -0.22f}, {0.42f, 1.50f, 0.22f}},
                    0.0130f,
                    tunic,
                    [&body](const glm::vec3& p) { return TunicAlbedo(p, body.options); },
                    weights});
  pieces.push_back({kBeltPart,
                    belt,
                    {{-0.19f, 0.89f, -0.16f}, {0.19f, 1.07f, 0.14f}},
                    0.0085f,
                    belt,
                    [&body](const glm::vec3&) { return body.options.belt; },
                    weights});
}

// Sums the shares of each joint, keeps the four largest and lets them sum to 1.
void StoreWeights(Weights shares, human::SkinnedMesh& mesh) {
  std::sort(shares.begin(), shares.end());
  Weights merged;
  for (const auto& [joint, weight] : shares) {
    if (!merged.empty() && merged.back().first == joint) {
      merged.back().second += weight;
    } else {
      merged.emplace_back(joint, weight);
    }
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  merged.resize(4);
  const float sum = merged[0].second + merged[1].second + merged[2].second + merged[3].second;
  std::array<uint8_t, 4> joints;
  glm::vec4 weights;
  for (int k = 0; k < 4; ++k) {
    joints[k] = static_cast<uint8_t>(merged[k].first);
    weights[k] = merged[k].second / sum;
  }
  mesh.joints.push_back(joints);
  mesh.weights.push_back(weights);
}

human::SkinnedMesh BuildPiece(const Piece& piece) {
  geometry::TriangleMesh surface = Polygonise(piece.solid, piece.box, piece.cell);
  human::SkinnedMesh mesh;
  for (size_t v = 0; v < surface.positions.size(); ++v) {
    const glm::vec3& p = surface.positions[v];
    // Not on the caps that close a piece inside the shared solid.
    const bool on_shared = std::abs(piece.shading(p)) < 0.008f;
    mesh.normals.push_back(on_shared ? FieldNormal(piece.shading, p) : surface.normals[v]);
    mesh.albedo.push_back(piece.albedo(p));
    StoreWeights(piece.weights(p), mesh);
  }
  mesh.positions = std::move(surface.positions);
  mesh.indices = std::move(surface.indices);
  return mesh;
}

human::SkinnedMesh Mirrored(human::SkinnedMesh mesh, const human::Skeleton& skeleton) {
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v].x = -mesh.positions[v].x;
    mesh.normals[v].x = -mesh.normals[v].x;
    for (uint8_t& joint : mesh.joints[v]) {
      joint = static_cast<uint8_t>(MirroredJoint(skeleton, joint));
    }
  }
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

void AppendMesh(const human::SkinnedMesh& from, human::SkinnedMesh& to) {
  const uint32_t first = static_cast<uint32_t>(to.positions.size());
  const auto append = [](const auto& a, auto& b) { b.insert(b.end(), a.begin(), a.end()); };
  append(from.positions, to.positions);
  append(from.normals, to.normals);
  append(from.albedo, to.albedo);
  append(from.joints, to.joints);
  append(from.weights, to.weights);
  for (const uint32_t index : from.indices) {
    to.indices.push_back(first + index);
  }
}

}  // namespace

std::vector<human::SkinnedMesh> PlainMeshes(const human::Skeleton& skeleton,
                                            const PlainFigureOptions& options) {
  const Body body(skeleton, options);
  std::vector<Piece> pieces;
  AddHead(body, pieces);
  AddArms(body, pieces);
  AddLegs(body, pieces);
  AddClothes(body, pieces);
  std::vector<human::SkinnedMesh> surfaces(pieces.size());
  ParallelFor(pieces.size(), [&](size_t i) { surfaces[i] = BuildPiece(pieces[i]); });
  std::vector<human::SkinnedMesh> parts(kPartCount);
  for (size_t i = 0; i < kPartCount; ++i) {
    parts[i].name = kPartNames[i];
  }
  for (size_t i = 0; i < pieces.size(); ++i) {
    human::SkinnedMesh& part = parts[pieces[i].part];
    AppendMesh(surfaces[i], part);
    if (pieces[i].both_sides) {
      AppendMesh(Mirrored(std::move(surfaces[i]), skeleton), part);
    }
  }
  return parts;
}

}  // namespace lararium::import
