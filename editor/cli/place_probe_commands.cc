#include "editor/cli/place_probe_commands.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "editor/bake/probe.h"
#include "editor/bake/sun_split.h"
#include "editor/cli/command_arguments.h"
#include "editor/cli/probe_commands.h"
#include "editor/document/document_fields.h"
#include "editor/document/white_balance.h"
#include "editor/text/text.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::editor {

namespace {

using Work = ProbeOptions::Work;

Eigen::Quaterniond ToEigen(const glm::quat& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

// Sets the orientation: first the given rotation, then the turn, then the matched directions.
Status Turn(const ProbeOptions& options, const ProjectPaths& paths, ProbeDocument& probe) {
  if (!options.rotation.empty()) {
    probe.stage_from_probe = RotationOf(options.rotation);
  }
  if (options.turn != 0.0) {
    probe.stage_from_probe =
        (Eigen::AngleAxisd(options.turn * kRadiansPerDegree, Eigen::Vector3d::UnitY()) *
         probe.stage_from_probe)
            .normalized();
  }
  if (!options.pairs.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(
        const bake::DirectionMatch match,
        MatchProbe(options, paths.Resolve(probe.file), geometry::ToGlm(probe.stage_from_probe)));
    probe.stage_from_probe = ToEigen(match.stage_from_probe);
  }
  return Status();
}

// Sets the brightness: first the given exposure, then the match with a grey surface.
Status Brighten(const ProbeOptions& options, const ProjectPaths& paths, ProbeDocument& probe) {
  if (options.exposure) {
    probe.scale = std::exp2(*options.exposure);
  }
  WhiteBalance white = WhiteBalanceOf(geometry::ToGlm(probe.balance));
  white.warmth = options.warmth.value_or(white.warmth);
  white.tint = options.tint.value_or(white.tint);
  if (options.warmth || options.tint) {
    const glm::vec3 balance = BalanceOf(white);
    probe.balance = {balance.r, balance.g, balance.b};
  }
  if (options.pixel.empty()) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const bake::GreyPatch patch, GreyPatchOf(options));
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image,
                            bake::ReadProbeImage(paths.Resolve(probe.file)));
  const bake::ProbePlacement placement = {geometry::ToGlm(probe.stage_from_probe), 1.0f};
  LARARIUM_ASSIGN_OR_RETURN(
      const bake::ScaleMatch match,
      bake::MatchScale(light::Balanced(bake::ProjectProbeLight(image, placement),
                                       geometry::ToGlm(probe.balance)),
                       {&patch, 1}));
  probe.scale = match.scale;
  return Status();
}

std::string Described(const ProbeDocument& probe) {
  const WhiteBalance white = WhiteBalanceOf(geometry::ToGlm(probe.balance));
  return Text("%s; at %.2f,%.2f,%.2f, %.2f h, %s, exposure %+.2f stops, warmth %+.2f, tint %+.2f",
              probe.file.c_str(), probe.position.x(), probe.position.y(), probe.position.z(),
              probe.hour, DescribeTurn(probe.stage_from_probe).c_str(), std::log2(probe.scale),
              white.warmth, white.tint);
}

class ProbeWorker {
 public:
  ProbeWorker(ProjectPaths paths, ProjectDocument document, const ProbeOptions& options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(options) {}

  Result<CommandResult> Run() {
    if (options_.work != Work::kList) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                                ChoosePlace(paths_, document_, options_.place));
      LARARIUM_RETURN_IF_ERROR(Edit(*document_.FindPlace(name)));
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
    CommandResult result;
    for (const PlaceDocument& place : document_.places) {
      if (options_.place.empty() || place.name == options_.place) {
        List(place, result);
      }
    }
    return result;
  }

 private:
  Status Edit(PlaceDocument& place) {
    if (options_.work == Work::kAdd) {
      LARARIUM_RETURN_IF_ERROR(CheckNewName(place.probes, "NAME", options_.name));
      place.probes.emplace_back().name = options_.name;
    }
    LARARIUM_ASSIGN_OR_RETURN(ProbeDocument * probe,
                              FindNamed(place.probes, options_.name, paths_.Project().string(),
                                        place.name + " has no probe"));
    if (options_.work == Work::kRemove) {
      place.probes.erase(place.probes.begin() + (probe - place.probes.data()));
      return Status();
    }
    return Change(*probe);
  }

  Status Change(ProbeDocument& probe) const {
    if (!options_.files.empty()) {
      LARARIUM_RETURN_IF_ERROR(bake::ReadProbeImage(options_.files[0]).status());
      probe.file = paths_.Shorten(options_.files[0]);
    }
    if (!options_.at.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(probe.position, ParsePosition("--at", options_.at));
    }
    probe.hour = options_.hour.value_or(probe.hour);
    LARARIUM_RETURN_IF_ERROR(Turn(options_, paths_, probe));
    return Brighten(options_, paths_, probe);
  }

  static void List(const PlaceDocument& place, CommandResult& result) {
    result.text += place.name + ":" + (place.probes.empty() ? " even light" : "") + "\n";
    result.json[place.name] = Json::array();
    for (const ProbeDocument& probe : place.probes) {
      result.text += "  " + probe.name + ": " + Described(probe) + "\n";
      result.json[place.name].push_back({{"name", probe.name},
                                         {"file", probe.file},
                                         {"position", FormatVector(probe.position)},
                                         {"hour", probe.hour},
                                         {"rotation", FormatRotation(probe.stage_from_probe)},
                                         {"scale", probe.scale},
                                         {"balance", FormatVector(probe.balance)}});
    }
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  const ProbeOptions& options_;
};

}  // namespace

Result<CommandResult> RunPlaceProbe(const ProbeOptions& options) {
  return RunOnProject<ProbeWorker>(options);
}

}  // namespace lararium::editor
