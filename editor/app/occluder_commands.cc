#include "editor/app/occluder_commands.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "editor/app/angles.h"
#include "editor/app/document_fields.h"
#include "editor/app/text.h"

namespace lararium::app {

namespace {

using Eigen::Vector3d;
using Kind = OccluderDocument::Kind;

constexpr double kDegree = std::numbers::pi / 180.0;

// Heading, then tilt and roll where they are given.
Eigen::Quaterniond FromDegrees(const std::vector<double>& turn) {
  Vector3d angles = Vector3d::Zero();
  for (size_t i = 0; i < turn.size(); ++i) {
    angles[static_cast<Eigen::Index>(i)] = turn[i] * kDegree;
  }
  return FromHeadingTiltRoll(angles);
}

// Of "NAME=METRES".
Result<std::pair<std::string, double>> ParseSize(const std::string& text) {
  const size_t equals = text.find('=');
  double value = 0.0;
  const char* end = text.data() + text.size();
  if (equals != std::string::npos) {
    const auto [rest, error] = std::from_chars(text.data() + equals + 1, end, value);
    if (error == std::errc() && rest == end) {
      return std::pair(text.substr(0, equals), value);
    }
  }
  return Status::Error("--size", "\"" + text + "\" is no size", "write it as width=1.5, in metres");
}

Status SetShapeSize(const std::string& name, double value, OccluderShape& shape) {
  std::string known;
  for (const ShapeSize& size : EntryOf(shape.kind).sizes) {
    if (size.name == name) {
      shape.*size.value = value;
      return Status();
    }
    known += (known.empty() ? "" : ", ") + std::string(size.name);
  }
  return Status::Error(
      "--size",
      "a shape of kind " + std::string(EntryOf(shape.kind).name) + " has no \"" + name + "\"",
      "it has " + known);
}

Status SetSizes(const std::vector<std::string>& sizes, OccluderDocument& occluder) {
  for (const std::string& text : sizes) {
    LARARIUM_ASSIGN_OR_RETURN(const auto size, ParseSize(text));
    if (occluder.shape) {
      LARARIUM_RETURN_IF_ERROR(SetShapeSize(size.first, size.second, *occluder.shape));
    } else if (!occluder.drawn() || size.first != "depth") {
      return Status::Error("--size",
                           occluder.name + " is no shape and has no \"" + size.first + "\"",
                           occluder.drawn() ? "it has depth" : "use --scale");
    } else if (size.second >= 0.0 && size.second <= kMaxDepth) {
      occluder.depth = size.second;
    } else {
      return Status::Error("--size", "a depth lies between 0 and 1000 m");
    }
  }
  return occluder.shape ? CheckShape(*occluder.shape, "--size") : Status();
}

Status SetPose(const OccluderOptions& options, OccluderDocument& occluder) {
  const bool posed = !options.at.empty() || !options.turn.empty() || options.scale.has_value();
  if (posed && occluder.drawn()) {
    return Status::Error(occluder.name, "was drawn on training images, and lies where they show it",
                         "draw its corners elsewhere in the window");
  }
  geometry::Similarity3& pose = occluder.stage_from_mesh;
  if (!options.at.empty()) {
    pose.translation = {options.at[0], options.at[1], options.at[2]};
    if (!pose.translation.allFinite() || pose.translation.cwiseAbs().maxCoeff() > kMaxLength) {
      return Status::Error("--at", "is no position on a stage", "give three numbers, in metres");
    }
  }
  if (!options.turn.empty()) {
    pose.rotation = FromDegrees(options.turn);
  }
  pose.scale = options.scale.value_or(pose.scale);
  return Status();
}

// Position, sizes and what it does.
Status Change(const OccluderOptions& options, OccluderDocument& occluder) {
  LARARIUM_RETURN_IF_ERROR(SetSizes(options.sizes, occluder));
  LARARIUM_RETURN_IF_ERROR(SetPose(options, occluder));
  for (const auto& [wanted, does] : {std::pair{&options.receives_shadow, &occluder.receives_shadow},
                                     {&options.blocks_sound, &occluder.blocks_sound},
                                     {&options.blocks_walking, &occluder.blocks_walking}}) {
    *does = wanted->empty() ? *does : *wanted == "yes";
  }
  return Status();
}

// As --at, --turn and --scale take it, to the millimetre and tenth of a degree.
std::string DescribePose(const geometry::Similarity3& stage_from_mesh) {
  const Vector3d& at = stage_from_mesh.translation;
  std::string text = Text("; at %.3f,%.3f,%.3f", at.x(), at.y(), at.z());
  const Vector3d turn = HeadingTiltRoll(stage_from_mesh.rotation) / kDegree;
  if (turn.cwiseAbs().maxCoeff() >= 0.05) {
    text += Text(", turned %.1f,%.1f,%.1f degrees", turn.x(), turn.y(), turn.z());
  }
  if (std::abs(stage_from_mesh.scale - 1.0) >= 5e-5) {
    text += Text(", scaled by %.4f", stage_from_mesh.scale);
  }
  return text;
}

std::string Described(const OccluderDocument& occluder) {
  std::string text;
  switch (occluder.kind()) {
    case Kind::kModel:
      text = "model " + occluder.file;
      break;
    case Kind::kShape:
      text = DescribeShape(*occluder.shape);
      break;
    case Kind::kDrawn:
      text = Text("drawn, corners %zu, depth %g", occluder.corners.size(), occluder.depth);
      break;
  }
  if (!occluder.drawn()) {
    text += DescribePose(occluder.stage_from_mesh);
  }
  text += occluder.receives_shadow ? "" : "; receives no shadow";
  text += occluder.blocks_sound ? "" : "; does not block sound";
  text += occluder.blocks_walking ? "" : "; does not block walking";
  return text;
}

Json ListedJson(const OccluderDocument& occluder) {
  Json json = FormatOccluder(occluder);
  json["receives_shadow"] = occluder.receives_shadow;
  json["blocks_sound"] = occluder.blocks_sound;
  json["blocks_walking"] = occluder.blocks_walking;
  return json;
}

class OccluderWorker {
 public:
  OccluderWorker(ProjectPaths paths, ProjectDocument document, OccluderOptions options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(std::move(options)) {}

  Result<CommandResult> Run() {
    if (!options_.add.empty() || !options_.set.empty() || !options_.remove.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                                ChoosePlace(paths_, document_, options_.place));
      LARARIUM_RETURN_IF_ERROR(Work(*document_.FindPlace(name)));
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
  Status Work(PlaceDocument& place) {
    if (!options_.add.empty()) {
      return Add(place);
    }
    LARARIUM_ASSIGN_OR_RETURN(OccluderDocument * occluder,
                              Find(place, options_.set + options_.remove));
    if (!options_.set.empty()) {
      return Change(options_, *occluder);
    }
    place.occluders.erase(place.occluders.begin() + (occluder - place.occluders.data()));
    return Status();
  }

  Status Add(PlaceDocument& place) {
    if (!IsPlainName(options_.add)) {
      return Status::Error("--add", "\"" + options_.add + "\" is no name",
                           "use letters, digits, '_' and '-'");
    }
    if (Find(place, options_.add).ok()) {
      return Status::Error("--add",
                           place.name + " has an occluder \"" + options_.add + "\" already",
                           "change it with --set");
    }
    OccluderDocument occluder;
    if (const ShapeEntry* entry = FindShapeEntry(options_.shape)) {
      occluder = NewOccluder(options_.add, entry->usual);
    } else {
      occluder.name = options_.add;
      occluder.file = paths_.Shorten(options_.model);
    }
    LARARIUM_RETURN_IF_ERROR(Change(options_, occluder));
    place.occluders.push_back(std::move(occluder));
    return Status();
  }

  Result<OccluderDocument*> Find(PlaceDocument& place, const std::string& name) {
    if (OccluderDocument* occluder = place.FindOccluder(name)) {
      return occluder;
    }
    const std::string known = OccluderNames(place);
    return Status::Error(paths_.Project().string(),
                         place.name + " has no occluder \"" + name + "\"",
                         known.empty() ? "add it with --add" : "it has " + known);
  }

  static void List(const PlaceDocument& place, CommandResult& result) {
    result.text += place.name + ":" + (place.occluders.empty() ? " no occluders" : "") + "\n";
    result.json[place.name] = Json::array();
    for (const OccluderDocument& occluder : place.occluders) {
      result.text += "  " + occluder.name + ": " + Described(occluder) + "\n";
      result.json[place.name].push_back(ListedJson(occluder));
    }
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  OccluderOptions options_;
};

}  // namespace

Result<CommandResult> RunOccluder(const OccluderOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (!options.place.empty() && document.FindPlace(options.place) == nullptr) {
    return ChoosePlace(paths, document, options.place).status();
  }
  return OccluderWorker(paths, std::move(document), options).Run();
}

}  // namespace lararium::app
