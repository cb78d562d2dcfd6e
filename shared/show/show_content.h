#pragma once

// All data that one show needs at its places, loaded and ready to run.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/bundle/bundle.h"
#include "shared/core/status.h"
#include "shared/human/animator.h"
#include "shared/human/face.h"
#include "shared/human/human.h"
#include "shared/human/texture_pool.h"
#include "shared/light/glossy_map.h"
#include "shared/render/text/caption_font.h"
#include "shared/show/person_light.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/object_use.h"
#include "shared/stage/paradata.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

struct CastMember {
  std::string name;  // The actor's name in the drama.
  std::shared_ptr<const human::Human> human;
  std::string title = {};  // The speaker's name in captions; empty: captions do not name the actor.
  // Transfer vectors that TakeLight() moved out of the human; nullptr: they are still inside the
  // human.
  std::shared_ptr<const UnpackedLight> light = nullptr;
  // Detail at which the human was read, in metres (parameter `finest` of human::ParseHuman).
  float finest = 0.0f;
  // The human's animation rig; nullptr: the stage builds it from `human`.
  std::shared_ptr<const human::AnimationRig> model = nullptr;
};

// Makes a member, without a name yet, from a human that was read at the detail `finest`.
CastMember MakeCastMember(human::Human human, float finest, human::TexturePool& textures);

// A person as drawn, independent of what animates it.
struct DrawnPerson {
  std::shared_ptr<const human::Human> human;   // Has no clips.
  std::shared_ptr<const UnpackedLight> light;  // See CastMember::light.
};
DrawnPerson MakeDrawnPerson(human::Human human, human::TexturePool& textures);

// Reads a member of the cast again at another detail (metres, as in human::ParseHuman). Callable
// from any thread.
using ReadPerson = std::function<Result<DrawnPerson>(size_t cast, float finest)>;

// A prop that people use, or scenery.
struct StageObject {
  std::string name;  // The object's name in the drama.
  std::shared_ptr<const stage::ObjectModel> model;
  stage::Pose stage_from_object;  // Pose at the beginning of the drama.
  // Transfer vectors that TakeLight() moved out of the prop; nullptr: they are still inside the
  // prop.
  std::shared_ptr<const UnpackedLight> light = nullptr;
};

// A line that an actor can say: its sound, visemes and captions in the chosen languages. Its index
// in ShowContent::speech is stage::Utterance::line.
struct Speech {
  std::string name;  // The line's id in the drama.
  human::VisemeTrack visemes;
  // The time that the line takes, if it is not that of `visemes`: LanguageChoice::in_step.
  std::optional<human::VisemeTrack> timing = {};
  // FLAC or Ogg, starting together with the visemes; empty: the line is silent.
  std::vector<std::byte> sound = {};
  std::vector<stage::CaptionCue> captions = {};  // Empty: the line has no captions.
  // Audio description for visitors with impaired vision. Its language is that of the captions.
  bool describes = false;
};

// Languages of speech and captions. Empty: the author's default. kNoCaptions in `captions` turns
// captions off.
struct LanguageChoice {
  std::string spoken;
  std::string captions;
  // A line takes the time of its longest language, so that shows in several languages stay
  // together.
  bool in_step = false;
  // The language of the guide and of audio descriptions while captions are off. While they are on,
  // both are in the captions' language.
  std::string read = {};

  friend bool operator==(const LanguageChoice&, const LanguageChoice&) = default;
};
inline constexpr std::string_view kNoCaptions = "off";

// Returns `chosen` if `languages` contains it, and an error otherwise. If `chosen` is empty,
// returns the first language, or "" if there is none. kind: "speech" or "captions", for the error.
// where: where the error happened.
Result<std::string> ChooseLanguage(std::span<const std::string> languages,
                                   const std::string& chosen,
                                   const std::string& kind,
                                   const std::string& where);

// A trained place and how the drama is staged there.
struct ShowPlace {
  stage::Place stage;
  std::shared_ptr<const vision::SceneDatabase> map;
  // Prefiltered reflections for rough surfaces, one map per probe of the stage; may be empty.
  std::vector<light::GlossyMap> glossy = {};
  std::string guide = {};  // Text that tells where to look when tracking is lost; may be empty.
};

struct ShowContent {
  std::string title;
  std::vector<ShowPlace> places;  // Has at least one place.
  // Places of the drama at which this show does not run. Their occluders block walking here too, so
  // that the drama is the same at all places; nothing else of them is used.
  std::vector<stage::Place> elsewhere = {};
  std::vector<CastMember> cast;
  ReadPerson finer = {};  // Reads finer levels of detail; empty: the cast is already complete.
  std::vector<StageObject> objects;
  std::vector<Speech> speech;
  std::vector<std::string> spoken_languages;   // Languages of speech that the show offers.
  std::vector<std::string> caption_languages;  // Languages of captions that the show offers.
  bool has_descriptions = false;               // True if any line is an audio description.
  std::optional<render::CaptionFont> caption_font;
  std::string dark_guide;  // Guide text for an image that is too dark.
  std::string farewell;    // Text shown at the end of a visit.
  // Sounds of objects, places and the drama; speech is in `speech`.
  std::vector<audio::SoundData> sounds;
  stage::Paradata paradata;  // Evidence for each person and object.
  std::string language;      // Language of all texts.
  std::string drama;         // Lua source
  std::string drama_file;    // File name of the drama in error messages.
};

// The places' maps for the tracker. TrackedFrame::map is then an index into `places`.
std::vector<std::shared_ptr<const vision::SceneDatabase>> Maps(std::span<const ShowPlace> places);

// The occluders of a place in the map's frame; they hide map points from the tracker.
std::vector<vision::OccluderMesh> OccludersInMap(const stage::Place& place);

// Passes the places' occluders to a tracker that was created with Maps().
void SetOccluders(std::span<const ShowPlace> places, vision::PoseSource& poses);

// The members that a show needs in these languages, the most important first. Where members arrive
// one by one, LoadShowContent() reads all of them but `voices`, `people` and `things`, and of these
// what has arrived.
struct NeededMembers {
  std::vector<std::string> guide;  // LoadGuideContent() reads these.
  // LoadInLanguages() reads these, and `voices`.
  std::vector<std::string> language;
  std::vector<std::string>
      voices;  // Sounds of lines. Lines without one take their time in silence.
  std::vector<std::string> rest;
  // What the drama does without at first: CastEntry::human where there is a `motion`, and
  // ObjectEntry::prop where there is an `extent`.
  std::vector<std::string> people;
  std::vector<std::string> things;
};
Result<NeededMembers> FindNeededMembers(const bundle::ShowManifest& manifest,
                                        const LanguageChoice& languages,
                                        const std::string& where);

// Loads all places of the bundle, or only the named one. Each member's reader validates it.
// Reflections may arrive later.
Result<std::vector<ShowPlace>> LoadShowPlaces(const bundle::Bundle& bundle,
                                              std::string_view place = {});

// Loads a member of the cast, without its title. A person of whom only the motion has arrived is
// not drawn. finest: see LoadShowContent().
Result<CastMember> LoadCastMember(const bundle::Bundle& bundle,
                                  const bundle::CastEntry& entry,
                                  float finest,
                                  human::TexturePool& textures);

// Loads the objects. Those of which only the extent has arrived are not drawn.
Result<std::vector<StageObject>> LoadObjects(const bundle::Bundle& bundle,
                                             human::TexturePool& textures);

// Loads a show without people, objects and drama, which only guides visitors to its places.
Result<ShowContent> LoadGuideContent(const bundle::Bundle& bundle,
                                     const LanguageChoice& languages = {});

// Loads a show from a bundle at all of its places, or only at the named one. Each member's reader
// validates it. A line without the chosen language uses the show's first language that it has.
// finest: detail of the cast in metres, as in human::ParseHuman; if positive, ShowContent::finer
// reads more detail from the bundle's file.
Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle,
                                    std::string_view place = {},
                                    const LanguageChoice& languages = {},
                                    float finest = 0.0f);

// Returns the show in other languages, whose people, places and objects are those of `content`.
// Reads lines, texts and sounds only. content: may have given its sounds away (Show::content()).
Result<ShowContent> LoadInLanguages(const bundle::Bundle& bundle,
                                    const LanguageChoice& languages,
                                    const ShowContent& content);

}  // namespace lararium::show
