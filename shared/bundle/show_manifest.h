#pragma once

// manifest.json of a bundle: what the show consists of, and which members hold it.

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

// Every file of a bundle but the manifest itself.
struct Member {
  std::string name;
  uint64_t size = 0;
  Sha256 sha256 = {};
};

struct OccluderEntry {
  std::string name;
  std::string mesh;  // member, .larmesh
  geometry::Similarity3 stage_from_mesh;
  bool blocks_sound = true;  // these three as of stage::Occluder; a bundle may lack the fields
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
  std::optional<light::CameraTraits> camera = std::nullopt;  // a bundle may lack the field
  std::vector<std::string> glossy = {};  // of each probe: member, .gloss; empty: none
  stage::Acoustics acoustics = {};
};

struct CastEntry {
  std::string name;
  std::string human;  // member, .larhuman
};

// A thing on stage at the drama's beginning.
struct ObjectEntry {
  std::string name;
  std::string prop;  // member, .larprop
  geometry::Rigid3 stage_from_object;
};

// A line as it is said in one language.
struct SpokenEntry {
  std::string visemes;  // member, JSON: stage::ParseVisemes
  std::string sound;    // member, FLAC or Ogg; empty: nothing is heard
};

// What somebody can say.
struct LineEntry {
  // The speaker of what is described to visitors who do not see well, unless one of the cast is
  // called so. It is heard in languages of captions.
  static constexpr char kDescription[] = "description";

  std::string name;     // its id
  std::string speaker;  // of the cast, whose voice it has; may be empty
  std::map<std::string, SpokenEntry, std::less<>> spoken;  // by language
};

// A language that lines are said in.
struct SpokenLanguage {
  std::string name;      // "la"
  std::string captions;  // member, JSON: stage::ParseCaptions; empty: it has none
};

// What a caption is drawn with.
struct CaptionFontEntry {
  std::string metrics;  // member, JSON: render::ParseCaptionFont
  std::string atlas;    // member, PNG
};

// A sound that things, places or the drama make.
struct SoundEntry {
  std::string name;
  std::string file;  // member: WAV, FLAC or Ogg
};

struct ShowManifest {
  // 1: a place has one light, without position and time of day.
  static constexpr int kSchema = 2;

  std::string title;
  std::string credits;
  std::string drama;                         // member, Lua source
  std::vector<PlaceEntry> places;            // at least one; names are unique
  std::vector<CastEntry> cast;               // names are unique
  std::vector<ObjectEntry> objects;          // likewise; a bundle may lack the field
  std::vector<LineEntry> lines;              // likewise
  std::vector<SpokenLanguage> spoken;        // the first unless another is asked for
  std::vector<std::string> captions;         // languages of captions, likewise
  std::vector<SpokenLanguage> descriptions;  // languages of what is described; may be empty
  std::optional<CaptionFontEntry> caption_font;
  std::vector<SoundEntry> sounds;  // names are unique
  std::string paradata;            // member, JSON: stage::ParseParadata; empty: it has none
  std::vector<Member> members;     // in their order in the file
};

// Whether a line of the manifest is described to visitors who do not see well.
bool Describes(const ShowManifest& manifest, const LineEntry& line);

// Checks every field, that names are unique, and that each member which an
// entry names is listed. place: what errors call the text.
Result<ShowManifest> ParseShowManifest(std::string_view text, const std::string& place);
std::string FormatShowManifest(const ShowManifest& manifest);

}  // namespace lararium::bundle
