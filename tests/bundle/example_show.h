#pragma once

#include "shared/bundle/show_manifest.h"

namespace lararium::test {

// A small show with everything in it. Entries refer to its members, but the list of members is
// empty.
inline bundle::ShowManifest ExampleManifest() {
  bundle::ShowManifest manifest;
  manifest.title = "The thermopolium";
  manifest.credits = "made for tests";
  manifest.drama = "drama.lua";
  bundle::PlaceEntry place;
  place.name = "maquette";
  place.scene = "places/0/scene.larscene";
  place.map_from_stage = {
      0.37, Eigen::Quaterniond(0.1, 0.7, -0.3, 0.2).normalized(), {1.0, -2.0, 0.1}};
  place.camera_nudge = {0.001, 0.0, -0.02};
  place.camera = light::CameraTraits{640, 0.01f, 0.0005f, 0.75f, 0.625f, 0.5f};
  place.occluders = {{"counter", "places/0/occluder0.larmesh", {}}};
  light::PlacedProbe& probe = place.probes.emplace_back();
  probe.position = {1.0f, 1.5f, -2.0f};
  probe.hour = 9.5;
  for (size_t i = 0; i < probe.light.sky.size(); ++i) {
    probe.light.sky[i] = glm::vec3(0.1f, 0.2f, 0.3f) * static_cast<float>(i + 1);
  }
  probe.light.sun = light::Sun{{0.0f, 0.6f, 0.8f}, {5.0f, 4.0f, 3.0f}, 0.005f};
  manifest.places = {place};
  manifest.cast = {{"keeper", "cast/0.larhuman"}};
  return manifest;
}

}  // namespace lararium::test
