#include "shared/show/thing_light.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "shared/light/receivers.h"
#include "shared/show/prop_blockers.h"
#include "shared/show/stage_light.h"
#include "shared/stage/object.h"

namespace lararium::show {
namespace {

// A blocker that has moved by less, as a share of its distance from the object's surface, or in
// metres near contact, changes the light by less than one 8-bit step.
constexpr float kMovedShare = 1.0f / 64.0f;
constexpr float kMovedNear = 0.002f;
constexpr float kTurned = 1e-3f;              // Change of a matrix entry.
constexpr float kBrightened = 1.0f / 256.0f;  // Share of the mean radiance.
constexpr float kFlickered = 1.0f / 64.0f;    // Share of a lamp's intensity.

bool SameLight(const light::ShRgb& a, const light::ShRgb& b) {
  const float least = kBrightened * glm::length(a[0]);
  return std::equal(a.begin(), a.end(), b.begin(), [least](const glm::vec3& p, const glm::vec3& q) {
    return glm::distance(p, q) <= least;
  });
}

bool SameMatrix(const glm::mat4& a, const glm::mat4& b) {
  for (int column = 0; column < 4; ++column) {
    const glm::vec4 moved = glm::abs(a[column] - b[column]);
    if (std::max({moved.x, moved.y, moved.z}) > kTurned) {
      return false;
    }
  }
  return true;
}

bool SameLamp(const light::Lamp& a, const light::Lamp& b) {
  return glm::distance(a.position, b.position) <= kMovedNear && a.walls == b.walls &&
         glm::distance(a.intensity, b.intensity) <= kFlickered * glm::length(a.intensity);
}

human::Skeleton SkeletonOf(const stage::Prop& prop) {
  human::Skeleton skeleton;
  for (const stage::PropPart& part : prop.parts) {
    skeleton.names.push_back(part.name);
    skeleton.parents.push_back(human::Skeleton::kNoParent);
  }
  skeleton.rest.resize(prop.parts.size());
  skeleton.joint_from_actor.assign(prop.parts.size(), glm::mat4(1.0f));
  return skeleton;
}

// Copies only the data that lighting needs.
human::SkinnedMesh MeshOf(const stage::PropMesh& mesh) {
  human::SkinnedMesh skinned;
  skinned.positions = mesh.positions;
  skinned.indices = mesh.indices;
  return skinned;
}

}  // namespace

std::shared_ptr<human::Human> FigureOf(const stage::Prop& prop) {
  auto figure = std::make_shared<human::Human>();
  figure->name = prop.name;
  figure->skeleton = SkeletonOf(prop);
  figure->light = prop.light;
  for (const stage::PropPart& part : prop.parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      if (!prop.light.empty()) {
        figure->meshes.push_back(MeshOf(mesh));
      }
    }
  }
  for (size_t k = 0; k < prop.light_shown.size(); ++k) {
    for (size_t part = 0; part < prop.parts.size(); ++part) {
      if ((prop.light_shown[k] >> part & 1u) == 0) {
        figure->light.key_poses[k][part].translation.y += kNowhere;
      }
    }
  }
  if (figure->light.empty()) {
    // The figure still casts shadows: figures without light have one key pose and no receivers.
    figure->light.count = 9;
    figure->light.key_poses = {figure->skeleton.rest};
  }
  for (const PropBlocker& blocker : FindBlockers(prop)) {
    figure->light.blockers.push_back({blocker.part, blocker.centre, blocker.radius});
  }
  return figure;
}

void SkinOfFigure(std::span<const glm::mat4> stage_from_part,
                  std::span<const uint8_t> shown,
                  std::span<glm::mat4> skin) {
  const glm::mat4 first_from_stage = glm::inverse(stage_from_part[0]);
  for (size_t part = 0; part < skin.size(); ++part) {
    skin[part] = first_from_stage * stage_from_part[part];
    skin[part][3].y += shown[part] == 0 ? kNowhere : 0.0f;
  }
}

float RadiusOf(const stage::Prop& prop) {
  float radius = 0.0f;
  std::vector<stage::Pose> object_from_part;
  for (const stage::PropPart& part : prop.parts) {
    const bool is_root = part.parent == stage::PropPart::kNoParent;
    object_from_part.push_back(is_root ? part.parent_from_part
                                       : object_from_part[static_cast<size_t>(part.parent)] *
                                             part.parent_from_part);
    for (const stage::PropMesh& mesh : part.meshes) {
      for (const glm::vec3& position : mesh.positions) {
        radius = std::max(radius, glm::length(object_from_part.back() * position));
      }
    }
  }
  return radius;
}

bool ThingMemory::Alike(const Surroundings& a, const Surroundings& b) const {
  const glm::vec3 centre(a.stage_from_thing[3]);
  return SameMatrix(a.stage_from_thing, b.stage_from_thing) &&
         std::equal(a.skin.begin(), a.skin.end(), b.skin.begin(), b.skin.end(), SameMatrix) &&
         std::equal(a.lamps.begin(), a.lamps.end(), b.lamps.begin(), b.lamps.end(), SameLamp) &&
         std::equal(a.blockers.begin(), a.blockers.end(), b.blockers.begin(), b.blockers.end(),
                    [&](const glm::vec4& p, const glm::vec4& q) {
                      const float distance = glm::distance(glm::vec3(p), centre) - radius_;
                      return glm::distance(p, q) <= std::max(kMovedShare * distance, kMovedNear);
                    });
}

bool ThingMemory::Update(const light::ShRgb& light,
                         std::span<const light::Lamp> lamps,
                         const glm::mat4& stage_from_thing,
                         std::span<const glm::mat4> skin,
                         std::span<const glm::vec4> blockers) {
  const glm::vec3 centre(stage_from_thing[3]);
  now_.stage_from_thing = stage_from_thing;
  now_.skin.assign(skin.begin(), skin.end());
  now_.lamps.clear();
  for (const light::Lamp& lamp : lamps) {
    if (glm::distance(lamp.position, centre) <
        light::ReachOf(lamp, light::kLeastLampIrradiance) + radius_) {
      now_.lamps.push_back(lamp);
    }
  }
  now_.blockers.clear();
  for (const glm::vec4& blocker : blockers) {
    const float distance = std::max(glm::distance(glm::vec3(blocker), centre) - radius_, 0.0f);
    const float square = blocker.w * blocker.w;
    if (square > light::kLeastShare * (distance * distance + square)) {
      now_.blockers.push_back(blocker);
    }
  }
  if (known_ && SameLight(light_, light) && Alike(then_, now_)) {
    return false;
  }
  known_ = true;
  light_ = light;
  std::swap(then_, now_);
  return true;
}

}  // namespace lararium::show
