#include "editor/document/project.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/document/named_entries.h"
#include "editor/document/place_recordings.h"
#include "editor/train/april_tags.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/stage/acoustics_file.h"
#include "shared/stage/caption_file.h"

namespace lararium::editor {

namespace {

using geometry::CameraModel;
using geometry::Similarity3;

constexpr size_t kMaxEntries = 10'000;  // Limit for each list in the file.
constexpr size_t kMaxProbes = 64;       // Limit for each place; bundles have the same limit.
constexpr double kMaxPixel = 1e6;

void DescribePick(Fields& fields, stage::Pick& pick) {
  fields.Integer("frame_index", pick.frame_index, 0, int64_t{1} << 40);
  fields.Text("frame", pick.frame);
  fields.Numbers("pixel", std::span(pick.pixel.data(), 2));
  fields.Require(pick.pixel.cwiseAbs().maxCoeff() <= kMaxPixel,
                 "\"pixel\" lies outside of any image");
  fields.Integer(Optional("session", pick.session != 0), pick.session, 0, kMaxAddedSessions);
}

void DescribePickList(Fields& fields, const FieldKey& key, stage::Anchor& anchor) {
  fields.List(key, anchor.picks, kMaxEntries, DescribePick);
}

// The fixed names of the anchors. Under its name, each has a list of picks.
std::array<std::pair<const char*, stage::Anchor stage::StagePicks::*>, 5> Anchors() {
  return {{{"origin", &stage::StagePicks::origin},
           {"forward", &stage::StagePicks::forward},
           {"floor", &stage::StagePicks::floor},
           {"length_from", &stage::StagePicks::length_from},
           {"length_to", &stage::StagePicks::length_to}}};
}

void DescribePicks(Fields& fields, stage::StagePicks& picks) {
  for (const auto& [key, anchor] : Anchors()) {
    DescribePickList(fields, key, picks.*anchor);
  }
  fields.Number("length_m", picks.length_m, 1e-6, kMaxLength);
}

void DescribeCheckPicks(Fields& fields, stage::Anchor& anchor) {
  fields.Text("name", anchor.name, kMaxCheckPointName);
  DescribePickList(fields, "picks", anchor);
}

void DescribeTags(Fields& fields, TagsDocument& tags) {
  fields.Text("family", tags.family);
  const std::span<const std::string_view> families = train::TagFamilies();
  fields.Require(std::find(families.begin(), families.end(), tags.family) != families.end(),
                 "\"family\" is not known", train::TagFamilyRemedy());
  fields.Number("size_m", tags.size_m, 1e-4, 1e3);
}

void DescribeModelPair(Fields& fields, ModelPairDocument& pair) {
  fields.Numbers("on_mesh", std::span(pair.on_mesh.data(), 3));
  constexpr double kFarthest = 1e9;  // Limit in the unit of the mesh.
  fields.Require(pair.on_mesh.cwiseAbs().maxCoeff() <= kFarthest,
                 "\"on_mesh\" lies beyond any model");
  DescribePickList(fields, "picks", pair.anchor);
}

// The kinds have different fields. An occluder that was drawn may have the alignment of a model,
// and the others a depth; these are not kept.
void DescribeGeometry(Fields& fields, OccluderDocument& occluder) {
  using Kind = OccluderDocument::Kind;
  const Kind kind = occluder.kind();
  const bool model = fields.Has("file", kind == Kind::kModel);
  const bool shape = fields.Has("shape", kind == Kind::kShape);
  const bool drawn = fields.Has("corners", kind == Kind::kDrawn);
  fields.Require(int{model} + int{shape} + int{drawn} == 1,
                 "must have either the \"file\" of a model, a \"shape\" or \"corners\"");
  for (const char* other : {"flat", "model_pairs", "keep_scale"}) {
    const bool has = fields.Has(other, false);
    const bool of_drawn = std::string_view(other) == "flat";
    fields.Require(!(has && drawn && !of_drawn),
                   "was drawn: \"model_pairs\" and \"keep_scale\" are only for models");
    fields.Require(!(has && shape),
                   "is a shape: \"" + std::string(other) + "\" is not a field of shapes");
    fields.Require(!(has && model && of_drawn),
                   "is a model: \"flat\" is only for occluders that were drawn");
  }
  for (const char* other : {"depth", "translation", "rotation", "scale"}) {
    fields.Has(other, false);
  }
  if (drawn) {
    fields.List(
        "corners", occluder.corners, kMaxCorners,
        [&](const FieldKey& key, stage::Anchor& corner) { DescribePickList(fields, key, corner); });
    fields.Number("depth", occluder.depth, 0.0, kMaxDepth);
    fields.Flag(Optional("flat", occluder.flat), occluder.flat);
    return;
  }
  if (shape) {
    fields.Object("shape", occluder.shape);
  } else {
    fields.List(Optional("model_pairs", !occluder.model_pairs.empty()), occluder.model_pairs,
                kMaxModelPairs, DescribeModelPair);
    fields.Flag(Optional("keep_scale", occluder.keep_scale), occluder.keep_scale);
    fields.Text("file", occluder.file);
    fields.Require(!model || !occluder.file.empty(), "\"file\" must name a model");
  }
  DescribeSimilarity(fields, occluder.stage_from_mesh);
}

void DescribePlace(Fields& fields, PlaceDocument& place) {
  DescribePlainName(fields, "name", place.name);
  DescribeTitle(fields, place.title);
  PlaceRecordings recordings = RecordingsOf(place);
  DescribeFields(fields, recordings);
  if (fields.reading()) {
    SetRecordings(recordings, place);
  }
  DescribeSource(fields, "preview", place.preview);
  fields.Object("camera", place.camera);
  fields.Object("tags", place.tags, DescribeTags);
  fields.Object("picks", place.picks, DescribePicks);
  fields.Object("adjust", place.picked_from_stage, DescribeSimilarity);
  DescribeVector(fields, "camera_nudge", place.camera_nudge);
  fields.List("occluders", place.occluders, kMaxEntries);
  fields.List(Optional("probes", !place.probes.empty()), place.probes, kMaxProbes);
  fields.Object(Optional("acoustics", place.acoustics != stage::Acoustics()), place.acoustics);
  fields.List(Optional("check_picks", !place.check_picks.empty()), place.check_picks,
              kMaxCheckPoints, DescribeCheckPicks);
  RequireUniqueNames(fields, "check_picks", place.check_picks);
  RequireUniqueNames(fields, "probes", place.probes);
  RequireUniqueNames(fields, "occluders", place.occluders);
}

constexpr std::string_view kNewDrama =
    R"(-- The drama: what the people of this place do. docs/drama.md has the vocabulary.

function main()
end
)";

}  // namespace

std::string CornerName(size_t index) { return "corner " + std::to_string(index + 1); }

std::string ModelPairName(size_t index) { return "point " + std::to_string(index + 1); }

void DescribeFields(Fields& fields, OccluderDocument& occluder) {
  DescribePlainName(fields, "name", occluder.name);
  DescribeGeometry(fields, occluder);
  fields.Flag(Optional("receives_shadow", !occluder.receives_shadow), occluder.receives_shadow);
  fields.Flag(Optional("blocks_sound", !occluder.blocks_sound), occluder.blocks_sound);
  fields.Flag(Optional("blocks_walking", !occluder.blocks_walking), occluder.blocks_walking);
  if (fields.reading()) {
    for (size_t i = 0; i < occluder.corners.size(); ++i) {
      occluder.corners[i].name = CornerName(i);
    }
    for (size_t i = 0; i < occluder.model_pairs.size(); ++i) {
      occluder.model_pairs[i].anchor.name = ModelPairName(i);
    }
  }
}

void DescribeFields(Fields& fields, ProbeDocument& probe) {
  DescribePlainName(fields, "name", probe.name);
  fields.Text("file", probe.file);
  DescribeVector(fields, "position", probe.position);
  fields.Number("hour", probe.hour, 0.0, 24.0);
  DescribeRotation(fields, probe.stage_from_probe);
  fields.Number("scale", probe.scale, 0.0, 1e9);
  fields.Numbers(Optional("balance", probe.balance != Eigen::Vector3d::Ones()),
                 std::span(probe.balance.data(), 3));
  fields.Require(probe.balance.minCoeff() > 1e-3 && probe.balance.maxCoeff() < 1e3,
                 "\"balance\" must be three numbers about 1");
}

Json FormatPicks(const stage::StagePicks& picks) { return FormatFields(picks, DescribePicks); }

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

std::string ProjectDocument::PersonLabel(const std::string& name) const {
  const auto found =
      std::find_if(cast.begin(), cast.end(), [&](const auto& m) { return m.name == name; });
  return found == cast.end() ? name : found->label();
}

namespace {

void DescribeLanguages(Fields& fields, std::string_view name, std::vector<std::string>& list) {
  std::set<std::string> seen;
  fields.List(Optional(name), list, 64, [&](const FieldKey& key, std::string& language) {
    fields.Text(key, language, 64);
    fields.RequireAt(key, stage::IsLanguageTag(language) && seen.insert(language).second,
                     "'" + language + "' is not a valid language tag, or is used twice",
                     "use one like la, it or en");
  });
}

void DescribeSpeech(Fields& fields, SpeechDocument& speech) {
  DescribeLanguages(fields, "spoken", speech.spoken);
  DescribeLanguages(fields, "captions", speech.captions);
  fields.Object(Optional("description", speech.description != bake::VoiceSettings()),
                speech.description, DescribeVoice);
}

void DescribeCheckPoint(Fields& fields, CheckPointDocument& point) {
  fields.Text("name", point.name, kMaxCheckPointName);
  DescribeVector(fields, "position", point.position);
  fields.Require(!point.name.empty(), "\"name\" is empty");
}

void DescribeProject(Fields& fields, ProjectDocument& document) {
  fields.Schema(kProjectSchema,
                "was written by a newer Lararium (schema {}, this one reads up to " +
                    std::to_string(kProjectSchema) + ")",
                "open it with that version");
  fields.Text("title", document.title);
  fields.Text("credits", document.credits);
  fields.List("places", document.places, kMaxEntries, DescribePlace);
  fields.List("cast", document.cast, kMaxEntries);
  fields.List(Optional("objects", !document.objects.empty()), document.objects, kMaxEntries);
  fields.Object(Optional("speech", !document.speech.empty()), document.speech, DescribeSpeech);
  fields.List(Optional("check_points", !document.check_points.empty()), document.check_points,
              kMaxCheckPoints, DescribeCheckPoint);
  RequireUniqueNames(fields, "objects", document.objects);
  RequireUniqueNames(fields, "check_points", document.check_points);
  RequireUniqueNames(fields, "places", document.places);
  RequireUniqueNames(fields, "cast", document.cast);
}

}  // namespace

Result<ProjectDocument> ParseProject(const Json& json, const std::string& where) {
  return ParseFields<ProjectDocument>(JsonView(json, where), DescribeProject);
}

Json FormatProject(const ProjectDocument& document) {
  return FormatFields(document, DescribeProject);
}

Result<ProjectDocument> LoadProject(const ProjectPaths& paths) {
  if (!FileExists(paths.Project())) {
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
    LARARIUM_ASSIGN_OR_RETURN(
        const PlaceDocument* place,
        FindTitled(document.places, name, paths.Project().string(), "has no place"));
    return place->name;
  }
  if (document.places.size() != 1) {
    return Status::Error(paths.Project().string(),
                         "has " + std::to_string(document.places.size()) + " places",
                         "name one with --place");
  }
  return document.places.front().name;
}

}  // namespace lararium::editor
