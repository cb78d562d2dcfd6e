#include "editor/export/export.h"

#include <algorithm>
#include <deque>
#include <iterator>

#include "editor/export/qr_page.h"
#include "editor/export/web_content.h"
#include "shared/bundle/bundle.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/core/file.h"
#include "shared/human/human.h"
#include "shared/render/text/caption_font.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/mesh_file.h"
#include "shared/stage/object_use.h"
#include "shared/stage/paradata.h"
#include "shared/stage/prop.h"
#include "shared/stage/viseme_file.h"
#include "shared/vision/scene_database.h"

namespace lararium::exporter {
namespace {

constexpr char kDramaName[] = "drama.lua";
// Files of the page that only the page of a fleet loads.
constexpr std::string_view kMqtt = "mqtt.min.js";
constexpr std::string_view kFleetFiles[] = {kMqtt, "mqtt.LICENSE.md", "fleet.js"};

// The content of the file: the manifest, and members that refer to the content and to `made`.
struct Packing {
  bundle::ShowManifest manifest;
  std::vector<bundle::MemberContent> members;
  std::deque<std::vector<std::byte>> made;  // A deque keeps addresses stable.

  struct PackedProp {
    const std::vector<std::byte>* bytes = nullptr;
    bundle::ObjectEntry entry;
  };
  std::vector<PackedProp> props;
};

Status PackPlace(const PlaceContent& content, size_t index, Packing& packing) {
  const stage::Place& where = content.place;
  const std::string folder = "places/" + std::to_string(index) + "/";
  bundle::PlaceEntry entry{
      where.name,  folder + "scene.larscene", where.map_from_stage, where.camera_nudge, {},
      where.probes};
  entry.camera = where.camera;
  entry.acoustics = where.acoustics;
  const auto scene = vision::ParseSceneDatabase(content.scene, "place '" + where.name + "'");
  LARARIUM_RETURN_IF_ERROR(scene.status());
  packing.members.push_back({entry.scene, content.scene});
  for (const stage::Occluder& occluder : where.occluders) {
    LARARIUM_RETURN_IF_ERROR(occluder.mesh.Validate("occluder '" + occluder.name + "'"));
    packing.made.push_back(stage::SerializeMesh(occluder.mesh));
    const std::string member =
        folder + "occluder" + std::to_string(entry.occluders.size()) + ".larmesh";
    packing.members.push_back({member, packing.made.back()});
    entry.occluders.push_back({occluder.name, member, occluder.stage_from_mesh,
                               occluder.blocks_sound, occluder.blocks_walking,
                               occluder.receives_shadow});
  }
  for (const light::GlossyMap& glossy : content.glossy) {
    entry.glossy.emplace_back();
    if (!glossy.empty()) {
      entry.glossy.back() = folder + "probe" + std::to_string(entry.glossy.size() - 1) + ".gloss";
      packing.made.push_back(light::SerializeGlossyMap(glossy));
      packing.members.push_back({entry.glossy.back(), packing.made.back()});
    }
  }
  packing.manifest.places.push_back(std::move(entry));
  return Status();
}

Status PackCast(const CastContent& content, size_t index, Packing& packing) {
  const auto human = human::ParseHuman(content.human, "cast '" + content.name + "'");
  LARARIUM_RETURN_IF_ERROR(human.status());
  const std::string member = "cast/" + std::to_string(index) + ".larhuman";
  packing.members.push_back({member, content.human});
  bundle::CastEntry& entry = packing.manifest.cast.emplace_back();
  entry = {content.name, member};
  if (!content.motion.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        human::ParseHuman(content.motion, "motion of '" + content.name + "'").status());
    entry.motion = "cast/" + std::to_string(index) + ".motion.larhuman";
    packing.members.push_back({entry.motion, content.motion});
  }
  return Status();
}

// Objects with the same model share its member.
Status PackObject(const ObjectContent& content, size_t index, Packing& packing) {
  const std::string place = "object '" + content.name + "'";
  const auto same = std::find_if(
      packing.props.begin(), packing.props.end(),
      [&](const Packing::PackedProp& packed) { return *packed.bytes == content.prop; });
  if (same != packing.props.end()) {
    packing.manifest.objects.push_back(
        {content.name, same->entry.prop, content.stage_from_object, same->entry.extent});
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, stage::ParseProp(content.prop, place));
  LARARIUM_RETURN_IF_ERROR(stage::ObjectModel::Create(std::move(prop), place).status());
  const std::string stem = "props/" + std::to_string(index);
  bundle::ObjectEntry entry{content.name, stem + ".larprop", content.stage_from_object};
  packing.members.push_back({entry.prop, content.prop});
  if (!content.extent.empty()) {
    LARARIUM_RETURN_IF_ERROR(stage::ParseProp(content.extent, place).status());
    entry.extent = stem + ".extent.larprop";
    packing.members.push_back({entry.extent, content.extent});
  }
  packing.props.push_back({&content.prop, entry});
  packing.manifest.objects.push_back(std::move(entry));
  return Status();
}

Status PackSpoken(const SpokenContent& content, size_t /*index*/, Packing& packing) {
  LARARIUM_RETURN_IF_ERROR(
      stage::ParseVisemes(content.visemes, "line '" + content.line + "'").status());
  const std::string stem = "speech/" + content.language + "/" + content.line;
  bundle::SpokenEntry entry{stem + ".visemes.json", content.sound.empty() ? "" : stem + ".flac"};
  packing.members.push_back({entry.visemes, std::as_bytes(std::span(content.visemes))});
  if (!content.sound.empty()) {
    packing.members.push_back({entry.sound, content.sound});
  }
  std::vector<bundle::LineEntry>& lines = packing.manifest.lines;
  auto line = std::find_if(lines.begin(), lines.end(),
                           [&](const auto& known) { return known.name == content.line; });
  if (line == lines.end()) {
    line = lines.insert(lines.end(), {content.line, content.speaker, {}});
  }
  line->spoken[content.language] = std::move(entry);
  return Status();
}

// `kind` is "captions" or "descriptions". `list` belongs to the manifest.
Status PackTexts(const CaptionContent& content,
                 const std::string& kind,
                 std::vector<bundle::SpokenLanguage>& list,
                 Packing& packing) {
  LARARIUM_RETURN_IF_ERROR(
      stage::ParseCaptions(content.captions, kind + " of " + content.language).status());
  const std::string member = "speech/" + content.language + "/" + kind + ".json";
  packing.members.push_back({member, std::as_bytes(std::span(content.captions))});
  list.push_back({content.language, member});
  return Status();
}

Status PackCaptions(const CaptionContent& content, size_t /*index*/, Packing& packing) {
  return PackTexts(content, "captions", packing.manifest.spoken, packing);
}

Status PackDescriptions(const CaptionContent& content, size_t /*index*/, Packing& packing) {
  return PackTexts(content, "descriptions", packing.manifest.descriptions, packing);
}

Status PackCaptionFont(const ExportContent& content, Packing& packing) {
  if (content.caption_metrics.empty()) {
    return Status();
  }
  const auto font =
      render::ParseCaptionFont(content.caption_metrics, content.caption_atlas, "caption font");
  LARARIUM_RETURN_IF_ERROR(font.status());
  packing.manifest.caption_font = {"captions/font.json", "captions/font.png"};
  packing.members.push_back(
      {"captions/font.json", std::as_bytes(std::span(content.caption_metrics))});
  packing.members.push_back({"captions/font.png", content.caption_atlas});
  return Status();
}

Status PackSound(const audio::SoundData& content, size_t index, Packing& packing) {
  LARARIUM_RETURN_IF_ERROR(
      audio::SoundReader::Open(content.bytes, "sound '" + content.name + "'").status());
  const std::string member = "sounds/" + std::to_string(index);
  packing.members.push_back({member, content.bytes});
  packing.manifest.sounds.push_back({content.name, member});
  return Status();
}

Status PackParadata(const ExportContent& content, Packing& packing) {
  if (content.paradata.empty()) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(stage::ParseParadata(content.paradata, "paradata").status());
  packing.manifest.paradata = "paradata.json";
  packing.members.push_back(
      {packing.manifest.paradata, std::as_bytes(std::span(content.paradata))});
  return Status();
}

// Packs all parts of one kind.
template <typename Content>
Status PackAll(const std::vector<Content>& contents,
               Status (*pack)(const Content&, size_t, Packing&),
               Packing& packing,
               Progress& progress) {
  for (size_t i = 0; i < contents.size(); ++i) {
    progress.Report("checking", static_cast<double>(i) / static_cast<double>(contents.size()));
    if (progress.Cancelled()) {
      return Status::Error("export", "cancelled");
    }
    LARARIUM_RETURN_IF_ERROR(pack(contents[i], i, packing));
  }
  return Status();
}

}  // namespace

namespace {

Result<Packing> Pack(const ExportContent& content, Progress& progress) {
  Packing packing;
  packing.manifest.title = content.title;
  packing.manifest.credits = content.credits;
  packing.manifest.drama = kDramaName;
  packing.members.push_back({kDramaName, std::as_bytes(std::span(content.drama))});
  LARARIUM_RETURN_IF_ERROR(PackAll(content.places, PackPlace, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.cast, PackCast, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.objects, PackObject, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.lines, PackSpoken, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.spoken, PackCaptions, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.descriptions, PackDescriptions, packing, progress));
  packing.manifest.captions = content.captions;
  LARARIUM_RETURN_IF_ERROR(PackCaptionFont(content, packing));
  LARARIUM_RETURN_IF_ERROR(PackAll(content.sounds, PackSound, packing, progress));
  LARARIUM_RETURN_IF_ERROR(PackParadata(content, packing));
  progress.Report("writing", 0.0);
  return packing;
}

// All files below a folder, in the order of their names.
std::vector<bundle::MemberContent> FilesBelow(const std::filesystem::path& folder) {
  std::vector<bundle::MemberContent> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back({entry.path().lexically_relative(folder).string(), entry.path()});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

}  // namespace

Status ExportBundle(const ExportContent& content,
                    const std::filesystem::path& path,
                    Progress& progress,
                    const bundle::SecretKey* key) {
  LARARIUM_ASSIGN_OR_RETURN(const Packing packing, Pack(content, progress));
  LARARIUM_RETURN_IF_ERROR(bundle::WriteBundle(path, packing.manifest, packing.members, key));
  progress.Report("verifying", 0.0);
  LARARIUM_RETURN_IF_ERROR(bundle::Bundle::Open(path).status());
  progress.Report("verifying", 1.0);
  return Status();
}

Status CheckWebExport(const WebExport& web) {
  if (!FileExists(web.page / "module.wasm")) {
    return Status::Error(web.page.string(), "the page for browsers is not there",
                         "build it with scripts/install_web_tools.sh, cmake --preset web and "
                         "cmake --build --preset web");
  }
  if (web.fleet) {
    LARARIUM_RETURN_IF_ERROR(bundle::CheckFleet(*web.fleet, "--fleet"));
    if (!FileExists(web.page / kMqtt)) {
      return Status::Error(web.page.string(), "the page cannot speak with a broker",
                           "run scripts/fetch_mqtt.sh, cmake --preset web and cmake --build "
                           "--preset web");
    }
  }
  return bundle::CheckWebFolder(web.folder);
}

Result<bundle::WebFolderReport> ExportWebFolder(ExportContent content,
                                                const WebExport& web,
                                                const bundle::SecretKey& key,
                                                Progress& progress) {
  LARARIUM_RETURN_IF_ERROR(CheckWebExport(web));
  LARARIUM_RETURN_IF_ERROR(ReduceForWeb(content, progress));
  LARARIUM_ASSIGN_OR_RETURN(Packing packing, Pack(content, progress));
  packing.manifest.fleet = web.fleet;
  std::vector<bundle::MemberContent> page = FilesBelow(web.page);
  if (!web.fleet) {
    std::erase_if(page, [](const bundle::MemberContent& file) {
      return std::find(std::begin(kFleetFiles), std::end(kFleetFiles), file.name) !=
             std::end(kFleetFiles);
    });
  }
  std::string print;
  std::string code;
  if (!web.address.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(print, MakeQrPage(content.title, web.address, content.captions));
    LARARIUM_ASSIGN_OR_RETURN(code, MakeQrCodeSvg(web.address));
    page.push_back({"print.html", std::as_bytes(std::span(print))});
    page.push_back({"code.svg", std::as_bytes(std::span(code))});
  }
  return bundle::WriteWebFolder(web.folder, packing.manifest, packing.members, std::move(page),
                                key);
}

}  // namespace lararium::exporter
