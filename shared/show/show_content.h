#pragma once

// All that one show needs at its places, ready to run.

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
#include "shared/human/face.h"
#include "shared/human/human.h"
#include "shared/human/performance.h"
#include "shared/human/texture_pool.h"
#include "shared/light/glossy_map.h"
#include "shared/render/caption_font.h"
#include "shared/show/person_light.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/object_use.h"
#include "shared/stage/paradata.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

struct CastMember {
  std::string name;  // as the drama calls the actor
  std::shared_ptr<const human::Human> human;
  std::string title = {};  // as captions call the actor; empty: they do not
  // What was taken out of the human's light; nullptr: it has all of it.
  std::shared_ptr<const UnpackedLight> light = nullptr;
  // In what detail the human was read (human::ParseHuman).
  float finest = 0.0f;
  // What moves the human, where it is known already; nullptr: it is made of the human.
  std::shared_ptr<const human::PerformanceModel> model = nullptr;
};

// The member, still without a name, who is such a human, read in that detail.
CastMember MakeCastMember(human::Human human, float finest, human::TexturePool& textures);

// Somebody as they are drawn, whatever moves them.
struct DrawnPerson {
  std::shared_ptr<const human::Human> human;   // without clips
  std::shared_ptr<const UnpackedLight> light;  // as CastMember's
};
DrawnPerson MakeDrawnPerson(human::Human human, human::TexturePool& textures);

// Reads one of the cast again, in other detail. From any thread.
using ReadPerson = std::function<Result<DrawnPerson>(size_t cast, float finest)>;

// A thing that people use, or scenery.
struct StageObject {
  std::string name;  // as the drama calls it
  std::shared_ptr<const stage::ObjectModel> model;
  stage::Pose stage_from_object;  // at the beginning
  // What was taken out of the prop's light; nullptr: it has all of it.
  std::shared_ptr<const UnpackedLight> light = nullptr;
};

// A line that somebody can say, as it is said and to be read in the languages of a show.
// Its index is that of stage::Utterance::line.
struct Speech {
  std::string name;  // its id, as the drama calls it
  human::VisemeTrack visemes;
  // FLAC or Ogg; empty: nothing is heard. It begins with the visemes.
  std::vector<std::byte> sound = {};
  std::vector<stage::CaptionCue> captions = {};  // empty: nothing is to be read
  // To visitors who do not see well, in the language that others read.
  bool describes = false;
};

// What a show is to be heard and read in; empty: as its author chose. No captions: "off".
struct LanguageChoice {
  std::string spoken;
  std::string captions;

  friend bool operator==(const LanguageChoice&, const LanguageChoice&) = default;
};
inline constexpr std::string_view kNoCaptions = "off";

// The one of the languages that there are that is meant by a choice; the first where
// nothing was chosen, "" where there is none. kind: "speech" or "captions", for the error.
Result<std::string> ChooseLanguage(std::span<const std::string> languages,
                                   const std::string& chosen,
                                   const std::string& kind,
                                   const std::string& place);

// A trained place and how the drama is staged there.
struct ShowPlace {
  stage::Place stage;
  std::shared_ptr<const vision::SceneDatabase> map;
  // What rough surfaces mirror of each of the stage's probes; may be empty.
  std::vector<light::GlossyMap> glossy = {};
  std::string guide = {};  // says where to look when tracking is lost; may be empty
};

struct ShowContent {
  std::string title;
  std::vector<ShowPlace> places;  // at least one
  // Further places of the drama that this show is not at: what is in the way there is in the way
  // here too, so that the drama is the same everywhere. Only their occluders count.
  std::vector<stage::Place> elsewhere = {};
  std::vector<CastMember> cast;
  ReadPerson finer = {};  // empty: there is no more detail to be had
  std::vector<StageObject> objects;
  std::vector<Speech> speech;
  std::vector<std::string> spoken_languages;   // that it could be heard in
  std::vector<std::string> caption_languages;  // likewise read
  bool has_descriptions = false;               // for visitors who do not see well
  std::optional<render::CaptionFont> caption_font;
  std::string dark_guide;                // what is said instead where the camera sees nothing
  std::string farewell;                  // what is said when the visit is over
  std::vector<audio::SoundData> sounds;  // that things, places and the drama make
  stage::Paradata paradata;              // what is known of all that
  std::string language;                  // what is to be read is in it
  std::string drama;                     // Lua source
  std::string drama_file;                // what messages call it
};

// What the tracker is created with: TrackedFrame::map is then an index into places.
std::vector<std::shared_ptr<const vision::SceneDatabase>> Maps(std::span<const ShowPlace> places);

// The occluders of a place as its map has them, which hide the map's points.
std::vector<vision::OccluderMesh> OccludersInMap(const stage::Place& place);

// Tells a tracker with the maps of the places about their occluders.
void SetOccluders(std::span<const ShowPlace> places, vision::PoseSource& poses);

// The bundle's places, or only the named one. Every member is checked by its own reader.
Result<std::vector<ShowPlace>> LoadShowPlaces(const bundle::Bundle& bundle,
                                              std::string_view place = {});

// The content of a bundle at all of its places, or only at the named one. Every
// member is checked by its own reader. A line that lacks the chosen language is in the
// show's first. finest: as human::ParseHuman takes it, of the cast; finer detail is had from the
// bundle's file then.
Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle,
                                    std::string_view place = {},
                                    const LanguageChoice& languages = {},
                                    float finest = 0.0f);

}  // namespace lararium::show
