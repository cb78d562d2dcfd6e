#pragma once

// The design of a garment: the content of scenes/library/garments/NAME/garment.json. Every number
// may be a formula of the measures of a body, of the values that a recipe sets, and of the sizes
// that the file names. docs/how-to-make-a-garment.md describes each field.

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/formula.h"
#include "editor/import/wardrobe/weave.h"
#include "shared/core/status.h"
#include "shared/stage/paradata.h"

namespace lararium::import {

// Something that a recipe may set.
struct GarmentParameter {
  enum class Type : uint8_t { kNumber, kFlag, kColour };
  struct Word {
    std::string word;
    float value = 0.0f;
  };

  std::string name;
  std::string label;  // English text for the window, which shows only parameters that have one.
  Type type = Type::kNumber;
  std::vector<Word> words;  // Words for numbers.
  bool has_range = false;   // Numbers are accepted too.
  float from = 0.0f;
  float to = 1.0f;
  float usual = 0.0f;      // A flag is 0 or 1.
  glm::vec3 colour{0.0f};  // Usual colour, linear RGB.
};

// How a piece lies on the body.
enum class Placement : uint8_t {
  kFront,   // Hangs from the shoulders before the body. Its upper edge rests on the shoulder line,
  kBack,    // along which "across" is measured from the middle of the body. kBack: behind it.
  kAround,  // Gathered around the body at one height, from where its folds hang down.
  kMantle,  // Wrapped around the body and over the left shoulder (mantle.h).
  kFoot,    // A sole and straps, for both feet (sandals.h).
};

// The part of the body that cloth placed around it lies about.
enum class About : uint8_t {
  kTrunk,
  kLegs,  // A tube about each of both legs.
  kArms,  // A tube about each of both arms.
};

// A piece of cloth. A placement has only some of the fields; the formulas of others are empty.
struct Piece {
  struct Width {
    Formula down;  // Metres below the upper edge.
    Formula half;  // Half of the width there, metres.
  };
  struct Knot {
    Formula at;      // Angle about the body, degrees.
    Formula height;  // Metres above the floor.
  };

  std::string name;
  Placement placed = Placement::kFront;
  About about = About::kTrunk;
  Formula hem;                // Metres above the floor.
  std::vector<Width> widths;  // Distances increase, and smooth steps lie between them.
  Formula neck;               // Half of the width of the neckline.
  Formula neck_depth;
  Formula top;   // Metres above the floor.
  Formula from;  // Angles about the body, degrees: 0 is behind, 90 right, 180 in front.
  Formula to;
  Formula corners;         // Metres by which the ends hang lower than the middle.
  Formula fullness;        // Width of the cloth over that of the body below it.
  Formula folds;           // Folds in a full turn of the body.
  Formula ease;            // Metres between body and cloth, at the top.
  Formula ease_hem;        // Metres between body and cloth, at the hem.
  std::vector<Knot> path;  // The upper edge of a mantle, with smooth steps between knots.
  Formula sinus;  // The upper part of a mantle is folded over and hangs in a bow, unless this is 0.
};

// Sews two pieces together along an edge of both.
struct Seam {
  enum class Edge : uint8_t { kLeftTop, kRightTop, kLeftSide, kRightSide };
  struct Part {
    Formula from;  // Share of the seam, 0..1.
    Formula to;
  };

  std::string name;
  std::vector<std::string> pieces;  // Two names.
  Edge edge = Edge::kLeftTop;
  Formula when;             // The seam is not sewn where it is 0.
  Formula from;             // Metres from the middle of the body, or below the upper edge.
  std::vector<Part> parts;  // Empty: the whole seam. Otherwise it gapes between these parts.
};

// A belt or cord.
struct GirdleDesign {
  Formula when;    // Zero means no girdle.
  Formula height;  // Metres above the floor.
  Formula width;
  Formula round;       // A cord where it is not 0, otherwise a flat belt.
  Formula lift;        // Metres of cloth pulled up over it.
  std::string colour;  // A parameter.
  float shade = 1.0f;  // Factor of that colour.
};

// Bands of another colour that are woven in.
struct BandDesign {
  std::string colour;  // A parameter.
  Formula stripe_at;   // Metres across from the middle to the middle of a stripe on each side.
  Formula stripe_width;
  Formula border;            // Zero means no band along the hem.
  float border_from = 1.0f;  // Rows of threads above the hem.
  float border_to = 4.0f;
};

struct FabricDesign {
  Weave weave = Weave::kWool;
  DrapeMaterial material;
  std::string colour;          // A parameter.
  Formula soil;                // Darkening of the hem, 0..1.
  float soil_height = 0.2f;    // Metres above the hem that are soiled.
  float fold_width = 0.13f;    // Width of one laid fold, metres around the body.
  float deepest_fold = 0.05f;  // Metres, half of the distance from trough to crest.
};

struct GarmentDesign {
  std::filesystem::path file;
  std::string name;  // Name of the folder.
  std::string title;
  std::string about;
  stage::Certainty certainty = stage::Certainty::kUnsaid;
  std::vector<std::string> sources;
  std::string author;
  std::string licence;
  std::vector<GarmentParameter> parameters;
  std::vector<std::string> ignored;  // Fields of recipes without effect.
  std::map<std::string, Formula, std::less<>> sizes;
  FabricDesign fabric;
  Formula follows_arms;  // The cloth does not move with the arms where it is 0.
  std::vector<Piece> pieces;
  std::vector<Seam> seams;
  std::optional<GirdleDesign> girdle;
  std::optional<BandDesign> bands;

  const GarmentParameter* Find(std::string_view parameter) const;
  // The first piece that lies like this, or null.
  const Piece* Find(Placement placement) const;
};

// The folder of the garments that come with the editor.
std::filesystem::path GarmentLibrary();

// The names of the garments in a library, sorted.
std::vector<std::string> GarmentNames(const std::filesystem::path& library = GarmentLibrary());

// The file of the garment of this name, which need not exist.
std::filesystem::path GarmentFile(std::string_view name,
                                  const std::filesystem::path& library = GarmentLibrary());

// Errors name the file, the piece or seam, and the field.
Result<GarmentDesign> ParseGarment(std::string_view text, const std::filesystem::path& file);
Result<GarmentDesign> ReadGarment(const std::filesystem::path& file);
// Reads the file of a garment of a library.
Result<GarmentDesign> LoadGarment(std::string_view name,
                                  const std::filesystem::path& library = GarmentLibrary());

}  // namespace lararium::import
