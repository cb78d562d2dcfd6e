#include "shared/show/show_content.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "shared/core/parallel.h"
#include "shared/geometry/glm_convert.h"
#include "shared/show/guide_texts.h"
#include "shared/stage/mesh_file.h"
#include "shared/stage/viseme_file.h"

namespace lararium::show {
namespace {

// The bundle's place of that name, or all places if the name is empty.
Result<std::span<const bundle::PlaceEntry>> ChoosePlaces(const bundle::Bundle& bundle,
                                                         std::string_view name) {
  const std::span<const bundle::PlaceEntry> places = bundle.manifest().places;
  if (name.empty()) {
    return places;
  }
  const auto found = std::find_if(places.begin(), places.end(),
                                  [name](const auto& place) { return place.name == name; });
  if (found == places.end()) {
    return Status::Error(bundle.place(), "has no place \"" + std::string(name) + "\"",
                         "choose one that lararium-player info lists");
  }
  return places.subspan(static_cast<size_t>(found - places.begin()), 1);
}

Result<stage::Place> LoadStage(const bundle::Bundle& bundle, const bundle::PlaceEntry& entry) {
  stage::Place place;
  place.name = entry.name;
  place.map_from_stage = entry.map_from_stage;
  place.camera_nudge = entry.camera_nudge;
  place.camera = entry.camera;
  place.probes = entry.probes;
  place.acoustics = entry.acoustics;
  for (const bundle::OccluderEntry& occluder : entry.occluders) {
    LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(occluder.mesh));
    LARARIUM_ASSIGN_OR_RETURN(geometry::TriangleMesh mesh,
                              stage::ParseMesh(bytes, bundle.place() + ": " + occluder.mesh));
    place.occluders.push_back({occluder.name, std::move(mesh), occluder.stage_from_mesh,
                               occluder.blocks_sound, occluder.blocks_walking,
                               occluder.receives_shadow});
  }
  return place;
}

Result<ShowPlace> LoadPlace(const bundle::Bundle& bundle, const bundle::PlaceEntry& entry) {
  ShowPlace place;
  LARARIUM_ASSIGN_OR_RETURN(const auto scene, bundle.member(entry.scene));
  LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase map,
                            vision::ParseSceneDatabase(scene, bundle.place() + ": " + entry.scene));
  place.map = std::make_shared<const vision::SceneDatabase>(std::move(map));
  LARARIUM_ASSIGN_OR_RETURN(place.stage, LoadStage(bundle, entry));
  for (const std::string& member : entry.glossy) {
    place.glossy.emplace_back();
    if (bundle.Has(member)) {
      LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member));
      LARARIUM_ASSIGN_OR_RETURN(place.glossy.back(),
                                light::ParseGlossyMap(bytes, bundle.place() + ": " + member));
    }
  }
  return place;
}

}  // namespace

std::vector<std::shared_ptr<const vision::SceneDatabase>> Maps(std::span<const ShowPlace> places) {
  std::vector<std::shared_ptr<const vision::SceneDatabase>> maps;
  for (const ShowPlace& place : places) {
    maps.push_back(place.map);
  }
  return maps;
}

std::vector<vision::OccluderMesh> OccludersInMap(const stage::Place& place) {
  std::vector<vision::OccluderMesh> meshes;
  for (const stage::Occluder& occluder : place.occluders) {
    meshes.push_back(
        vision::Placed(occluder.mesh, place.map_from_stage * occluder.stage_from_mesh));
  }
  return meshes;
}

void SetOccluders(std::span<const ShowPlace> places, vision::PoseSource& poses) {
  for (size_t i = 0; i < places.size(); ++i) {
    poses.SetOccluders(static_cast<uint32_t>(i), OccludersInMap(places[i].stage));
  }
}

Result<std::vector<ShowPlace>> LoadShowPlaces(const bundle::Bundle& bundle,
                                              std::string_view place) {
  LARARIUM_ASSIGN_OR_RETURN(const auto entries, ChoosePlaces(bundle, place));
  std::vector<ShowPlace> places;
  for (const bundle::PlaceEntry& entry : entries) {
    LARARIUM_ASSIGN_OR_RETURN(places.emplace_back(), LoadPlace(bundle, entry));
  }
  return places;
}

CastMember MakeCastMember(human::Human human, float finest, human::TexturePool& textures) {
  CastMember person;
  textures.Share(human.textures);
  person.light = TakeLight(human.light);
  person.finest = finest;
  person.model = human::MakeAnimationRig(std::move(human));
  person.human = person.model->human;
  return person;
}

DrawnPerson MakeDrawnPerson(human::Human human, human::TexturePool& textures) {
  DrawnPerson person;
  human.clips.clear();
  textures.Share(human.textures);
  person.light = TakeLight(human.light);
  person.human = std::make_shared<const human::Human>(std::move(human));
  return person;
}

namespace {

Result<human::Human> ParseMember(const bundle::Bundle& bundle,
                                 const std::string& member,
                                 float finest = 0.0f) {
  LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member));
  return human::ParseHuman(bytes, bundle.place() + ": " + member, finest);
}

// Reads a person, of whom only the motion may have arrived.
Result<human::Human> LoadHuman(const bundle::Bundle& bundle,
                               const bundle::CastEntry& entry,
                               float finest) {
  if (entry.motion.empty()) {
    return ParseMember(bundle, entry.human, finest);
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human motion, ParseMember(bundle, entry.motion));
  if (!bundle.Has(entry.human)) {
    return motion;
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, ParseMember(bundle, entry.human, finest));
  if (human.skeleton.names != motion.skeleton.names) {
    return Status::Error(bundle.place() + ": " + entry.human,
                         "has other joints than '" + entry.motion + "'", "export the show again");
  }
  human.clips = std::move(motion.clips);
  return human;
}

}  // namespace

Result<CastMember> LoadCastMember(const bundle::Bundle& bundle,
                                  const bundle::CastEntry& entry,
                                  float finest,
                                  human::TexturePool& textures) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, LoadHuman(bundle, entry, finest));
  CastMember person = MakeCastMember(std::move(human), finest, textures);
  person.name = entry.name;
  return person;
}

namespace {

// Loads people in parallel: they are most of the content.
Status LoadCast(const bundle::Bundle& bundle,
                float finest,
                human::TexturePool& textures,
                std::vector<CastMember>& cast) {
  const std::span<const bundle::CastEntry> entries = bundle.manifest().cast;
  cast.resize(entries.size());
  std::vector<Status> loaded(entries.size());
  ParallelFor(entries.size(), [&](size_t i) {
    Result<CastMember> person = LoadCastMember(bundle, entries[i], finest, textures);
    loaded[i] = person.status();
    if (person.ok()) {
      cast[i] = *std::move(person);
    }
  });
  for (const Status& status : loaded) {
    LARARIUM_RETURN_IF_ERROR(status);
  }
  return Status();
}

// Reads a human directly from the bundle's file. The bytes, which are much larger than the result,
// are released again.
Result<human::Human> ReadHuman(const bundle::StoredMember& member, float finest) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, member.Read());
  return human::ParseHuman(bytes, member.file.string() + ": " + member.name, finest);
}

// Reads people from the bundle's file after the bundle was closed.
Result<ReadPerson> ReadsAgain(const bundle::Bundle& bundle,
                              std::shared_ptr<human::TexturePool> textures) {
  std::vector<bundle::StoredMember> members;
  for (const bundle::CastEntry& entry : bundle.manifest().cast) {
    LARARIUM_ASSIGN_OR_RETURN(members.emplace_back(), bundle.stored(entry.human));
  }
  return ReadPerson([members, textures](size_t cast, float finest) -> Result<DrawnPerson> {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, ReadHuman(members[cast], finest));
    return MakeDrawnPerson(std::move(human), *textures);
  });
}

// Objects with the same prop share its model.
}  // namespace

Result<std::vector<StageObject>> LoadObjects(const bundle::Bundle& bundle,
                                             human::TexturePool& textures) {
  std::vector<StageObject> objects;
  std::map<std::string, StageObject> known;  // Keyed by prop.
  for (const bundle::ObjectEntry& entry : bundle.manifest().objects) {
    StageObject& object = known[entry.prop];
    if (object.model == nullptr) {
      const bool waits = !entry.extent.empty() && !bundle.Has(entry.prop);
      const std::string& member = waits ? entry.extent : entry.prop;
      const std::string place = bundle.place() + ": " + member;
      LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member));
      LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, stage::ParseProp(bytes, place));
      textures.Share(prop.textures);
      LARARIUM_ASSIGN_OR_RETURN(const auto model,
                                stage::ObjectModel::Create(std::move(prop), place));
      object.light = TakeLight(model->light());
      object.model = model;
    }
    const geometry::Rigid3& pose = entry.stage_from_object;
    object.name = entry.name;
    object.stage_from_object = {geometry::ToGlm(pose.translation), geometry::ToGlm(pose.rotation)};
    objects.push_back(object);
  }
  return objects;
}

namespace {

Result<std::string> LoadText(const bundle::Bundle& bundle, const std::string& member) {
  LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member));
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

using CaptionBooks = std::map<std::string, stage::CaptionBook>;  // Keyed by spoken language.

Result<CaptionBooks> LoadCaptionBooks(const bundle::Bundle& bundle,
                                      const std::vector<bundle::SpokenLanguage>& languages) {
  CaptionBooks books;
  for (const bundle::SpokenLanguage& language : languages) {
    if (!language.captions.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string text, LoadText(bundle, language.captions));
      LARARIUM_ASSIGN_OR_RETURN(
          books[language.name],
          stage::ParseCaptions(text, bundle.place() + ": " + language.captions));
    }
  }
  return books;
}

// The language in which a line is spoken: the wanted one, or else the first of the show's languages
// that the line has.
const std::pair<const std::string, bundle::SpokenEntry>* FindSpoken(
    const std::vector<bundle::SpokenLanguage>& languages,
    const bundle::LineEntry& line,
    std::string_view wanted) {
  auto found = line.spoken.find(wanted);
  for (const bundle::SpokenLanguage& language : languages) {
    if (found != line.spoken.end()) {
      break;
    }
    found = line.spoken.find(language.name);
  }
  return found == line.spoken.end() ? nullptr : &*found;
}

// Returns nullptr if there is no such entry.
template <typename T>
const T* FindIn(const stage::CaptionBook::ById<stage::CaptionBook::ByLanguage<T>>& ids,
                std::string_view id,
                std::string_view language) {
  const auto languages = ids.find(id);
  if (languages == ids.end()) {
    return nullptr;
  }
  const auto found = languages->second.find(language);
  return found == languages->second.end() ? nullptr : &found->second;
}

// Mouth movements of the language in which a line takes longest.
Result<human::VisemeTrack> LoadLongest(const bundle::Bundle& bundle,
                                       const bundle::LineEntry& entry) {
  human::VisemeTrack longest;
  for (const auto& [language, members] : entry.spoken) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, LoadText(bundle, members.visemes));
    LARARIUM_ASSIGN_OR_RETURN(human::VisemeTrack track,
                              stage::ParseVisemes(text, bundle.place() + ": " + members.visemes));
    if (track.duration > longest.duration) {
      longest = std::move(track);
    }
  }
  return longest;
}

// said_in: the show's languages for this kind of line, speech or audio description.
Result<Speech> LoadLine(const bundle::Bundle& bundle,
                        const bundle::LineEntry& entry,
                        const std::vector<bundle::SpokenLanguage>& said_in,
                        const LanguageChoice& languages,
                        const CaptionBooks& books) {
  Speech line;
  line.name = entry.name;
  const auto* spoken = FindSpoken(said_in, entry, languages.spoken);
  if (spoken == nullptr) {
    return line;  // The line has no speech and takes no time.
  }
  const auto& [language, members] = *spoken;
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, LoadText(bundle, members.visemes));
  LARARIUM_ASSIGN_OR_RETURN(line.visemes,
                            stage::ParseVisemes(text, bundle.place() + ": " + members.visemes));
  if (languages.in_step) {
    LARARIUM_ASSIGN_OR_RETURN(line.timing, LoadLongest(bundle, entry));
  }
  if (bundle.Has(members.sound)) {
    LARARIUM_ASSIGN_OR_RETURN(const auto sound, bundle.member(members.sound));
    line.sound.assign(sound.begin(), sound.end());
  }
  const auto book = books.find(language);
  if (book != books.end()) {
    if (const auto* cues = FindIn(book->second.lines, line.name, languages.captions)) {
      line.captions = *cues;
    }
  }
  return line;
}

void NameSpeakers(const CaptionBooks& books,
                  const LanguageChoice& languages,
                  ShowContent& content) {
  for (const auto& [spoken, book] : books) {
    for (CastMember& member : content.cast) {
      if (const auto* name = FindIn(book.names, member.name, languages.captions)) {
        member.title = *name;
      }
    }
  }
}

// The first caption of a line in any book; "" if there is none.
std::string FirstCaption(const CaptionBooks& books,
                         const std::string& line,
                         std::string_view language) {
  for (const auto& [spoken, book] : books) {
    const auto* cues = FindIn(book.lines, line, language);
    if (cues != nullptr && !cues->empty()) {
      return cues->front().text;
    }
  }
  return "";
}

// Guide and farewell texts are shown even if captions are off.
void LoadGuide(const CaptionBooks& books, std::string_view language, ShowContent& content) {
  const GuideTexts known =
      BuiltInGuide(language, content.caption_font ? &*content.caption_font : nullptr);
  content.dark_guide = known.dark;
  content.farewell = FirstCaption(books, "farewell", language);
  if (content.farewell.empty()) {
    content.farewell = known.farewell;
  }
  for (ShowPlace& place : content.places) {
    place.guide = FirstCaption(books, "guide_" + place.stage.name, language);
    if (place.guide.empty()) {
      place.guide = FirstCaption(books, "guide", language);
    }
    if (place.guide.empty()) {
      place.guide = known.look;
    }
  }
}

std::vector<std::string> SpokenLanguages(const bundle::ShowManifest& manifest) {
  std::vector<std::string> spoken;
  for (const bundle::SpokenLanguage& language : manifest.spoken) {
    spoken.push_back(language.name);
  }
  return spoken;
}

// The languages of a show in place of the defaults.
struct Languages {
  LanguageChoice chosen;  // Captions are empty if there are none.
  std::string read;       // Language of the guide and of audio descriptions.

  // The languages in which a line is said.
  LanguageChoice Of(bool describes) const {
    return describes ? LanguageChoice{read, chosen.captions, chosen.in_step} : chosen;
  }
};

Result<Languages> ResolveLanguages(const bundle::ShowManifest& manifest,
                                   const LanguageChoice& choice,
                                   const std::string& where) {
  Languages languages;
  languages.chosen.in_step = choice.in_step;
  LARARIUM_ASSIGN_OR_RETURN(
      languages.chosen.spoken,
      ChooseLanguage(SpokenLanguages(manifest), choice.spoken, "speech", where));
  const bool captions_are_off = choice.captions == kNoCaptions;
  LARARIUM_ASSIGN_OR_RETURN(
      languages.read,
      ChooseLanguage(manifest.captions, captions_are_off ? choice.read : choice.captions,
                     "captions", where));
  if (!captions_are_off) {
    languages.chosen.captions = languages.read;
  }
  if (languages.read.empty()) {
    languages.read = languages.chosen.spoken;
  }
  return languages;
}

// The show's languages for this kind of line.
const std::vector<bundle::SpokenLanguage>& SaidIn(const bundle::ShowManifest& manifest,
                                                  bool describes) {
  return describes ? manifest.descriptions : manifest.spoken;
}

Status LoadLines(const bundle::Bundle& bundle, const Languages& languages, ShowContent& content) {
  const bundle::ShowManifest& manifest = bundle.manifest();
  LARARIUM_ASSIGN_OR_RETURN(const CaptionBooks books, LoadCaptionBooks(bundle, manifest.spoken));
  LARARIUM_ASSIGN_OR_RETURN(const CaptionBooks descriptions,
                            LoadCaptionBooks(bundle, manifest.descriptions));
  for (const bundle::LineEntry& entry : manifest.lines) {
    const bool describes = bundle::Describes(manifest, entry);
    LARARIUM_ASSIGN_OR_RETURN(
        Speech line, LoadLine(bundle, entry, SaidIn(manifest, describes), languages.Of(describes),
                              describes ? descriptions : books));
    line.describes = describes;
    content.has_descriptions = content.has_descriptions || describes;
    content.speech.push_back(std::move(line));
  }
  NameSpeakers(books, languages.chosen, content);
  return Status();
}

Status LoadTexts(const bundle::Bundle& bundle, const Languages& languages, ShowContent& content) {
  const bundle::ShowManifest& manifest = bundle.manifest();
  content.title = manifest.title;
  content.spoken_languages = SpokenLanguages(manifest);
  content.caption_languages = manifest.captions;
  LARARIUM_ASSIGN_OR_RETURN(const CaptionBooks books, LoadCaptionBooks(bundle, manifest.spoken));
  // The font is needed without captions too, for guide and evidence view.
  if (manifest.caption_font) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string metrics,
                              LoadText(bundle, manifest.caption_font->metrics));
    LARARIUM_ASSIGN_OR_RETURN(const auto atlas, bundle.member(manifest.caption_font->atlas));
    LARARIUM_ASSIGN_OR_RETURN(
        content.caption_font,
        render::ParseCaptionFont(metrics, atlas,
                                 bundle.place() + ": " + manifest.caption_font->metrics));
  }
  content.language = languages.read;
  LoadGuide(books, languages.read, content);
  return Status();
}

Status LoadSounds(const bundle::Bundle& bundle, std::vector<audio::SoundData>& sounds) {
  for (const bundle::SoundEntry& entry : bundle.manifest().sounds) {
    LARARIUM_ASSIGN_OR_RETURN(const auto member, bundle.member(entry.file));
    const auto bytes = std::make_shared<const std::vector<std::byte>>(member.begin(), member.end());
    sounds.push_back({entry.name, *bytes, bytes});
  }
  return Status();
}

}  // namespace

Result<std::string> ChooseLanguage(std::span<const std::string> languages,
                                   const std::string& chosen,
                                   const std::string& kind,
                                   const std::string& where) {
  if (chosen.empty()) {
    return languages.empty() ? std::string() : languages.front();
  }
  std::string known;
  for (const std::string& language : languages) {
    if (language == chosen) {
      return chosen;
    }
    known += (known.empty() ? "" : ", ") + language;
  }
  return Status::Error(where, "has no " + kind + " in the language '" + chosen + "'",
                       known.empty() ? "it has none at all" : "choose one of: " + known);
}

Result<NeededMembers> FindNeededMembers(const bundle::ShowManifest& manifest,
                                        const LanguageChoice& choice,
                                        const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Languages languages, ResolveLanguages(manifest, choice, where));
  NeededMembers needed;
  for (const bundle::PlaceEntry& place : manifest.places) {
    needed.guide.push_back(place.scene);
    for (const bundle::OccluderEntry& occluder : place.occluders) {
      needed.guide.push_back(occluder.mesh);
    }
    needed.rest.insert(needed.rest.end(), place.glossy.begin(), place.glossy.end());
  }
  for (const bundle::SpokenLanguage& language : manifest.spoken) {
    needed.language.push_back(language.captions);
  }
  if (manifest.caption_font) {
    needed.language.push_back(manifest.caption_font->metrics);
    needed.language.push_back(manifest.caption_font->atlas);
  }
  // Captions of all languages are in one file, and tell the guide's texts.
  needed.guide.insert(needed.guide.end(), needed.language.begin(), needed.language.end());
  for (const bundle::SpokenLanguage& language : manifest.descriptions) {
    needed.language.push_back(language.captions);
  }
  for (const bundle::LineEntry& line : manifest.lines) {
    const bool describes = bundle::Describes(manifest, line);
    if (const auto* spoken =
            FindSpoken(SaidIn(manifest, describes), line, languages.Of(describes).spoken)) {
      needed.language.push_back(spoken->second.visemes);
      needed.voices.push_back(spoken->second.sound);
      for (const auto& [language, members] : line.spoken) {
        needed.language.push_back(choice.in_step ? members.visemes : "");
      }
    }
  }
  for (const bundle::SoundEntry& sound : manifest.sounds) {
    needed.language.push_back(sound.file);
  }
  needed.rest.insert(needed.rest.begin(), {manifest.drama, manifest.paradata});
  for (const bundle::CastEntry& cast : manifest.cast) {
    needed.rest.push_back(cast.motion.empty() ? cast.human : cast.motion);
    needed.people.push_back(cast.motion.empty() ? "" : cast.human);
  }
  for (const bundle::ObjectEntry& object : manifest.objects) {
    needed.rest.push_back(object.extent.empty() ? object.prop : object.extent);
    needed.things.push_back(object.extent.empty() ? "" : object.prop);
  }
  for (std::vector<std::string>* list : {&needed.guide, &needed.language, &needed.voices,
                                         &needed.rest, &needed.people, &needed.things}) {
    std::set<std::string> known = {""};
    std::erase_if(*list, [&known](const std::string& name) { return !known.insert(name).second; });
  }
  return needed;
}

Result<ShowContent> LoadGuideContent(const bundle::Bundle& bundle, const LanguageChoice& choice) {
  ShowContent content;
  LARARIUM_ASSIGN_OR_RETURN(content.places, LoadShowPlaces(bundle, {}));
  LARARIUM_ASSIGN_OR_RETURN(const Languages languages,
                            ResolveLanguages(bundle.manifest(), choice, bundle.place()));
  LARARIUM_RETURN_IF_ERROR(LoadTexts(bundle, languages, content));
  content.drama_file = bundle.manifest().drama;
  return content;
}

Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle,
                                    std::string_view place,
                                    const LanguageChoice& choice,
                                    float finest) {
  const bundle::ShowManifest& manifest = bundle.manifest();
  ShowContent content;
  LARARIUM_ASSIGN_OR_RETURN(content.places, LoadShowPlaces(bundle, place));
  for (const bundle::PlaceEntry& entry : manifest.places) {
    if (!place.empty() && entry.name != place) {
      LARARIUM_ASSIGN_OR_RETURN(content.elsewhere.emplace_back(), LoadStage(bundle, entry));
    }
  }

  const auto textures = std::make_shared<human::TexturePool>();
  LARARIUM_RETURN_IF_ERROR(LoadCast(bundle, finest, *textures, content.cast));
  if (finest > 0.0f) {
    LARARIUM_ASSIGN_OR_RETURN(content.finer, ReadsAgain(bundle, textures));
  }
  LARARIUM_ASSIGN_OR_RETURN(content.objects, LoadObjects(bundle, *textures));
  LARARIUM_ASSIGN_OR_RETURN(const Languages languages,
                            ResolveLanguages(manifest, choice, bundle.place()));
  LARARIUM_RETURN_IF_ERROR(LoadTexts(bundle, languages, content));
  LARARIUM_RETURN_IF_ERROR(LoadLines(bundle, languages, content));
  LARARIUM_RETURN_IF_ERROR(LoadSounds(bundle, content.sounds));
  LARARIUM_ASSIGN_OR_RETURN(content.drama, LoadText(bundle, manifest.drama));
  content.drama_file = manifest.drama;
  if (!manifest.paradata.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, LoadText(bundle, manifest.paradata));
    LARARIUM_ASSIGN_OR_RETURN(
        content.paradata, stage::ParseParadata(text, bundle.place() + ": " + manifest.paradata));
  }
  return content;
}

Result<ShowContent> LoadInLanguages(const bundle::Bundle& bundle,
                                    const LanguageChoice& choice,
                                    const ShowContent& content) {
  LARARIUM_ASSIGN_OR_RETURN(const Languages languages,
                            ResolveLanguages(bundle.manifest(), choice, bundle.place()));
  ShowContent other = content;
  other.speech.clear();
  other.sounds.clear();
  other.has_descriptions = false;
  for (CastMember& member : other.cast) {
    member.title.clear();
  }
  LARARIUM_RETURN_IF_ERROR(LoadTexts(bundle, languages, other));
  LARARIUM_RETURN_IF_ERROR(LoadLines(bundle, languages, other));
  LARARIUM_RETURN_IF_ERROR(LoadSounds(bundle, other.sounds));
  return other;
}

}  // namespace lararium::show
