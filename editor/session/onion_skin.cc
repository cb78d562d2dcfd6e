#include "editor/session/onion_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace lararium::editor {

namespace {

constexpr float kNearest = 0.65f;  // Opacity of the nearest skin.
constexpr float kFade = 0.65f;     // Factor from one skin to the next.
constexpr float kMove = 0.01f;     // metres
// Points in the frame of an actor or of an object's part: its origin and two others at body height.
constexpr std::array<glm::vec4, 3> kPoints = {
    glm::vec4(0.0f, 0.0f, 0.0f, 1.0f), {0.3f, 1.0f, 0.0f, 1.0f}, {-0.3f, 1.6f, 0.2f, 1.0f}};

bool Moved(const glm::mat4& a, const glm::mat4& b) {
  return std::any_of(kPoints.begin(), kPoints.end(), [&](const glm::vec4& point) {
    return glm::distance(glm::vec3(a * point), glm::vec3(b * point)) > kMove;
  });
}

bool Moved(const show::StagedFrame& a,
           const show::StagedActor& of_a,
           const show::StagedFrame& b,
           const show::StagedActor& of_b) {
  for (uint32_t i = 0; i < std::min(of_a.skin_count, of_b.skin_count); ++i) {
    if (Moved(of_a.stage_from_actor * a.people.skin[of_a.skin_begin + i],
              of_b.stage_from_actor * b.people.skin[of_b.skin_begin + i])) {
      return true;
    }
  }
  return of_a.skin_count != of_b.skin_count || Moved(of_a.stage_from_actor, of_b.stage_from_actor);
}

bool Moved(const show::StagedFrame& a,
           const show::StagedObject& of_a,
           const show::StagedFrame& b,
           const show::StagedObject& of_b) {
  for (uint32_t i = 0; i < std::min(of_a.part_count, of_b.part_count); ++i) {
    if (a.things.part_shown[of_a.part_begin + i] != b.things.part_shown[of_b.part_begin + i] ||
        Moved(a.things.stage_from_part[of_a.part_begin + i],
              b.things.stage_from_part[of_b.part_begin + i])) {
      return true;
    }
  }
  return of_a.part_count != of_b.part_count;
}

}  // namespace

std::vector<OnionMoment> OnionMoments(const OnionSkin& skin, double time) {
  std::vector<OnionMoment> moments;
  const double spacing = std::clamp(skin.spacing, OnionSkin::kShortest, OnionSkin::kLongest);
  for (int step = OnionSkin::kMost; step > 0; --step) {
    const float opacity = kNearest * std::pow(kFade, static_cast<float>(step - 1));
    const double offset = step * spacing;
    if (step <= skin.before && time - offset >= 0.0) {
      moments.push_back({-offset, skin.colour_before, opacity});
    }
    if (step <= skin.after) {
      moments.push_back({offset, skin.colour_after, opacity});
    }
  }
  return moments;
}

void RemoveUnmoved(const show::StagedFrame& now, show::StagedFrame& other) {
  std::erase_if(other.people.actors, [&](const show::StagedActor& actor) {
    return std::any_of(now.people.actors.begin(), now.people.actors.end(), [&](const auto& of_now) {
      return of_now.cast == actor.cast && !Moved(now, of_now, other, actor);
    });
  });
  std::erase_if(other.things.objects, [&](const show::StagedObject& object) {
    return std::any_of(
        now.things.objects.begin(), now.things.objects.end(), [&](const auto& of_now) {
          return of_now.object == object.object && !Moved(now, of_now, other, object);
        });
  });
}

void BlendOverlay(const cv::Mat& overlay,
                  const cv::Mat& overlay_coverage,
                  const cv::Mat& coverage_now,
                  float opacity,
                  cv::Mat& picture) {
  for (int y = 0; y < picture.rows; ++y) {
    const auto* from = overlay.ptr<cv::Vec3b>(y);
    const uint8_t* covers = overlay_coverage.ptr<uint8_t>(y);
    const uint8_t* taken = coverage_now.ptr<uint8_t>(y);
    auto* to = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < picture.cols; ++x) {
      if (covers[x] == 0 || taken[x] == 255) {
        continue;
      }
      const float weight = opacity * (1.0f - static_cast<float>(taken[x]) / 255.0f);
      const float left = 1.0f - weight * static_cast<float>(covers[x]) / 255.0f;
      for (int c = 0; c < 3; ++c) {
        to[x][c] = cv::saturate_cast<uint8_t>(left * static_cast<float>(to[x][c]) +
                                              weight * static_cast<float>(from[x][c]));
      }
    }
  }
}

}  // namespace lararium::editor
