#include "editor/document/project.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/document/place_recordings.h"
#include "editor/train/april_tags.h"
#include "shared/core/file.h"
#include "shared/stage/acoustics_file.h"
#include "shared/stage/caption_file.h"

namespace lararium::editor {

namespace {

using geometry::CameraModel;
using geometry::Similarity3;

constexpr size_t kMaxEntries = 10'000;  // Limit for each list in the file.
constexpr size_t kMaxProbes = 64;       // Limit for each place; bundles have the same limit.
constexpr double kMaxPixel = 1e6;

Result<stage::Pick> ParsePick(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"frame_index", "frame", "pixel", "session"}));
  stage::Pick pick;
  LARARIUM_ASSIGN_OR_RETURN(pick.frame_index, view.Integer("frame_index", 0, int64_t{1} << 40));
  LARARIUM_ASSIGN_OR_RETURN(pick.frame, view.Text("frame"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> pixel, view.Numbers("pixel", 2));
  if (std::abs(pixel[0]) > kMaxPixel || std::abs(pixel[1]) > kMaxPixel) {
    return view.Problem("\"pixel\" lies outside of any image");
  }
  pick.pixel = {pixel[0], pixel[1]};
  if (view.Has("session")) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t session, view.Integer("session", 0, kMaxAddedSessions));
    pick.session = static_cast<uint32_t>(session);
  }
  return pick;
}

Status ParsePickList(const JsonView& view, stage::Anchor& anchor) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, view.Array(kMaxEntries));
  for (const JsonView& entry : list) {
    LARARIUM_ASSIGN_OR_RETURN(stage::Pick pick, ParsePick(entry));
    anchor.picks.push_back(std::move(pick));
  }
  return Status();
}

// The fixed names of the anchors. Under its name, each has a list of picks.
std::array<std::pair<const char*, stage::Anchor stage::StagePicks::*>, 5> Anchors() {
  return {{{"origin", &stage::StagePicks::origin},
           {"forward", &stage::StagePicks::forward},
           {"floor", &stage::StagePicks::floor},
           {"length_from", &stage::StagePicks::length_from},
           {"length_to", &stage::StagePicks::length_to}}};
}

Result<stage::StagePicks> ParsePicks(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(
      view.CheckFields({"origin", "forward", "floor", "length_from", "length_to", "length_m"}));
  stage::StagePicks picks = EmptyPicks();
  for (const auto& [key, anchor] : Anchors()) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
    LARARIUM_RETURN_IF_ERROR(ParsePickList(field, picks.*anchor));
  }
  LARARIUM_ASSIGN_OR_RETURN(picks.length_m, view.Number("length_m", 1e-6, kMaxLength));
  return picks;
}

template <typename Entry>
Status CheckUniqueNames(const std::vector<Entry>& entries, const std::string& where) {
  std::set<std::string_view> names;
  for (const Entry& entry : entries) {
    if (!names.insert(entry.name).second) {
      return Status::Error(where, "the name \"" + entry.name + "\" is used twice", "rename one");
    }
  }
  return Status();
}

Status ParseCheckPicks(const JsonView& view, std::vector<stage::Anchor>& anchors) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, view.Array(kMaxCheckPoints));
  for (const JsonView& entry : list) {
    LARARIUM_RETURN_IF_ERROR(entry.CheckFields({"name", "picks"}));
    stage::Anchor& anchor = anchors.emplace_back();
    LARARIUM_ASSIGN_OR_RETURN(anchor.name, entry.Text("name", kMaxCheckPointName));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView picks, entry.Field("picks"));
    LARARIUM_RETURN_IF_ERROR(ParsePickList(picks, anchor));
  }
  return CheckUniqueNames(anchors, view.place());
}

Result<TagsDocument> ParseTags(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"family", "size_m"}));
  TagsDocument tags;
  LARARIUM_ASSIGN_OR_RETURN(tags.family, view.Text("family"));
  const std::span<const std::string_view> families = train::TagFamilies();
  if (std::find(families.begin(), families.end(), tags.family) == families.end()) {
    return view.Problem("\"family\" is not known", train::TagFamilyRemedy());
  }
  LARARIUM_ASSIGN_OR_RETURN(tags.size_m, view.Number("size_m", 1e-4, 1e3));
  return tags;
}

// Reads an optional flag; a missing one is false.
Result<bool> ParseFlag(const JsonView& view, std::string_view key) {
  if (!view.Has(key)) {
    return false;
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
  return field.Boolean();
}

Status ParseCorners(const JsonView& view, OccluderDocument& occluder) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("corners"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> corners, field.Array(kMaxCorners));
  for (const JsonView& corner : corners) {
    stage::Anchor& anchor = occluder.corners.emplace_back();
    anchor.name = CornerName(occluder.corners.size() - 1);
    LARARIUM_RETURN_IF_ERROR(ParsePickList(corner, anchor));
  }
  LARARIUM_ASSIGN_OR_RETURN(occluder.depth, view.Number("depth", 0.0, kMaxDepth));
  LARARIUM_ASSIGN_OR_RETURN(occluder.flat, ParseFlag(view, "flat"));
  return Status();
}

Result<ModelPairDocument> ParseModelPair(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"on_mesh", "picks"}));
  ModelPairDocument pair;
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> at, view.Numbers("on_mesh", 3));
  pair.on_mesh = {at[0], at[1], at[2]};
  constexpr double kFarthest = 1e9;  // Limit in the unit of the mesh.
  if (pair.on_mesh.cwiseAbs().maxCoeff() > kFarthest) {
    return view.Problem("\"on_mesh\" lies beyond any model");
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView picks, view.Field("picks"));
  LARARIUM_RETURN_IF_ERROR(ParsePickList(picks, pair.anchor));
  return pair;
}

Status ParseModelPairs(const JsonView& view, OccluderDocument& occluder) {
  if (view.Has("model_pairs")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("model_pairs"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> pairs, field.Array(kMaxModelPairs));
    for (const JsonView& entry : pairs) {
      LARARIUM_ASSIGN_OR_RETURN(ModelPairDocument pair, ParseModelPair(entry));
      pair.anchor.name = ModelPairName(occluder.model_pairs.size());
      occluder.model_pairs.push_back(std::move(pair));
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(occluder.keep_scale, ParseFlag(view, "keep_scale"));
  return Status();
}

Result<OccluderDocument> ParseOccluder(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields(
      {"name", "file", "translation", "rotation", "scale", "receives_shadow", "blocks_sound",
       "blocks_walking", "shape", "corners", "depth", "flat", "model_pairs", "keep_scale"}));
  OccluderDocument occluder;
  LARARIUM_ASSIGN_OR_RETURN(occluder.name, ParsePlainName(view, "name"));
  if (int{view.Has("file")} + int{view.Has("shape")} + int{view.Has("corners")} != 1) {
    return view.Problem("must have either the \"file\" of a model, a \"shape\" or \"corners\"");
  }
  if (view.Has("corners")) {
    LARARIUM_RETURN_IF_ERROR(ParseCorners(view, occluder));
    if (view.Has("model_pairs") || view.Has("keep_scale")) {
      return view.Problem("was drawn: \"model_pairs\" and \"keep_scale\" are only for models");
    }
  } else if (view.Has("shape")) {
    for (const char* other : {"flat", "model_pairs", "keep_scale"}) {
      if (view.Has(other)) {
        return view.Problem("is a shape: \"" + std::string(other) + "\" is not a field of shapes");
      }
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView shape, view.Field("shape"));
    LARARIUM_ASSIGN_OR_RETURN(occluder.shape, ParseShape(shape));
    LARARIUM_ASSIGN_OR_RETURN(occluder.stage_from_mesh, ParseSimilarity(view));
  } else {
    if (view.Has("flat")) {
      return view.Problem("is a model: \"flat\" is only for occluders that were drawn");
    }
    LARARIUM_RETURN_IF_ERROR(ParseModelPairs(view, occluder));
    LARARIUM_ASSIGN_OR_RETURN(occluder.file, view.Text("file"));
    if (occluder.file.empty()) {
      return view.Problem("\"file\" must name a model");
    }
    LARARIUM_ASSIGN_OR_RETURN(occluder.stage_from_mesh, ParseSimilarity(view));
  }
  for (const auto& [key, does] : {std::pair{"receives_shadow", &occluder.receives_shadow},
                                  {"blocks_sound", &occluder.blocks_sound},
                                  {"blocks_walking", &occluder.blocks_walking}}) {
    if (view.Has(key)) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
      LARARIUM_ASSIGN_OR_RETURN(*does, field.Boolean());
    }
  }
  return occluder;
}

Status ParseProbeImage(const JsonView& view, ProbeDocument& probe) {
  LARARIUM_ASSIGN_OR_RETURN(probe.file, view.Text("file"));
  LARARIUM_ASSIGN_OR_RETURN(probe.stage_from_probe, ParseRotation(view));
  LARARIUM_ASSIGN_OR_RETURN(probe.scale, view.Number("scale", 0.0, 1e9));
  if (view.Has("balance")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> balance, view.Numbers("balance", 3));
    probe.balance = {balance[0], balance[1], balance[2]};
    if (!(probe.balance.minCoeff() > 1e-3 && probe.balance.maxCoeff() < 1e3)) {
      return view.Problem("\"balance\" must be three numbers about 1");
    }
  }
  return Status();
}

Result<ProbeDocument> ParseProbe(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(
      view.CheckFields({"name", "file", "position", "hour", "rotation", "scale", "balance"}));
  ProbeDocument probe;
  LARARIUM_ASSIGN_OR_RETURN(probe.name, ParsePlainName(view, "name"));
  LARARIUM_ASSIGN_OR_RETURN(probe.position, ParseVector(view, "position"));
  LARARIUM_ASSIGN_OR_RETURN(probe.hour, view.Number("hour", 0.0, 24.0));
  LARARIUM_RETURN_IF_ERROR(ParseProbeImage(view, probe));
  return probe;
}

// Reads the field "probe" of older files, in which a place had at most one probe.
Result<ProbeDocument> ParseOnlyProbe(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"file", "rotation", "scale"}));
  ProbeDocument probe;
  probe.name = "probe";
  LARARIUM_RETURN_IF_ERROR(ParseProbeImage(view, probe));
  return probe;
}

// Reads the field "probes", or "probe" of older files.
Status ParseProbes(const JsonView& view, std::vector<ProbeDocument>& probes) {
  if (view.Has("probe")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("probe"));
    if (view.Has("probes")) {
      return field.Problem("cannot be used together with \"probes\"", "move it into the list");
    }
    LARARIUM_ASSIGN_OR_RETURN(probes.emplace_back(), ParseOnlyProbe(field));
  }
  if (view.Has("probes")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("probes"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, field.Array(kMaxProbes));
    for (const JsonView& entry : list) {
      LARARIUM_ASSIGN_OR_RETURN(probes.emplace_back(), ParseProbe(entry));
    }
    return CheckUniqueNames(probes, field.place());
  }
  return Status();
}

// Reads the optional fields of a place.
Status ParseOptionalFields(const JsonView& view, PlaceDocument& place) {
  LARARIUM_ASSIGN_OR_RETURN(PlaceRecordings recordings, ParseRecordings(view));
  place.training = std::move(recordings.training);
  place.intrinsics = recordings.intrinsics;
  place.added = std::move(recordings.added);
  if (view.Has("preview")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("preview"));
    LARARIUM_ASSIGN_OR_RETURN(place.preview, ParseSource(field));
  }
  if (view.Has("camera")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("camera"));
    LARARIUM_RETURN_IF_ERROR(field.CheckFields({"width", "noise", "blur_px", "knee", "shutter"}));
    LARARIUM_ASSIGN_OR_RETURN(place.camera, light::ParseCameraTraits(field));
  }
  if (view.Has("tags")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("tags"));
    LARARIUM_ASSIGN_OR_RETURN(place.tags, ParseTags(field));
  }
  if (view.Has("acoustics")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("acoustics"));
    LARARIUM_ASSIGN_OR_RETURN(place.acoustics, stage::ParseAcoustics(field));
  }
  if (view.Has("check_picks")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("check_picks"));
    LARARIUM_RETURN_IF_ERROR(ParseCheckPicks(field, place.check_picks));
  }
  return ParseProbes(view, place.probes);
}

Result<PlaceDocument> ParsePlace(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields(
      {"name", "training", "preview", "intrinsics", "camera", "added", "tags", "picks", "adjust",
       "camera_nudge", "occluders", "probe", "probes", "acoustics", "check_picks"}));
  PlaceDocument place;
  LARARIUM_ASSIGN_OR_RETURN(place.name, ParsePlainName(view, "name"));
  LARARIUM_RETURN_IF_ERROR(ParseOptionalFields(view, place));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView picks, view.Field("picks"));
  LARARIUM_ASSIGN_OR_RETURN(place.picks, ParsePicks(picks));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView adjust, view.Field("adjust"));
  LARARIUM_RETURN_IF_ERROR(adjust.CheckFields({"translation", "rotation", "scale"}));
  LARARIUM_ASSIGN_OR_RETURN(place.picked_from_stage, ParseSimilarity(adjust));
  LARARIUM_ASSIGN_OR_RETURN(place.camera_nudge, ParseVector(view, "camera_nudge"));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView occluders, view.Field("occluders"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, occluders.Array(kMaxEntries));
  for (const JsonView& entry : list) {
    LARARIUM_ASSIGN_OR_RETURN(OccluderDocument occluder, ParseOccluder(entry));
    place.occluders.push_back(std::move(occluder));
  }
  return place;
}

Json FormatPickList(const stage::Anchor& anchor) {
  Json list = Json::array();
  for (const stage::Pick& pick : anchor.picks) {
    list.push_back({{"frame_index", pick.frame_index},
                    {"frame", pick.frame},
                    {"pixel", Json::array({pick.pixel.x(), pick.pixel.y()})}});
    if (pick.session != 0) {
      list.back()["session"] = pick.session;
    }
  }
  return list;
}

Json FormatPlace(const PlaceDocument& place) {
  Json json = {{"name", place.name},
               {"picks", FormatPicks(place.picks)},
               {"camera_nudge", FormatVector(place.camera_nudge)},
               {"occluders", Json::array()}};
  FormatSimilarity(place.picked_from_stage, json["adjust"]);
  json.update(FormatRecordings(RecordingsOf(place)));
  if (!place.preview.empty()) {
    json["preview"] = FormatSource(place.preview);
  }
  if (place.camera) {
    json["camera"] = light::FormatCameraTraits(*place.camera);
  }
  if (place.tags) {
    json["tags"] = {{"family", place.tags->family}, {"size_m", place.tags->size_m}};
  }
  for (const OccluderDocument& occluder : place.occluders) {
    json["occluders"].push_back(FormatOccluder(occluder));
  }
  for (const ProbeDocument& probe : place.probes) {
    json["probes"].push_back({{"name", probe.name},
                              {"file", probe.file},
                              {"position", FormatVector(probe.position)},
                              {"hour", probe.hour},
                              {"rotation", FormatRotation(probe.stage_from_probe)},
                              {"scale", probe.scale}});
    if (probe.balance != Eigen::Vector3d::Ones()) {
      json["probes"].back()["balance"] = FormatVector(probe.balance);
    }
  }
  if (place.acoustics != stage::Acoustics()) {
    json["acoustics"] = stage::FormatAcoustics(place.acoustics);
  }
  for (const stage::Anchor& anchor : place.check_picks) {
    json["check_picks"].push_back({{"name", anchor.name}, {"picks", FormatPickList(anchor)}});
  }
  return json;
}

constexpr std::string_view kNewDrama =
    R"(-- The drama: what the people of this place do. docs/drama.md has the vocabulary.

function main()
end
)";

}  // namespace

std::string CornerName(size_t index) { return "corner " + std::to_string(index + 1); }

std::string ModelPairName(size_t index) { return "point " + std::to_string(index + 1); }

Json FormatPicks(const stage::StagePicks& picks) {
  Json json = {{"length_m", picks.length_m}};
  for (const auto& [key, anchor] : Anchors()) {
    json[key] = FormatPickList(picks.*anchor);
  }
  return json;
}

Json FormatOccluder(const OccluderDocument& occluder) {
  Json json = {{"name", occluder.name}};
  if (occluder.drawn()) {
    json["corners"] = Json::array();
    for (const stage::Anchor& corner : occluder.corners) {
      json["corners"].push_back(FormatPickList(corner));
    }
    json["depth"] = occluder.depth;
    if (occluder.flat) {
      json["flat"] = true;
    }
  } else {
    if (occluder.shape) {
      json["shape"] = FormatShape(*occluder.shape);
    } else {
      json["file"] = occluder.file;
    }
    FormatSimilarity(occluder.stage_from_mesh, json);
    for (const ModelPairDocument& pair : occluder.model_pairs) {
      json["model_pairs"].push_back(
          {{"on_mesh", FormatVector(pair.on_mesh)}, {"picks", FormatPickList(pair.anchor)}});
    }
    if (occluder.keep_scale) {
      json["keep_scale"] = true;
    }
  }
  for (const auto& [key, does] : {std::pair{"receives_shadow", occluder.receives_shadow},
                                  {"blocks_sound", occluder.blocks_sound},
                                  {"blocks_walking", occluder.blocks_walking}}) {
    if (!does) {
      json[key] = false;
    }
  }
  return json;
}

stage::StagePicks EmptyPicks() {
  stage::StagePicks picks;
  for (const auto& [key, anchor] : Anchors()) {
    (picks.*anchor).name = key;
  }
  return picks;
}

void ForgetSession(PlaceDocument& place, uint32_t session) {
  if (session == 0 || session > place.added.size()) {
    return;
  }
  place.added.erase(place.added.begin() + (session - 1));
  ForEachAnchor(place, [&](stage::Anchor& anchor) {
    std::erase_if(anchor.picks, [&](const stage::Pick& pick) { return pick.session == session; });
    for (stage::Pick& pick : anchor.picks) {
      pick.session -= pick.session > session ? 1 : 0;
    }
  });
}

OccluderDocument NewOccluder(const std::string& name, const OccluderShape& shape) {
  OccluderDocument occluder;
  occluder.name = name;
  occluder.shape = shape;
  occluder.blocks_sound = occluder.blocks_walking = EntryOf(shape.kind).in_the_way;
  return occluder;
}

const OccluderDocument* PlaceDocument::FindOccluder(std::string_view occluder) const {
  const auto found = std::find_if(occluders.begin(), occluders.end(),
                                  [&](const auto& o) { return o.name == occluder; });
  return found == occluders.end() ? nullptr : &*found;
}

OccluderDocument* PlaceDocument::FindOccluder(std::string_view occluder) {
  return const_cast<OccluderDocument*>(std::as_const(*this).FindOccluder(occluder));
}

std::string OccluderNames(const PlaceDocument& place) {
  std::string names;
  for (const OccluderDocument& occluder : place.occluders) {
    names += (names.empty() ? "" : ", ") + occluder.name;
  }
  return names;
}

const PlaceDocument* ProjectDocument::FindPlace(std::string_view name) const {
  const auto found =
      std::find_if(places.begin(), places.end(), [&](const auto& p) { return p.name == name; });
  return found == places.end() ? nullptr : &*found;
}

PlaceDocument* ProjectDocument::FindPlace(std::string_view name) {
  return const_cast<PlaceDocument*>(std::as_const(*this).FindPlace(name));
}

namespace {

Status ParseLanguages(const JsonView& view, std::string_view key, std::vector<std::string>& list) {
  if (!view.Has(key)) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> items, field.Array(64));
  for (const JsonView& item : items) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string language, item.Text(64));
    if (!stage::IsLanguageTag(language) ||
        std::find(list.begin(), list.end(), language) != list.end()) {
      return item.Problem("'" + language + "' is not a valid language tag, or is used twice",
                          "use one like la, it or en");
    }
    list.push_back(language);
  }
  return Status();
}

Result<SpeechDocument> ParseSpeech(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"spoken", "captions", "description"}));
  SpeechDocument speech;
  LARARIUM_RETURN_IF_ERROR(ParseLanguages(view, "spoken", speech.spoken));
  LARARIUM_RETURN_IF_ERROR(ParseLanguages(view, "captions", speech.captions));
  if (view.Has("description")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView voice, view.Field("description"));
    LARARIUM_ASSIGN_OR_RETURN(speech.description, ParseVoice(voice));
  }
  return speech;
}

Status ParseCheckPoints(const JsonView& view, std::vector<CheckPointDocument>& points) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, view.Array(kMaxCheckPoints));
  for (const JsonView& entry : list) {
    LARARIUM_RETURN_IF_ERROR(entry.CheckFields({"name", "position"}));
    CheckPointDocument& point = points.emplace_back();
    LARARIUM_ASSIGN_OR_RETURN(point.name, entry.Text("name", kMaxCheckPointName));
    LARARIUM_ASSIGN_OR_RETURN(point.position, ParseVector(entry, "position"));
    if (point.name.empty()) {
      return entry.Problem("\"name\" is empty");
    }
  }
  return CheckUniqueNames(points, view.place());
}

}  // namespace

Result<ProjectDocument> ParseProject(const Json& json, const std::string& where) {
  const JsonView view(json, where);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema > kProjectSchema) {
    return Status::Error(where,
                         "was written by a newer Lararium (schema " + std::to_string(schema) +
                             ", this one reads up to " + std::to_string(kProjectSchema) + ")",
                         "open it with that version");
  }
  LARARIUM_RETURN_IF_ERROR(view.CheckFields(
      {"schema", "title", "credits", "places", "cast", "objects", "speech", "check_points"}));
  ProjectDocument document;
  LARARIUM_ASSIGN_OR_RETURN(document.title, view.Text("title"));
  LARARIUM_ASSIGN_OR_RETURN(document.credits, view.Text("credits"));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView places, view.Field("places"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> place_list, places.Array(kMaxEntries));
  for (const JsonView& entry : place_list) {
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument parsed, ParsePlace(entry));
    LARARIUM_RETURN_IF_ERROR(CheckUniqueNames(parsed.occluders, entry.place() + ".occluders"));
    document.places.push_back(std::move(parsed));
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView cast, view.Field("cast"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> cast_list, cast.Array(kMaxEntries));
  for (const JsonView& entry : cast_list) {
    LARARIUM_ASSIGN_OR_RETURN(CastDocument parsed, ParseCastMember(entry));
    document.cast.push_back(std::move(parsed));
  }
  if (view.Has("objects")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView objects, view.Field("objects"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, objects.Array(kMaxEntries));
    for (const JsonView& entry : list) {
      LARARIUM_ASSIGN_OR_RETURN(ObjectDocument parsed, ParseObject(entry));
      document.objects.push_back(std::move(parsed));
    }
    LARARIUM_RETURN_IF_ERROR(CheckUniqueNames(document.objects, objects.place()));
  }
  if (view.Has("speech")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView speech, view.Field("speech"));
    LARARIUM_ASSIGN_OR_RETURN(document.speech, ParseSpeech(speech));
  }
  if (view.Has("check_points")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView points, view.Field("check_points"));
    LARARIUM_RETURN_IF_ERROR(ParseCheckPoints(points, document.check_points));
  }
  LARARIUM_RETURN_IF_ERROR(CheckUniqueNames(document.places, places.place()));
  LARARIUM_RETURN_IF_ERROR(CheckUniqueNames(document.cast, cast.place()));
  return document;
}

Json FormatProject(const ProjectDocument& document) {
  Json json = {{"schema", kProjectSchema},
               {"title", document.title},
               {"credits", document.credits},
               {"places", Json::array()},
               {"cast", Json::array()}};
  for (const PlaceDocument& place : document.places) {
    json["places"].push_back(FormatPlace(place));
  }
  for (const CastDocument& member : document.cast) {
    json["cast"].push_back(FormatCastMember(member));
  }
  for (const ObjectDocument& object : document.objects) {
    json["objects"].push_back(FormatObject(object));
  }
  for (const CheckPointDocument& point : document.check_points) {
    json["check_points"].push_back(
        {{"name", point.name}, {"position", FormatVector(point.position)}});
  }
  if (!document.speech.empty()) {
    json["speech"] = {{"spoken", document.speech.spoken}, {"captions", document.speech.captions}};
    if (document.speech.description != bake::VoiceSettings()) {
      json["speech"]["description"] = FormatVoice(document.speech.description);
    }
  }
  return json;
}

Result<ProjectDocument> LoadProject(const ProjectPaths& paths) {
  std::error_code ignored;
  if (!std::filesystem::exists(paths.Project(), ignored)) {
    return Status::Error(paths.folder.string(), "is not a project: it has no project.json",
                         "make one with: lararium-editor new " + paths.folder.string());
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(paths.Project()));
  return ParseProject(json, paths.Project().string());
}

Status SaveProject(const ProjectPaths& paths, const ProjectDocument& document) {
  return SaveJson(paths.Project(), FormatProject(document));
}

Status CreateProject(const ProjectPaths& paths, const std::string& title) {
  std::error_code error;
  if (std::filesystem::exists(paths.folder, error) &&
      !std::filesystem::is_empty(paths.folder, error)) {
    return Status::Error(paths.folder.string(), "exists and is not an empty folder",
                         "choose another name");
  }
  for (const std::filesystem::path& folder :
       {paths.folder, paths.Cast(), paths.folder / "places"}) {
    std::filesystem::create_directories(folder, error);
    if (error) {
      return Status::Error(folder.string(), "cannot make the folder: " + error.message());
    }
  }
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(paths.Drama(), kNewDrama));
  ProjectDocument document;
  document.title = title;
  return SaveProject(paths, document);
}

Result<std::string> ChoosePlace(const ProjectPaths& paths,
                                const ProjectDocument& document,
                                const std::string& name) {
  if (!name.empty()) {
    if (document.FindPlace(name) == nullptr) {
      return Status::Error(paths.Project().string(), "has no place \"" + name + "\"");
    }
    return name;
  }
  if (document.places.size() != 1) {
    return Status::Error(paths.Project().string(),
                         "has " + std::to_string(document.places.size()) + " places",
                         "name one with --place");
  }
  return document.places.front().name;
}

}  // namespace lararium::editor
