#pragma once

// What several subcommands take from the command line, and how they refuse it.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// Of entries with names, for errors: "a, b".
template <typename Entry>
std::string NamesOf(const std::vector<Entry>& entries) {
  std::string names;
  for (const Entry& entry : entries) {
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  return names;
}

// The entry of a name. The error is "place: has no WHAT "NAME"", and which there are.
// has_no: "has no occluder", say.
template <typename Entry>
Result<Entry*> FindNamed(std::vector<Entry>& entries,
                         const std::string& name,
                         const std::string& place,
                         const std::string& has_no) {
  for (Entry& entry : entries) {
    if (entry.name == name) {
      return &entry;
    }
  }
  const std::string known = NamesOf(entries);
  return Status::Error(place, has_no + " \"" + name + "\"",
                       known.empty() ? "there is none yet; add it" : "it has " + known);
}

// Whether something new can be called so: a name of files, and none that is taken already.
Status CheckPlainName(const std::string& option, const std::string& name);
template <typename Entry>
Status CheckNewName(const std::vector<Entry>& entries,
                    const std::string& option,
                    const std::string& name) {
  LARARIUM_RETURN_IF_ERROR(CheckPlainName(option, name));
  for (const Entry& entry : entries) {
    if (entry.name == name) {
      return Status::Error(option, "there is a \"" + name + "\" already",
                           "choose another name, or change that one with --set");
    }
  }
  return Status();
}

// A position on the stage, metres, of three numbers.
Result<Eigen::Vector3d> ParsePosition(const std::string& option,
                                      const std::vector<double>& numbers);

// The rotation that heading, then tilt and roll where they are given, mean; degrees.
Eigen::Quaterniond RotationOf(const std::vector<double>& degrees);

// "at 1.000,0.000,-2.000, turned 90.0,0.0,0.0 degrees, scaled by 0.5000", as options take it, to
// the millimetre and tenth of a degree; without what is nothing.
std::string DescribePose(const geometry::Similarity3& stage_from_thing);
// The part of it that says how something is turned.
std::string DescribeTurn(const Eigen::Quaterniond& rotation);

// All of a text as one number; nothing where it is none.
std::optional<double> ParseNumber(std::string_view text);

// A keyframe of a place's map. option: what named it.
Result<const vision::Keyframe*> FindKeyframe(const vision::SceneDatabase& map,
                                             const std::string& place,
                                             const std::string& frame,
                                             uint32_t session);

// A pixel of a training image of a place.
Result<stage::Pick> PickInImage(const vision::SceneDatabase& map,
                                const std::string& place,
                                const std::string& frame,
                                uint32_t session,
                                const Eigen::Vector2d& pixel);

// The same as it is typed: "FRAME,x,y", where the frame's name may hold commas.
Result<stage::Pick> ParsePick(const vision::SceneDatabase& map,
                              const std::string& place,
                              uint32_t session,
                              const std::string& option,
                              const std::string& text);

}  // namespace lararium::app
