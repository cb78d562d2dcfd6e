#pragma once

// manifest.json of a bundle: the parts of the show and the members that contain them.

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/sha256.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/light/camera_traits.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/acoustics.h"

namespace lararium::bundle {

// A file of a bundle; every file except the manifest itself has an entry.
struct Member {
  std::string name;
  uint64_t size = 0;
  Sha256 sha256 = {};
  // Size of the member's file in a folder for browsers, compressed with gzip. Zero: it is stored as
  // it is.
  uint64_t packed = 0;
};

struct OccluderEntry {
  std::string name;
  std::string mesh;  // member, .larmesh
  geometry::Similarity3 stage_from_mesh;
  // The following three fields are those of stage::Occluder.
  bool blocks_sound = true;
  bool blocks_walking = true;
  bool receives_shadow = true;
};

struct PlaceEntry {
  std::string name;
  std::string scene;  // member, .larscene
  geometry::Similarity3 map_from_stage;
  Eigen::Vector3d camera_nudge = Eigen::Vector3d::Zero();  // metres along camera axes
  std::vector<OccluderEntry> occluders;
  std::vector<light::PlacedProbe> probes;                    // light in stage axes
  std::optional<light::CameraTraits> camera = std::nullopt;  // Not set: not measured.
  std::vector<std::string> glossy = {};  // Member for each probe, .gloss; empty: none.
  stage::Acoustics acoustics = {};
};

struct CastEntry {
  std::string name;
  std::string human;  // member, .larhuman
  // Member, .larhuman: the person without meshes, with which the drama plays until `human` has
  // arrived, and the clips, which `human` lacks then. Empty: `human` has all.
  std::string motion = {};
};

// An object on stage at the beginning of the drama.
struct ObjectEntry {
  std::string name;
  std::string prop;  // member, .larprop
  geometry::Rigid3 stage_from_object;
  // Member, .larprop: the same without what is drawn, with which the drama plays until `prop` has
  // arrived. Empty: the drama needs `prop`.
  std::string extent = {};
};

// A line as it is spoken in one language.
struct SpokenEntry {
  std::string visemes;  // member, JSON: stage::ParseVisemes
  std::string sound;    // member, FLAC or Ogg; empty: no sound
};

// A line that a character can say.
struct LineEntry {
  // Speaker of the audio description for visitors who do not see well, unless a member of the cast
  // has this name. Descriptions are spoken in the languages of captions.
  static constexpr char kDescription[] = "description";

  std::string name;     // id of the line
  std::string speaker;  // Name in the cast, whose voice is used; may be empty.
  std::map<std::string, SpokenEntry, std::less<>> spoken;  // key: language tag
};

// A language in which lines are spoken.
struct SpokenLanguage {
  std::string name;      // "la"
  std::string captions;  // member, JSON: stage::ParseCaptions; empty: none
};

// The font of captions.
struct CaptionFontEntry {
  std::string metrics;  // member, JSON: render::ParseCaptionFont
  std::string atlas;    // member, PNG
};

// A sound of an object, of a place or of the drama.
struct SoundEntry {
  std::string name;
  std::string file;  // member: WAV, FLAC or Ogg
};

// The fleet of a museum, which a page in a browser joins.
struct FleetEntry {
  std::string address;   // "wss://HOST[:PORT]/SITE"
  std::string group;     // Group that plays one drama; empty: none.
  std::string password;  // The account "visitors" has it. Every visitor can read it.
};

// Errors call the entry `where`.
Status CheckFleet(const FleetEntry& fleet, const std::string& where);

struct ShowManifest {
  static constexpr int kSchema = 2;

  std::string title;
  std::string credits;
  std::string drama;                   // member, Lua source
  std::vector<PlaceEntry> places;      // not empty; names are unique
  std::vector<CastEntry> cast;         // names are unique
  std::vector<ObjectEntry> objects;    // Names are unique.
  std::vector<LineEntry> lines;        // Names are unique.
  std::vector<SpokenLanguage> spoken;  // The first is used unless another is requested.
  // Languages of captions; the first is used unless another is requested.
  std::vector<std::string> captions;
  std::vector<SpokenLanguage> descriptions;  // Languages of audio descriptions; may be empty.
  std::optional<CaptionFontEntry> caption_font;
  std::vector<SoundEntry> sounds;   // names are unique
  std::string paradata;             // member, JSON: stage::ParseParadata; empty: none
  std::vector<Member> members;      // same order as in the file
  std::vector<Member> page;         // Files of the page, in folders for browsers; otherwise empty.
  std::optional<FleetEntry> fleet;  // The fleet of a folder for browsers.
};

// True if a line of the manifest is an audio description for visitors who do not see well.
bool Describes(const ShowManifest& manifest, const LineEntry& line);

// Checks every field, that names are unique, and that every member that an entry names is listed.
// Errors call the text `where`.
Result<ShowManifest> ParseShowManifest(std::string_view text, const std::string& where);
std::string FormatShowManifest(const ShowManifest& manifest);

// Twelve hexadecimal digits that are others whenever anything in the show is.
std::string ShowVersion(const ShowManifest& manifest);
// Twelve hexadecimal digits that are the same for a bundle and a folder for browsers of one drama:
// those of the script, of the times of lines, of names, and of what people walk around.
std::string DramaVersion(ShowManifest manifest);

}  // namespace lararium::bundle
