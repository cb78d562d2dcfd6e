#include "editor/jobs/baking.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <sstream>
#include <utility>

#include "editor/bake/glossy_probe.h"
#include "editor/bake/prop_transfer.h"
#include "editor/bake/sun_split.h"
#include "editor/bake/transfer.h"
#include "editor/document/document_fields.h"
#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_library.h"
#include "editor/import/cast/plain_figure.h"
#include "editor/import/model/levels_of_detail.h"
#include "editor/import/model/model_import.h"
#include "editor/import/motion/clip_import.h"
#include "editor/import/objects/object_import.h"
#include "editor/import/objects/object_library.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/jobs/sounds.h"
#include "shared/bundle/sha256.h"
#include "shared/core/file.h"
#include "shared/core/free_space.h"
#include "shared/core/json.h"
#include "shared/geometry/glm_convert.h"
#include "shared/stage/mesh_file.h"
#include "shared/stage/object_use.h"
#include "shared/stage/viseme_file.h"

namespace lararium::editor {

namespace {

// Part of every hash. Increase it when a change of the code gives another product from the same
// sources.
constexpr std::string_view kBakerVersion = "6";
constexpr size_t kMaxHashFileBytes = size_t{1} << 16;

std::filesystem::path LightFile(const ProjectPaths& paths,
                                const PlaceDocument& place,
                                const ProbeDocument& probe) {
  return paths.Place(place.name) / "baked" / (probe.name + ".light.json");
}

std::filesystem::path GlossyFile(const ProjectPaths& paths,
                                 const PlaceDocument& place,
                                 const ProbeDocument& probe) {
  return paths.Place(place.name) / "baked" / (probe.name + ".gloss");
}

std::filesystem::path MeshFile(const ProjectPaths& paths,
                               const PlaceDocument& place,
                               const OccluderDocument& occluder) {
  return paths.Place(place.name) / "baked" / (occluder.name + ".larmesh");
}

// The file beside a product that stores the hash of its inputs in its first line, and in further
// lines the warnings with which it was made.
std::filesystem::path HashFile(std::filesystem::path product) { return product += ".from"; }

Result<std::string> HashOf(std::string_view settings,
                           const std::vector<std::filesystem::path>& sources) {
  std::string all = std::string(kBakerVersion) + "\n" + std::string(settings);
  for (const std::filesystem::path& source : sources) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(source));
    all += "\n" + bundle::FormatSha256(bundle::ComputeSha256(bytes));
  }
  return bundle::FormatSha256(bundle::ComputeSha256(std::as_bytes(std::span(all))));
}

// The lines of the hash file; empty if there is none.
std::vector<std::string> LinesBeside(const std::filesystem::path& product) {
  std::vector<std::string> lines;
  const Result<std::string> content = ReadText(HashFile(product), kMaxHashFileBytes);
  std::istringstream text(content.ok() ? *content : "");
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line);
  }
  return lines;
}

bool UpToDate(const std::filesystem::path& product, const std::string& hash) {
  const std::vector<std::string> lines = LinesBeside(product);
  return FileExists(product) && !lines.empty() && lines.front() == hash;
}

// Writes the product before its hash: after a crash in between it is only baked again.
Status WriteProduct(const std::filesystem::path& product,
                    std::span<const std::byte> bytes,
                    const std::string& hash,
                    std::span<const std::string> warnings) {
  std::error_code error;
  std::filesystem::create_directories(product.parent_path(), error);
  if (error) {
    return Status::Error(product.parent_path().string(),
                         "cannot make the folder: " + error.message());
  }
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(product, bytes));
  std::string text = hash;
  for (std::string line : warnings) {
    std::ranges::replace(line, '\n', ' ');
    if (text.size() + line.size() < kMaxHashFileBytes) {
      text += "\n" + line;
    }
  }
  return WriteFileAtomically(HashFile(product), std::string_view(text));
}

// The relative duration of steps.
constexpr double kCostOfPerson = 5.0;
constexpr double kCostOfPersonsLight = 13.0;
constexpr double kCostOfObject = 1.0;
constexpr double kCostOfOthers = 0.1;

struct BakeStep {
  std::string name;
  std::filesystem::path product;
  std::vector<std::filesystem::path> sources;  // Empty: made from the settings alone.
  std::string settings;
  // Returns the bytes of the product, and adds warnings.
  std::function<Result<std::vector<std::byte>>(std::vector<std::string>&)> make;
  // What replaces the product when making it fails; the warning mentions it. Empty: there is no
  // replacement, and failing is an error.
  std::string stand_in = {};
  double cost = kCostOfOthers;
};

// Whether the product exists and matches its present inputs.
bool IsMade(const BakeStep& step) {
  const Result<std::string> hash = HashOf(step.settings, step.sources);
  return hash.ok() && UpToDate(step.product, *hash);
}

std::vector<std::byte> BytesOf(std::string_view text) {
  const std::span bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void DescribeBakedLight(Fields& fields, light::ProbeLight& light) {
  std::vector<glm::vec3> radiance(light.sky.begin(), light.sky.end());
  fields.List("radiance", radiance, light::kShCount,
              [&](const FieldKey& key, glm::vec3& coefficient) {
                fields.Numbers(key, std::span(&coefficient.x, 3));
              });
  fields.RequireAt("radiance", radiance.size() == light.sky.size(), "must have 36 coefficients",
                   "bake the project again");
  if (fields.reading() && radiance.size() == light.sky.size()) {
    std::copy(radiance.begin(), radiance.end(), light.sky.begin());
  }
  fields.Object("sun", light.sun);
}

std::string FormatLight(const light::ProbeLight& light) {
  return FormatFields(light, DescribeBakedLight).dump(1) + "\n";
}

Result<std::vector<std::byte>> MakeLight(const std::filesystem::path& file,
                                         const ProbeDocument& probe,
                                         std::vector<std::string>& warnings) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(file));
  for (const std::string& warning : image.warnings) {
    warnings.push_back(file.string() + ": " + warning);
  }
  const light::ProbeLight light = bake::ProjectProbeLight(
      image, {geometry::ToGlm(probe.stage_from_probe), static_cast<float>(probe.scale)});
  return BytesOf(FormatLight(light::Balanced(light, geometry::ToGlm(probe.balance))));
}

BakeStep LightStep(const ProjectPaths& paths,
                   const PlaceDocument& place,
                   const ProbeDocument& probe) {
  const std::filesystem::path file = paths.Resolve(probe.file);
  const Eigen::Vector4d q = probe.stage_from_probe.coeffs();
  return {"light of " + place.name + ", " + probe.name,
          LightFile(paths, place, probe),
          {file},
          Json::array({q.w(), q.x(), q.y(), q.z(), probe.scale, FormatVector(probe.balance),
                       light::kShCount, "sun apart"})
              .dump(),
          [=](std::vector<std::string>& warnings) { return MakeLight(file, probe, warnings); },
          "people are lit evenly instead"};
}

BakeStep GlossyStep(const ProjectPaths& paths,
                    const PlaceDocument& place,
                    const ProbeDocument& probe) {
  BakeStep step = LightStep(paths, place, probe);
  step.name = "reflections of " + place.name + ", " + probe.name;
  step.product = GlossyFile(paths, place, probe);
  step.settings += "reflections";
  step.make = [file = step.sources[0],
               probe](std::vector<std::string>&) -> Result<std::vector<std::byte>> {
    LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(file));
    bake::ProbeImage sky = bake::SplitSun(image).sky;
    for (glm::vec3& pixel : sky.pixels) {
      pixel *= geometry::ToGlm(probe.balance);
    }
    return light::SerializeGlossyMap(bake::PrefilterProbe(
        sky, {geometry::ToGlm(probe.stage_from_probe), static_cast<float>(probe.scale)}));
  };
  return step;
}

BakeStep MeshStep(const ProjectPaths& paths,
                  const PlaceDocument& place,
                  const OccluderDocument& occluder) {
  const std::filesystem::path file = paths.Resolve(occluder.file);
  return {"occluder " + occluder.name,
          MeshFile(paths, place, occluder),
          {file},
          "occluder",
          [=](std::vector<std::string>& warnings) -> Result<std::vector<std::byte>> {
            std::vector<std::string> notes;
            LARARIUM_ASSIGN_OR_RETURN(const geometry::TriangleMesh mesh,
                                      import::ImportMesh(file, notes));
            for (const std::string& note : notes) {
              warnings.push_back(occluder.name + ": " + note);
            }
            return stage::SerializeMesh(mesh);
          }};
}

Result<human::Human> MakePlainFigure(const CastDocument& member) {
  import::PlainFigureOptions options;
  options.height = static_cast<float>(member.height);
  options.tunic = geometry::ToGlm(member.tunic);
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, import::LoadPlainFigure(options));
  human.name = member.name;
  for (human::SkinnedMesh& mesh : human.meshes) {
    import::AddLevelsOfDetail(mesh);
  }
  import::OrderVertices(human);
  return human;
}

// How a figure is made, without its clips.
struct FigureSource {
  std::string settings;
  std::vector<std::filesystem::path> sources;
  std::function<Result<human::Human>(std::vector<std::string>&)> make;
};

FigureSource PlainFigure(const CastDocument& member) {
  std::ostringstream settings;
  settings << "plain figure " << member.height << " " << member.tunic.transpose() << " "
           << import::kLevelsOfDetail;
  return {settings.str(), {import::PlainFigureFile()}, [member](std::vector<std::string>&) {
            return MakePlainFigure(member);
          }};
}

// The returned function refers to progress, which must outlive it.
FigureSource FigureOfRecipe(const import::CastRecipe& recipe,
                            const std::filesystem::path& library,
                            const Progress& progress) {
  std::vector<std::filesystem::path> designs;
  for (const Json& garment : recipe.garments) {
    if (std::filesystem::path file = import::GarmentFile(garment.value("name", ""));
        FileExists(file)) {
      designs.push_back(std::move(file));
    }
  }
  return {"recipe " + FormatFields(recipe).dump() + " " + std::to_string(import::kLevelsOfDetail) +
              ", bare of covered skin",
          std::move(designs), [=, &progress](std::vector<std::string>&) -> Result<human::Human> {
            LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary opened,
                                      import::CastLibrary::Open(library));
            return import::BuildCast(opened, recipe, progress);
          }};
}

// The plain figure for a person with a recipe where the library is missing; a warning says so.
FigureSource StandIn(const CastDocument& member) {
  FigureSource figure = PlainFigure(member);
  figure.make = [member](std::vector<std::string>& warnings) {
    warnings.push_back(member.name +
                       ": the plain figure stands in, because the cast library is not "
                       "installed; fetch it with lararium-editor fetch-cast-library");
    return MakePlainFigure(member);
  };
  return figure;
}

FigureSource ImportedFigure(const ProjectPaths& paths, const CastDocument& member) {
  FigureSource figure{
      "model " + std::to_string(import::kLevelsOfDetail), {paths.Resolve(member.model)}, {}};
  std::filesystem::path bone_map;
  if (!member.bone_map.empty()) {
    bone_map = paths.Resolve(member.bone_map);
    figure.sources.push_back(bone_map);
  }
  if (!member.bones.empty()) {
    figure.settings += " " + Json(member.bones).dump();
  }
  figure.make =
      [=, model = figure.sources[0]](std::vector<std::string>& warnings) -> Result<human::Human> {
    import::ImportOptions options;
    LARARIUM_ASSIGN_OR_RETURN(options.bones, GivenBoneNames(bone_map, member.bones));
    LARARIUM_ASSIGN_OR_RETURN(import::ImportedHuman imported, import::ImportPerson(model, options));
    if (!imported.is_human) {
      imported.notes.emplace_back(
          "no human body was recognised; it is taken to stand Y up, facing +Z, as glTF's do");
    }
    for (const std::string& note : imported.notes) {
      warnings.push_back(member.name + ": " + note);
    }
    for (human::SkinnedMesh& mesh : imported.human.meshes) {
      import::AddLevelsOfDetail(mesh);
    }
    import::OrderVertices(imported.human);
    return std::move(imported.human);
  };
  return figure;
}

Status AddClips(const ProjectPaths& paths,
                const CastDocument& member,
                human::Human& human,
                std::vector<std::string>& warnings) {
  for (const ClipDocument& document : member.clips) {
    import::ClipImportOptions options;
    options.retarget.name = document.name;
    options.retarget.loop = document.loops;
    LARARIUM_ASSIGN_OR_RETURN(
        import::ImportedClip imported,
        import::ImportClip(paths.Resolve(document.file), human.skeleton, options));
    for (const std::string& note : imported.notes) {
      warnings.push_back(member.name + ", " + document.name + ": " + note);
    }
    LARARIUM_RETURN_IF_ERROR(import::AddClip(std::move(imported.clip), human));
  }
  return Status();
}

BakeStep HumanStep(const ProjectPaths& paths,
                   const CastDocument& member,
                   const FigureSource& figure) {
  BakeStep step{"human " + member.name,
                paths.Human(member.name),
                figure.sources,
                member.name + " " + figure.settings,
                {}};
  step.cost = kCostOfPerson;
  for (const ClipDocument& clip : member.clips) {
    step.sources.push_back(paths.Resolve(clip.file));
    step.settings += " " + clip.name + (clip.loops ? " loops" : "");
  }
  step.make = [paths, member, make = figure.make](
                  std::vector<std::string>& warnings) -> Result<std::vector<std::byte>> {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, make(warnings));
    human.name = member.name;
    LARARIUM_RETURN_IF_ERROR(AddClips(paths, member, human, warnings));
    return human::SerializeHuman(human);
  };
  return step;
}

Result<BakeStep> HumanStep(const ProjectPaths& paths,
                           const CastDocument& member,
                           const Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::optional<import::CastRecipe> recipe, RecipeOf(member));
  if (!recipe) {
    return HumanStep(paths, member,
                     member.model.empty() ? PlainFigure(member) : ImportedFigure(paths, member));
  }
  const std::optional<std::filesystem::path> library = FindCastLibrary();
  BakeStep step = HumanStep(paths, member, FigureOfRecipe(*recipe, library.value_or(""), progress));
  // A person who was baked with the library stays unchanged after the library was removed.
  return library || IsMade(step) ? step : HumanStep(paths, member, StandIn(member));
}

// Passes on a cancellation, but reports no progress.
class OnlyCancels : public Progress {
 public:
  explicit OnlyCancels(const Progress& progress) : progress_(progress) {}
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return progress_.Cancelled(); }

 private:
  const Progress& progress_;
};

std::string TransferSettings() {
  const bake::TransferOptions options;
  std::ostringstream settings;
  settings << "light transfer " << options.count << " " << options.rays << " " << options.bounces
           << " " << options.key_poses << " " << options.blockers << " " << options.receivers
           << " backs";
  return settings.str();
}

// Adds light transfer to the person that the step before has made. The hash of that person covers
// all inputs.
BakeStep TransferStep(const ProjectPaths& paths,
                      const CastDocument& member,
                      const Progress& progress) {
  const std::filesystem::path file = paths.Human(member.name);
  return {"light transfer of " + member.name,
          paths.LitHuman(member.name),
          {HashFile(file)},
          TransferSettings(),
          [file, &progress](std::vector<std::string>&) -> Result<std::vector<std::byte>> {
            LARARIUM_ASSIGN_OR_RETURN(human::Human human, human::LoadHuman(file));
            OnlyCancels quiet(progress);
            LARARIUM_ASSIGN_OR_RETURN(human.light, bake::BakeTransfer(human, {}, quiet));
            return human::SerializeHuman(human);
          },
          {},
          kCostOfPersonsLight};
}

std::string PropTransferSettings() {
  const bake::PropTransferOptions options;
  std::ostringstream settings;
  settings << ", light transfer " << options.count << " " << options.rays << " " << options.bounces
           << " " << options.longest_edge << " " << options.most_vertices << " "
           << options.receiver_area << " " << options.most_receivers << ", "
           << import::kLevelsOfDetail << " levels of detail";
  return settings.str();
}

Result<std::vector<std::byte>> LitProp(const stage::Prop& prop, const std::string& place) {
  LARARIUM_ASSIGN_OR_RETURN(const auto model, stage::ObjectModel::Create(prop, place));
  LARARIUM_ASSIGN_OR_RETURN(stage::Prop lit, bake::BakePropTransfer(*model, {}));
  import::AddLevelsOfDetail(lit);
  return stage::SerializeProp(lit);
}

BakeStep ObjectStep(const ProjectPaths& paths, const ObjectDocument& object) {
  BakeStep step{"object " + object.name,
                paths.Prop(object.name),
                {},
                "object file, scenery in one part, emission" + PropTransferSettings(),
                {}};
  step.cost = kCostOfObject;
  const Result<std::filesystem::path> file = ObjectFile(paths, object);
  if (!file.ok()) {
    step.make = [status = file.status()](std::vector<std::string>&) {
      return Result<std::vector<std::byte>>(status);
    };
    return step;
  }
  step.sources.push_back(*file);
  const std::filesystem::path use = import::UseFileBeside(*file);
  if (use != *file && FileExists(use)) {
    step.sources.push_back(use);
  }
  step.make = [file = *file, name = object.name](
                  std::vector<std::string>& warnings) -> Result<std::vector<std::byte>> {
    std::vector<std::string> notes;
    LARARIUM_ASSIGN_OR_RETURN(const stage::Prop prop, import::ImportObject(file, notes));
    for (const std::string& note : notes) {
      warnings.push_back(name + ": " + note);
    }
    return LitProp(prop, file.string());
  };
  return step;
}

// Synthesising a voice is so fast that the steps for sound and visemes each do it.
void AddSpeechSteps(const SpokenLine& spoken, std::vector<BakeStep>& steps) {
  const bake::SpeechSource& source = spoken.source;
  const std::string name = spoken.line->id + " in " + spoken.language;
  std::vector<std::filesystem::path> sources;
  if (!source.recording.empty()) {
    sources.push_back(source.recording);
  }
  const std::string settings =
      Json::array({source.recording.empty() ? "speech 1" : "recording 2", source.text,
                   source.language, source.voice.variant, source.voice.pitch, source.voice.range,
                   source.voice.rate})
          .dump();
  steps.push_back({"voice of " + name, spoken.sound, sources, settings,
                   [source](std::vector<std::string>&) { return bake::BakeSound(source); }});
  steps.push_back({"visemes of " + name, spoken.visemes, sources, settings,
                   [source](std::vector<std::string>& warnings) -> Result<std::vector<std::byte>> {
                     LARARIUM_ASSIGN_OR_RETURN(const human::VisemeTrack track,
                                               bake::BakeVisemes(source, warnings));
                     return BytesOf(stage::FormatVisemes(track));
                   }});
}

bool OnlyPeople(BakeWhat what) {
  return what == BakeWhat::kPeople || what == BakeWhat::kUnlitPeople;
}

Status AddPeople(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 const Progress& progress,
                 BakeWhat what,
                 std::vector<BakeStep>& steps) {
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(BakeStep step, HumanStep(paths, member, progress));
    steps.push_back(std::move(step));
    if (what != BakeWhat::kUnlitPeople) {
      steps.push_back(TransferStep(paths, member, progress));
    }
  }
  return Status();
}

Result<std::vector<BakeStep>> Steps(const ProjectPaths& paths,
                                    const ProjectDocument& document,
                                    const Progress& progress,
                                    BakeWhat what,
                                    std::span<const SpokenLine> spoken) {
  std::vector<BakeStep> steps;
  if (OnlyPeople(what)) {
    LARARIUM_RETURN_IF_ERROR(AddPeople(paths, document, progress, what, steps));
    return steps;
  }
  for (const PlaceDocument& place : document.places) {
    for (const ProbeDocument& probe : place.probes) {
      steps.push_back(LightStep(paths, place, probe));
      steps.push_back(GlossyStep(paths, place, probe));
    }
    for (const OccluderDocument& occluder : place.occluders) {
      if (occluder.kind() == OccluderDocument::Kind::kModel) {
        steps.push_back(MeshStep(paths, place, occluder));
      }
    }
  }
  if (what == BakeWhat::kAll) {
    LARARIUM_RETURN_IF_ERROR(AddPeople(paths, document, progress, what, steps));
  }
  for (const ObjectDocument& object : document.objects) {
    steps.push_back(ObjectStep(paths, object));
  }
  for (const SpokenLine& line : spoken) {
    AddSpeechSteps(line, steps);
  }
  return steps;
}

// Returns true where the product had to be made. Adds the warnings of making it, now or before.
Result<bool> RunStep(const BakeStep& step, std::vector<std::string>& warnings) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string hash, HashOf(step.settings, step.sources));
  if (UpToDate(step.product, hash)) {
    std::ranges::copy(ProductWarnings(step.product), std::back_inserter(warnings));
    return false;
  }
  LARARIUM_RETURN_IF_ERROR(RequireSpace(step.product.parent_path()));
  std::vector<std::string> own;
  const Result<std::vector<std::byte>> bytes = step.make(own);
  std::ranges::copy(own, std::back_inserter(warnings));
  LARARIUM_RETURN_IF_ERROR(bytes.status());
  LARARIUM_RETURN_IF_ERROR(WriteProduct(step.product, *bytes, hash, own));
  return true;
}

// Like RunStep(), but a product with a replacement that cannot be made is a warning, and an old one
// is deleted, unless the disk is full.
Result<bool> RunOrReplace(const BakeStep& step, std::vector<std::string>& warnings) {
  Result<bool> made = RunStep(step, warnings);
  const bool full = !RequireSpace(step.product.parent_path()).ok();
  if (made.ok() || step.stand_in.empty() || full) {
    return made;
  }
  // Several products of the same bad file give only one warning.
  const bool known = std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
    return warning.starts_with(made.message());
  });
  if (!known) {
    warnings.push_back(made.message() + "; " + step.stand_in);
  }
  std::error_code ignored;
  std::filesystem::remove(HashFile(step.product), ignored);
  std::filesystem::remove(step.product, ignored);
  return false;
}

Status NotBaked(const std::filesystem::path& product) {
  return Status::Error(product.string(), "was not baked yet", "bake the project");
}

// White light of the same radiance from all directions.
light::ProbeLight EvenLight(float radiance) {
  light::ProbeLight light;
  const float y00 = light::EvaluateShBasis(glm::vec3(0.0f, 1.0f, 0.0f))[0];
  light.sky[0] = glm::vec3(radiance / y00);
  return light;
}

}  // namespace

float EvenRadiance(const vision::SceneDatabase& map) {
  constexpr float kWithoutColours = 0.5f;
  constexpr float kUsualAlbedo = 0.3f;  // The average of stone, plaster, wood and earth.
  if (map.colours.empty()) {
    return kWithoutColours;
  }
  double sum = 0.0;
  for (const Eigen::Vector3f& colour : map.colours) {
    sum += 0.2126 * colour.x() + 0.7152 * colour.y() + 0.0722 * colour.z();
  }
  const auto mean = static_cast<float>(sum / static_cast<double>(map.colours.size()));
  return std::clamp(mean / kUsualAlbedo, 0.02f, 2.0f);
}

Result<BakeReport> Bake(const ProjectPaths& paths,
                        const ProjectDocument& document,
                        Progress& progress,
                        BakeWhat what) {
  BakeReport report;
  ProjectLines lines;
  std::vector<SpokenLine> spoken;
  if (!OnlyPeople(what)) {
    LARARIUM_ASSIGN_OR_RETURN(lines, LoadProjectLines(paths, document));
    LARARIUM_ASSIGN_OR_RETURN(spoken, SpokenLines(paths, document, lines));
    const LineNotes notes = CheckLineFiles(paths, lines, spoken);
    for (const auto* sentences : {&notes.problems, &notes.warnings}) {
      std::ranges::move(EnglishOf(*sentences), std::back_inserter(report.warnings));
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<BakeStep> steps,
                            Steps(paths, document, progress, what, spoken));
  double whole = 0.0;
  for (const BakeStep& step : steps) {
    whole += step.cost;
  }
  double done = 0.0;
  for (const BakeStep& step : steps) {
    progress.Report("baking", done / whole);
    if (progress.Cancelled()) {
      return Status::Error("bake", "cancelled before the " + step.name);
    }
    LARARIUM_ASSIGN_OR_RETURN(const bool made, RunOrReplace(step, report.warnings));
    (made ? report.baked : report.unchanged).push_back(step.name);
    done += step.cost;
  }
  progress.Report("baking", 1.0);
  return report;
}

Result<std::filesystem::path> ObjectFile(const ProjectPaths& paths, const ObjectDocument& object) {
  return object.file.empty() ? import::FindLibraryObject(object.model)
                             : Result<std::filesystem::path>(paths.Resolve(object.file));
}

std::vector<std::string> ProductWarnings(const std::filesystem::path& product) {
  std::vector<std::string> lines = LinesBeside(product);
  if (!lines.empty()) {
    lines.erase(lines.begin());
  }
  return lines;
}

void CopyProduct(const std::filesystem::path& from, const std::filesystem::path& to) {
  // The hash is read first, as it is written last: a product that is replaced meanwhile does not
  // get the hash of a newer one.
  const std::vector<std::string> lines = LinesBeside(from);
  const Result<std::vector<std::byte>> bytes = ReadBytes(from);
  if (!lines.empty() && bytes.ok()) {
    (void)WriteProduct(to, *bytes, lines.front(), std::span(lines).subspan(1)).ok();
  }
}

std::vector<std::string> WarningsOfProducts(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            std::span<const SpokenLine> spoken) {
  std::vector<std::string> warnings;
  const NoProgress silent;
  const Result<std::vector<BakeStep>> steps =
      Steps(paths, document, silent, BakeWhat::kAll, spoken);
  if (steps.ok()) {
    for (const BakeStep& step : *steps) {
      std::ranges::copy(ProductWarnings(step.product), std::back_inserter(warnings));
    }
  }
  return warnings;
}

std::vector<std::string> PeopleToBake(const ProjectPaths& paths, const ProjectDocument& document) {
  const NoProgress silent;
  std::vector<std::string> names;
  for (const CastDocument& member : document.cast) {
    const Result<BakeStep> step = HumanStep(paths, member, silent);
    if (!step.ok() || !IsMade(*step) || !IsMade(TransferStep(paths, member, silent))) {
      names.push_back(member.name);
    }
  }
  return names;
}

Result<BakedHuman> BakeHuman(const ProjectPaths& paths, const CastDocument& member) {
  const NoProgress silent;
  BakedHuman baked;
  LARARIUM_ASSIGN_OR_RETURN(const BakeStep step, HumanStep(paths, member, silent));
  LARARIUM_RETURN_IF_ERROR(RunStep(step, baked.warnings).status());
  LARARIUM_ASSIGN_OR_RETURN(baked.human, LoadBakedHuman(paths, member));
  return baked;
}

Result<std::vector<light::PlacedProbe>> LoadBakedProbes(const ProjectPaths& paths,
                                                        const PlaceDocument& place,
                                                        float even_radiance) {
  const light::ProbeLight even = EvenLight(even_radiance);
  if (place.probes.empty()) {
    return std::vector<light::PlacedProbe>{{{}, light::kNoon, even}};
  }
  std::vector<light::PlacedProbe> probes;
  for (const ProbeDocument& probe : place.probes) {
    const std::filesystem::path file = LightFile(paths, place, probe);
    if (!FileExists(file)) {
      probes.push_back({geometry::ToGlm(probe.position), probe.hour, even});
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
    LARARIUM_ASSIGN_OR_RETURN(
        const light::ProbeLight light,
        ParseFields<light::ProbeLight>(JsonView(json, file.string()), DescribeBakedLight,
                                       UnknownFields::kIgnore));
    probes.push_back({geometry::ToGlm(probe.position), probe.hour, light});
  }
  return probes;
}

Result<std::vector<light::GlossyMap>> LoadBakedReflections(const ProjectPaths& paths,
                                                           const PlaceDocument& place) {
  std::vector<light::GlossyMap> maps;
  for (const ProbeDocument& probe : place.probes) {
    const std::filesystem::path file = GlossyFile(paths, place, probe);
    light::GlossyMap& map = maps.emplace_back();
    if (FileExists(file)) {
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
      LARARIUM_ASSIGN_OR_RETURN(map, light::ParseGlossyMap(bytes, file.string()));
    }
  }
  return maps;
}

Result<geometry::TriangleMesh> LoadBakedMesh(const ProjectPaths& paths,
                                             const PlaceDocument& place,
                                             const OccluderDocument& occluder) {
  const std::filesystem::path file = MeshFile(paths, place, occluder);
  if (!FileExists(file)) {
    return NotBaked(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return stage::ParseMesh(bytes, file.string());
}

std::filesystem::path BakedHumanFile(const ProjectPaths& paths, const CastDocument& member) {
  const std::filesystem::path plain = paths.Human(member.name);
  const std::filesystem::path lit = paths.LitHuman(member.name);
  const Result<std::string> hash = HashOf(TransferSettings(), {HashFile(plain)});
  return hash.ok() && UpToDate(lit, *hash) ? lit : plain;
}

Result<human::Human> LoadBakedHuman(const ProjectPaths& paths, const CastDocument& member) {
  const std::filesystem::path file = BakedHumanFile(paths, member);
  if (!FileExists(file)) {
    return NotBaked(file);
  }
  return human::LoadHuman(file);
}

Result<show::CastMember> ShareBakedHuman(const ProjectPaths& paths,
                                         const CastDocument& member,
                                         float finest) {
  const std::filesystem::path file = BakedHumanFile(paths, member);
  if (!FileExists(file)) {
    return NotBaked(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(show::CastMember person, SharePerson(file, finest));
  person.name = member.name;
  return person;
}

Result<human::Human> MakeStandIn(const ProjectPaths& paths, const CastDocument& member) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human figure, MakePlainFigure(member));
  std::vector<std::string> told_when_baked;
  LARARIUM_RETURN_IF_ERROR(AddClips(paths, member, figure, told_when_baked));
  return figure;
}

Result<stage::Prop> LoadBakedProp(const ProjectPaths& paths, const ObjectDocument& object) {
  const std::filesystem::path file = paths.Prop(object.name);
  if (!FileExists(file)) {
    return NotBaked(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return stage::ParseProp(bytes, file.string());
}

}  // namespace lararium::editor
