#include "editor/cli/occluder_commands.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "editor/cli/command_arguments.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/staging.h"
#include "editor/text/text.h"

namespace lararium::editor {

namespace {

using Eigen::Vector3d;
using Kind = OccluderDocument::Kind;

// Parses "NAME=METRES".
Result<std::pair<std::string, double>> ParseSize(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals != std::string::npos) {
    if (const auto value = ParseNumber(std::string_view(text).substr(equals + 1))) {
      return std::pair(text.substr(0, equals), *value);
    }
  }
  return Status::Error("--size", "\"" + text + "\" is not a size",
                       "write it as width=1.5, in metres");
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
                           occluder.name + " is not a shape and has no \"" + size.first + "\"",
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
    return Status::Error(occluder.name,
                         "was drawn on the training images, which determine its position",
                         "draw its corners elsewhere with --draw");
  }
  geometry::Similarity3& pose = occluder.stage_from_mesh;
  if (!options.at.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(pose.translation, ParsePosition("--at", options.at));
  }
  if (!options.turn.empty()) {
    pose.rotation = RotationOf(options.turn);
  }
  pose.scale = options.scale.value_or(pose.scale);
  return Status();
}

// Changes position, sizes and properties.
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
    text += "; " + DescribePose(occluder.stage_from_mesh);
  }
  text += occluder.receives_shadow ? "" : "; receives no shadow";
  text += occluder.blocks_sound ? "" : "; does not block sound";
  text += occluder.blocks_walking ? "" : "; does not block walking";
  return text;
}

Json ListedJson(const OccluderDocument& occluder) {
  Json json = FormatFields(occluder);
  json["receives_shadow"] = occluder.receives_shadow;
  json["blocks_sound"] = occluder.blocks_sound;
  json["blocks_walking"] = occluder.blocks_walking;
  return json;
}

// The corners visible in an image; nullopt for those that are not.
struct SeenCorners {
  std::string frame;
  std::vector<std::optional<Eigen::Vector2d>> pixels;
};

// Parses "FRAME,x,y,x,y,..." with "-,-" for a corner that is not visible. Parses from the end,
// because the name of the frame may contain commas.
Result<SeenCorners> ParseSeen(const std::string& text) {
  std::vector<std::optional<double>> numbers;
  size_t end = text.size();
  for (size_t comma = text.rfind(','); comma != std::string::npos && comma > 0;
       comma = text.rfind(',', comma - 1)) {
    const std::string_view part = std::string_view(text).substr(comma + 1, end - comma - 1);
    const std::optional<double> number = ParseNumber(part);
    if (!number && part != "-") {
      break;
    }
    numbers.insert(numbers.begin(), number);
    end = comma;
  }
  SeenCorners seen{text.substr(0, end), {}};
  bool pairs = !numbers.empty() && numbers.size() % 2 == 0 && numbers.size() <= 2 * kMaxCorners;
  for (size_t i = 0; pairs && i < numbers.size(); i += 2) {
    pairs = numbers[i].has_value() == numbers[i + 1].has_value();
    seen.pixels.push_back(numbers[i] && numbers[i + 1]
                              ? std::optional(Eigen::Vector2d(*numbers[i], *numbers[i + 1]))
                              : std::nullopt);
  }
  return pairs ? Result<SeenCorners>(std::move(seen))
               : Status::Error(
                     "--seen " + text, "is not a list of corners",
                     "write it as FRAME,x,y,x,y,..., with -,- for a corner that is not visible");
}

class OccluderWorker {
 public:
  OccluderWorker(ProjectPaths paths, ProjectDocument document, OccluderOptions options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(std::move(options)) {}

  Result<CommandResult> Run() {
    CommandResult result;
    if (!options_.add.empty() || !options_.draw.empty() || !options_.set.empty() ||
        !options_.remove.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                                ChoosePlace(paths_, document_, options_.place));
      PlaceDocument& place = *document_.FindPlace(name);
      LARARIUM_RETURN_IF_ERROR(options_.draw.empty() ? Work(place) : Draw(place, result.text));
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
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

  // Draws the occluder as in the window, but refuses corners that cannot be located yet.
  Status Draw(PlaceDocument& place, std::string& text) {
    OccluderDocument* occluder = place.FindOccluder(options_.draw);
    if (occluder == nullptr) {
      LARARIUM_RETURN_IF_ERROR(CheckPlainName("--draw", options_.draw));
      occluder = &place.occluders.emplace_back();
      occluder->name = options_.draw;
    } else if (!occluder->drawn()) {
      return Status::Error("--draw",
                           occluder->name + " is a " + (occluder->shape ? "shape" : "model") +
                               ", not a drawn occluder",
                           "choose another name");
    }
    LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths_, place));
    for (const std::string& seen : options_.seen) {
      LARARIUM_RETURN_IF_ERROR(DrawIn(*map.database, place.name, seen, *occluder));
    }
    LARARIUM_RETURN_IF_ERROR(Change(options_, *occluder));
    const double units_per_metre = map.picks.map_from_picked.scale * place.picked_from_stage.scale;
    LARARIUM_ASSIGN_OR_RETURN(const DrawnOccluder drawn,
                              DrawOccluder(*occluder, *map.database, units_per_metre));
    text += Text("%s: %zu corners, %.2f px off; %.1f cm off their plane\n", occluder->name.c_str(),
                 drawn.corners.size(), drawn.error_px, 100.0 * drawn.unevenness / units_per_metre);
    return Status();
  }

  // Adds the corners visible in one image.
  Status DrawIn(const vision::SceneDatabase& map,
                const std::string& place,
                const std::string& seen,
                OccluderDocument& occluder) const {
    LARARIUM_ASSIGN_OR_RETURN(const SeenCorners corners, ParseSeen(seen));
    LARARIUM_ASSIGN_OR_RETURN(
        const vision::Keyframe* keyframe,
        FindKeyframe(map, place, corners.frame, static_cast<uint32_t>(options_.session)));
    for (size_t i = 0; i < corners.pixels.size(); ++i) {
      const auto& pixel = corners.pixels[i];
      if (pixel && !map.camera.Contains(*pixel)) {
        return Status::Error("--seen " + corners.frame,
                             CornerName(i) + " lies outside of the image",
                             "it has " + std::to_string(map.camera.width) + " x " +
                                 std::to_string(map.camera.height) + " pixels");
      }
      if (pixel) {
        SetCorner(occluder, i, *keyframe, *pixel);
      } else if (i == occluder.corners.size()) {
        occluder.corners.push_back({CornerName(i), {}});  // Other images may show it.
      }
    }
    return Status();
  }

  Status Add(PlaceDocument& place) {
    LARARIUM_RETURN_IF_ERROR(CheckNewName(place.occluders, "--add", options_.add));
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
    return FindNamed(place.occluders, name, paths_.Project().string(),
                     place.name + " has no occluder");
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
  return RunOnProject<OccluderWorker>(options);
}

}  // namespace lararium::editor
