#include "editor/import/wardrobe/garment_design.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "editor/import/objects/object_library.h"
#include "editor/import/wardrobe/dye.h"
#include "editor/import/wardrobe/measures.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/program.h"

namespace lararium::import {
namespace {

constexpr int kGarmentSchema = 1;
constexpr uint64_t kMaxFile = 1 << 20;  // Bytes.
constexpr size_t kMaxText = 2000;
constexpr std::array<std::string_view, 5> kPlacements = {"front", "back", "around", "mantle",
                                                         "foot"};
constexpr std::array<std::string_view, 3> kAbouts = {"trunk", "legs", "arms"};
constexpr std::array<std::string_view, 4> kEdges = {"left top", "right top", "left side",
                                                    "right side"};
constexpr std::array<std::string_view, 3> kWeaves = {"wool", "linen", "leather"};
constexpr std::array<std::string_view, 3> kCertainties = {"attested", "inferred", "imagined"};

// A name in formulas and recipes.
bool IsName(std::string_view name) {
  return !name.empty() && name.size() <= 40 && name[0] >= 'a' && name[0] <= 'z' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

// Reads one file. Keeps where each formula is, because names are checked last.
class DesignReader {
 public:
  explicit DesignReader(GarmentDesign& design) : design_(design) {}

  void Describe(Fields& fields) {
    fields.Schema(kGarmentSchema);
    fields.Text("title", design_.title, 100);
    fields.Text("about", design_.about, kMaxText);
    DescribeParadata(fields);
    fields.List(
        Optional("parameters"), design_.parameters, 40,
        [this](Fields& object, GarmentParameter& parameter) { DescribeOne(object, parameter); });
    fields.List(Optional("ignores"), design_.ignored, 40,
                [&](const FieldKey& key, std::string& name) { fields.Text(key, name, 40); });
    fields.Entries(Optional("sizes"), design_.sizes, 60, "must be an object of at most 60 sizes",
                   [&](const FieldKey& key, Formula& size) {
                     fields.RequireAt(key, IsName(key.name), kNameProblem);
                     DescribeFormula(fields, key, size);
                   });
    fields.Object("fabric", design_.fabric,
                  [this](Fields& object, FabricDesign& fabric) { DescribeOne(object, fabric); });
    DescribeFormula(fields, Optional("follows_arms"), design_.follows_arms);
    fields.List("pieces", design_.pieces, 16,
                [this](Fields& object, Piece& piece) { DescribeOne(object, piece); });
    fields.List(Optional("seams"), design_.seams, 40,
                [this](Fields& object, Seam& seam) { DescribeOne(object, seam); });
    fields.Object(Optional("girdle"), design_.girdle,
                  [this](Fields& object, GirdleDesign& girdle) { DescribeOne(object, girdle); });
    fields.Object(Optional("bands"), design_.bands,
                  [this](Fields& object, BandDesign& bands) { DescribeOne(object, bands); });
    CheckPieces(fields);
    CheckNames(fields);
  }

 private:
  static constexpr const char* kNameProblem =
      "is no name; write at most 40 lower-case letters, digits and \"_\"";

  void DescribeParadata(Fields& fields) {
    size_t certainty = 0;
    fields.Choice("certainty", certainty, kCertainties, "\"certainty\" is '{}'",
                  "write attested, inferred or imagined");
    design_.certainty = static_cast<stage::Certainty>(certainty + 1);
    fields.List(Optional("sources"), design_.sources, 20,
                [&](const FieldKey& key, std::string& source) { fields.Text(key, source, 500); });
    fields.Text(Optional("author"), design_.author, 200);
    fields.Text(Optional("licence"), design_.licence, 200);
  }

  void DescribeFormula(Fields& fields, const FieldKey& key, Formula& formula) {
    if (!key.required && !fields.Has(key.name)) {
      return;
    }
    if (fields.IsText(key)) {
      std::string text;
      fields.Text(key, text);
      Result<Formula> parsed = Formula::Parse(text, Where(fields, key));
      fields.Check(parsed.ok() ? Status() : parsed.status());
      formula = parsed.ok() ? *std::move(parsed) : Formula();
    } else {
      float number = 0.0f;
      fields.Number(key, number, -1000.0, 1000.0);
      formula = Formula(number);
    }
    used_.emplace_back(Where(fields, key), formula.names());
  }

  // The file, the field, and the piece or seam that it belongs to.
  std::string Where(Fields& fields, const FieldKey& key) const {
    return fields.where(key) + (part_.empty() ? "" : " (" + part_ + ")");
  }

  void DescribeOne(Fields& fields, GarmentParameter& parameter) {
    fields.Text("name", parameter.name, 40);
    fields.RequireAt("name",
                     IsName(parameter.name) && parameter.name != "name" && parameter.name != "seed",
                     kNameProblem);
    fields.Text(Optional("label"), parameter.label, 40);
    if (fields.Has("colour")) {
      parameter.type = GarmentParameter::Type::kColour;
      DescribeDye(fields, "colour", parameter.colour);
      return;
    }
    if (fields.Has("flag")) {
      parameter.type = GarmentParameter::Type::kFlag;
      bool usual = false;
      fields.Flag("flag", usual);
      parameter.usual = usual ? 1.0f : 0.0f;
      return;
    }
    fields.List(Optional("words"), parameter.words, 20,
                [](Fields& object, GarmentParameter::Word& word) {
                  object.Text("word", word.word, 40);
                  object.Number("is", word.value, -1000.0, 1000.0);
                });
    parameter.has_range = fields.Has("from") || parameter.words.empty();
    if (parameter.has_range) {
      fields.Number("from", parameter.from, -1000.0, 1000.0);
      fields.Number("to", parameter.to, parameter.from, 1000.0);
    }
    DescribeWordOrNumber(fields, "usual", parameter, parameter.usual);
  }

  void DescribeOne(Fields& fields, FabricDesign& fabric) {
    fields.Choice("weave", fabric.weave, kWeaves, "there is no weave '{}'",
                  "write wool, linen or leather");
    DescribeColourName(fields, "colour", fabric.colour);
    DrapeMaterial& material = fabric.material;
    fields.Number(Optional("stretch"), material.stretch, 0.0, 1.0);
    fields.Number(Optional("shear"), material.shear, 0.0, 1.0);
    fields.Number(Optional("squeeze"), material.squeeze, 0.0, 1.0);
    fields.Number(Optional("bend"), material.bend, 0.0, 1.0);
    fields.Number(Optional("friction"), material.friction, 0.0, 2.0);
    fields.Number(Optional("thickness"), material.gap, 0.002, 0.04);
    DescribeFormula(fields, Optional("soil"), fabric.soil);
    fields.Number(Optional("soil_height"), fabric.soil_height, 0.01, 2.0);
    fields.Number(Optional("fold_width"), fabric.fold_width, 0.03, 0.5);
    fields.Number(Optional("deepest_fold"), fabric.deepest_fold, 0.0, 0.1);
  }

  void DescribeOne(Fields& fields, Piece& piece) {
    fields.Text("name", piece.name, 40);
    part_ = "piece \"" + piece.name + "\"";
    fields.Choice("placed", piece.placed, kPlacements, part_ + " cannot be placed '{}'",
                  "write front, back, around, mantle or foot");
    switch (piece.placed) {
      case Placement::kFront:
      case Placement::kBack:
        DescribeFormula(fields, "hem", piece.hem);
        DescribeFormula(fields, "neck", piece.neck);
        DescribeFormula(fields, "neck_depth", piece.neck_depth);
        fields.List("widths", piece.widths, 12, [this](Fields& object, Piece::Width& width) {
          DescribeFormula(object, "down", width.down);
          DescribeFormula(object, "half", width.half);
        });
        fields.RequireAt("widths", !piece.widths.empty(), part_ + " has no width");
        break;
      case Placement::kAround:
        DescribeFormula(fields, "top", piece.top);
        DescribeFormula(fields, "hem", piece.hem);
        fields.Choice(Optional("about"), piece.about, kAbouts, part_ + " cannot lie about '{}'",
                      "write trunk, legs or arms");
        DescribeFormula(fields, Optional("from"), piece.from);
        DescribeFormula(fields, Optional("to"), piece.to);
        DescribeFormula(fields, Optional("corners"), piece.corners);
        DescribeFormula(fields, Optional("fullness"), piece.fullness);
        DescribeFormula(fields, Optional("folds"), piece.folds);
        DescribeFormula(fields, Optional("ease"), piece.ease);
        DescribeFormula(fields, Optional("ease_hem"), piece.ease_hem);
        break;
      case Placement::kMantle:
        DescribeFormula(fields, "hem", piece.hem);
        DescribeFormula(fields, "sinus", piece.sinus);
        fields.List("path", piece.path, 40, [this](Fields& object, Piece::Knot& knot) {
          DescribeFormula(object, "at", knot.at);
          DescribeFormula(object, "height", knot.height);
        });
        fields.RequireAt("path", piece.path.size() > 1, part_ + " needs two places of its path");
        break;
      case Placement::kFoot:
        break;
    }
    part_.clear();
  }

  void DescribeOne(Fields& fields, Seam& seam) {
    fields.Text("name", seam.name, 40);
    part_ = "seam \"" + seam.name + "\"";
    fields.List("pieces", seam.pieces, 2,
                [&](const FieldKey& key, std::string& name) { fields.Text(key, name, 40); });
    fields.Choice("edge", seam.edge, kEdges, part_ + " cannot be along '{}'",
                  "write left top, right top, left side or right side");
    DescribeFormula(fields, Optional("when"), seam.when);
    DescribeFormula(fields, "from", seam.from);
    fields.List(Optional("parts"), seam.parts, 20, [this](Fields& object, Seam::Part& part) {
      DescribeFormula(object, "from", part.from);
      DescribeFormula(object, "to", part.to);
    });
    part_.clear();
  }

  void DescribeOne(Fields& fields, GirdleDesign& girdle) {
    DescribeFormula(fields, Optional("when"), girdle.when);
    DescribeFormula(fields, "height", girdle.height);
    DescribeFormula(fields, "width", girdle.width);
    DescribeFormula(fields, Optional("round"), girdle.round);
    DescribeFormula(fields, Optional("lift"), girdle.lift);
    DescribeColourName(fields, "colour", girdle.colour);
    fields.Number(Optional("shade"), girdle.shade, 0.0, 1.0);
  }

  void DescribeOne(Fields& fields, BandDesign& bands) {
    DescribeColourName(fields, "colour", bands.colour);
    DescribeFormula(fields, Optional("stripe_at"), bands.stripe_at);
    DescribeFormula(fields, Optional("stripe_width"), bands.stripe_width);
    DescribeFormula(fields, Optional("border"), bands.border);
    fields.Number(Optional("border_from"), bands.border_from, 0.0, 20.0);
    fields.Number(Optional("border_to"), bands.border_to, bands.border_from, 20.0);
  }

  void DescribeColourName(Fields& fields, const char* key, std::string& name) {
    fields.Text(key, name, 40);
    const GarmentParameter* parameter = design_.Find(name);
    fields.RequireAt(key,
                     parameter != nullptr && parameter->type == GarmentParameter::Type::kColour,
                     "'" + name + "' is no parameter with a colour", "add it to \"parameters\"");
  }

  // A piece in front is followed by the one behind, and seams join these two.
  void CheckPieces(Fields& fields) {
    const std::vector<Piece>& pieces = design_.pieces;
    bool paired = !pieces.empty();
    std::set<std::string_view> names;
    std::set<std::pair<std::string_view, std::string_view>> joints;
    for (size_t i = 0; i < pieces.size(); ++i) {
      const bool begins = pieces[i].placed == Placement::kFront;
      const bool ends = i + 1 < pieces.size() && pieces[i + 1].placed == Placement::kBack;
      paired = paired && begins == ends && (i > 0 || pieces[i].placed != Placement::kBack);
      if (begins && ends) {
        joints.emplace(pieces[i].name, pieces[i + 1].name);
        joints.emplace(pieces[i + 1].name, pieces[i].name);
      }
      fields.RequireAt("pieces", names.insert(pieces[i].name).second,
                       "there are two pieces \"" + pieces[i].name + "\"");
    }
    fields.RequireAt(
        "pieces", paired,
        "there must be a piece, and one in front and one behind must follow each other "
        "in this order");
    for (const Seam& seam : design_.seams) {
      for (const std::string& name : seam.pieces) {
        fields.RequireAt("seams", names.contains(name),
                         "seam \"" + seam.name + "\" joins \"" + name + "\", which is no piece");
      }
      fields.RequireAt(
          "seams", seam.pieces.size() == 2 && joints.contains({seam.pieces[0], seam.pieces[1]}),
          "seam \"" + seam.name + "\" does not join a piece in front with the one behind it");
    }
  }

  void CheckNames(Fields& fields) {
    std::set<std::string_view> known;
    for (const std::string_view measure : MeasureNames()) {
      known.insert(measure);
    }
    for (const GarmentParameter& parameter : design_.parameters) {
      fields.RequireAt("parameters", known.insert(parameter.name).second,
                       "\"" + parameter.name + "\" has two meanings", "choose another name");
    }
    for (const auto& [name, size] : design_.sizes) {
      fields.RequireAt("sizes", known.insert(name).second, "\"" + name + "\" has two meanings",
                       "choose another name");
    }
    for (const auto& [where, names] : used_) {
      for (const std::string& name : names) {
        const GarmentParameter* parameter = design_.Find(name);
        if (!known.contains(name) ||
            (parameter != nullptr && parameter->type == GarmentParameter::Type::kColour)) {
          fields.Check(
              Status::Error(where, "\"" + name + "\" is no measure of the body, parameter or size",
                            "see the list in docs/how-to-make-a-garment.md"));
        }
      }
    }
    std::set<std::string, std::less<>> done;
    for (const auto& [name, size] : design_.sizes) {
      std::set<std::string, std::less<>> open;
      fields.RequireAt("sizes", Resolves(name, open, done), "\"" + name + "\" depends on itself",
                       "break the circle");
    }
  }

  // Tells whether a size can be computed; `done` are those that can be.
  bool Resolves(const std::string& name,
                std::set<std::string, std::less<>>& open,
                std::set<std::string, std::less<>>& done) const {
    const auto found = design_.sizes.find(name);
    if (found == design_.sizes.end() || done.contains(name)) {
      return true;
    }
    if (!open.insert(name).second) {
      return false;
    }
    for (const std::string& used : found->second.names()) {
      if (!Resolves(used, open, done)) {
        return false;
      }
    }
    done.insert(name);
    return true;
  }

  GarmentDesign& design_;
  std::string part_;  // The piece or seam that is read.
  std::vector<std::pair<std::string, std::vector<std::string>>> used_;  // Names by place.
};

}  // namespace

const GarmentParameter* GarmentDesign::Find(std::string_view parameter) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const GarmentParameter& p) { return p.name == parameter; });
  return found == parameters.end() ? nullptr : &*found;
}

const Piece* GarmentDesign::Find(Placement placement) const {
  const auto found = std::find_if(pieces.begin(), pieces.end(),
                                  [&](const Piece& piece) { return piece.placed == placement; });
  return found == pieces.end() ? nullptr : &*found;
}

std::filesystem::path GarmentLibrary() {
  return ShippedData("lararium/library/garments", "scenes/library/garments");
}

std::vector<std::string> GarmentNames(const std::filesystem::path& library) {
  return LibraryObjectNames(library);
}

std::filesystem::path GarmentFile(std::string_view name, const std::filesystem::path& library) {
  return library / name / "garment.json";
}

Result<GarmentDesign> ParseGarment(std::string_view text, const std::filesystem::path& file) {
  GarmentDesign design;
  design.file = file;
  design.name = file.parent_path().filename().string();
  DesignReader reader(design);
  LARARIUM_RETURN_IF_ERROR(
      ReadFields(text, file.string(), [&](Fields& fields) { reader.Describe(fields); }));
  return design;
}

Result<GarmentDesign> ReadGarment(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxFile));
  return ParseGarment(text, file);
}

Result<GarmentDesign> LoadGarment(std::string_view name, const std::filesystem::path& library) {
  return ReadGarment(GarmentFile(name, library));
}

}  // namespace lararium::import
