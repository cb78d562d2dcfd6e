// Tests mutated bundles: each is either rejected with a clear error or can be played.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/audio/mixer.h"
#include "shared/bundle/bundle.h"
#include "shared/bundle/show_manifest.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/random.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/stage/mesh_file.h"
#include "shared/vision/tracker.h"
#include "tests/audio/test_sounds.h"
#include "tests/bundle/zip_archive.h"
#include "tests/human/full_body.h"
#include "tests/human/rich_human.h"
#include "tests/render/box_font.h"
#include "tests/stage/test_props.h"
#include "tests/support/png.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"
#include "tests/support/thorough.h"

namespace lararium::player {
namespace {

constexpr double kMostSeconds = 1.0;
constexpr double kMostMebibytes = 512.0;
constexpr int kWidth = 160, kHeight = 120;

struct NamedBytes {
  std::string name;
  std::string bytes;
};

std::string TextOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

cv::Mat Speckled(int width, int height, int type) {
  cv::Mat image(height, width, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, {}, 1.5);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

render::CaptionFont AlphabetOfBoxes() {
  std::string letters;
  for (char letter = 'A'; letter <= 'z'; ++letter) {
    letters += letter;
  }
  return test::BoxFont(letters);
}

// A place that can be tracked, with keyframes and their images.
vision::SceneDatabase Map() {
  test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 60, .cameras = 3});
  world.camera = world.camera.Resized(kWidth, kHeight);
  vision::SceneDatabase map = test::MakeSceneDatabase(world);
  map.colours.assign(map.points.size(), {0.4f, 0.3f, 0.2f});
  for (vision::Keyframe& keyframe : map.keyframes) {
    keyframe.grey = Speckled(kWidth, kHeight, CV_8UC1);
  }
  return map;
}

human::Human Person() {
  human::Human human = human::RichHuman();
  human.textures[0] = std::make_shared<const human::Texture>(
      human::Texture{"wool", test::Png(Speckled(16, 16, CV_8UC3))});
  return human;
}

stage::Prop Cup() {
  const human::Human human = Person();
  stage::Prop prop = test::MakeCup();
  prop.textures = human.textures;
  prop.materials = human.materials;
  stage::PropMesh& mesh = prop.parts[0].meshes[0];
  mesh.material = 0;
  mesh.uvs.assign(mesh.positions.size(), {0.5f, 0.25f});
  mesh.coarser = {{0.01f, {mesh.indices.begin(), mesh.indices.begin() + 6}}};
  prop.parts[1].meshes[0].emission = {2.0f, 1.0f, 0.5f};
  return prop;
}

// A show that uses a little of every feature.
bundle::ShowManifest Manifest() {
  bundle::ShowManifest manifest;
  manifest.title = "Small";
  manifest.credits = "Nobody";
  manifest.drama = "drama.lua";
  bundle::PlaceEntry& place = manifest.places.emplace_back();
  place.name = "bar";
  place.scene = "bar.larscene";
  place.camera = {kWidth, 0.01f, 0.001f, 0.5f, 0.7f, 0.3f};
  place.occluders = {{"wall", "wall.larmesh", {}}};
  light::PlacedProbe& probe = place.probes.emplace_back();
  probe.light.sky[0] = {1.0f, 2.0f, 3.0f};
  probe.light.sun = light::Sun{{0.0f, 1.0f, 0.0f}, {2.0f, 2.0f, 1.0f}, 0.01f};
  place.probes.push_back(probe);
  place.probes.back().hour = 18.0;
  place.probes.back().position = {1.0f, 0.0f, 0.0f};
  place.glossy = {"noon.gloss", ""};
  place.acoustics.reverb = stage::Reverb::kSmallRoom;
  place.acoustics.ambience.emplace_back().sound = "street";
  manifest.cast = {{"one", "one.larhuman"}, {"two", "two.larhuman"}};
  manifest.objects = {{"cup", "cup.larprop", {}}, {"lamp", "lamp.larprop", {}}};
  manifest.lines = {{"hello", "one", {{"la", {"hello.json", "hello.flac"}}}}};
  manifest.spoken = {{"la", "captions.json"}};
  manifest.captions = {"en"};
  manifest.caption_font = {"font.json", "font.png"};
  manifest.sounds = {{"street", "street.ogg"}, {"click", "click.wav"}};
  manifest.paradata = "paradata.json";
  return manifest;
}

std::vector<NamedBytes> Members() {
  using test::Coding;
  geometry::TriangleMesh wall;
  wall.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  wall.indices = {0, 1, 2};
  light::GlossyMap glossy;
  glossy.texels.assign(light::GlossyMap::kTexels, light::PackRadiance({0.5f, 0.4f, 0.3f}));
  const render::CaptionFont font = AlphabetOfBoxes();
  return {
      {"drama.lua", R"(
function main()
  local one = actor("one")
  sound("click"):play{on = object("cup")}
  one:say("hello")
  wait(0.1)
  for i = 1, 5 do wait(0.05) end
end
)"},
      {"bar.larscene", TextOf(vision::SerializeSceneDatabase(Map()))},
      {"wall.larmesh", TextOf(stage::SerializeMesh(wall))},
      {"noon.gloss", TextOf(light::SerializeGlossyMap(glossy))},
      {"one.larhuman", TextOf(human::SerializeHuman(Person()))},
      {"two.larhuman", TextOf(human::SerializeHuman(human::FullBody(0.4f, 0)))},
      {"cup.larprop", TextOf(stage::SerializeProp(Cup()))},
      {"lamp.larprop", TextOf(stage::SerializeProp(test::MakeLamp()))},
      {"hello.json", R"({"schema": 1, "duration": 0.5, "visemes": [{"t": 0, "viseme": "aa"}]})"},
      {"hello.flac", TextOf(test::Encode(test::Tone(0.5, 300.0), 1, test::kRate, Coding::kFlac))},
      {"street.ogg", TextOf(test::Encode(test::Noise(0.5), 1, test::kRate, Coding::kVorbis))},
      {"click.wav", TextOf(test::Encode(test::Click(0.2), 1))},
      {"captions.json",
       R"({"schema": 1, "lines": {"hello": {"en": [{"begin": 0, "end": 1, "text": "Hello"}]}},)"
       R"( "names": {"one": {"en": "One"}}})"},
      {"font.json", render::FormatCaptionMetrics(font)},
      {"font.png", TextOf(test::Png(font.atlas))},
      {"paradata.json",
       R"({"schema": 1, "author": "A", "licence": "CC0-1.0", "sources": {"cil": "CIL IV"},)"
       R"( "claims": {"objects": {"cup": {"certainty": "inferred", "source": ["cil"],)"
       R"( "text": {"it": "Una coppa"}}}, "people": {"one": {"certainty": "attested"}}}})"}};
}

// The text of a manifest with members and their hashes.
std::string ManifestText(const std::vector<NamedBytes>& members) {
  bundle::ShowManifest manifest = Manifest();
  for (const NamedBytes& member : members) {
    manifest.members.push_back({member.name, member.bytes.size(),
                                bundle::ComputeSha256(std::as_bytes(std::span(member.bytes)))});
  }
  return bundle::FormatShowManifest(manifest);
}

std::string Archive(const std::string& manifest, const std::vector<NamedBytes>& members) {
  std::vector<test::ZipEntry> entries = {{"manifest.json", manifest}};
  for (const NamedBytes& member : members) {
    entries.push_back({member.name, member.bytes});
  }
  return test::MakeZip(entries);
}

// ---- playing a show ----

struct Took {
  double wall = 0.0;       // seconds
  double processor = 0.0;  // seconds, sum over all threads
};

class Stopwatch {
 public:
  Took Seconds() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

vision::TrackedFrame ImageAt(int index, const cv::Mat& bgr, const cv::Mat& grey) {
  vision::TrackedFrame tracked;
  tracked.camera = geometry::CameraModel{kWidth, kHeight, 120.0, 120.0, 79.5, 59.5};
  tracked.camera_from_map = geometry::Rigid3{Eigen::Quaterniond::Identity(), {0.0, 0.0, 4.0}};
  tracked.frame.bgr = bgr;
  tracked.frame.grey = grey;
  tracked.frame.index = index;
  tracked.frame.capture_time = index / 30.0;
  return tracked;
}

Status TrackOne(const show::ShowContent& content, const geometry::Frame& frame) {
  LARARIUM_ASSIGN_OR_RETURN(const geometry::CameraModel camera,
                            content.places[0].map->camera.ForImages(kWidth, kHeight));
  vision::TrackerOptions options;
  options.threads = 1;
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<vision::PoseSource> poses,
                            vision::CreateTracker(show::Maps(content.places), camera, options));
  show::SetOccluders(content.places, *poses);
  (void)poses->Track(frame);
  return Status();
}

// Plays half a second of the show with sound, and draws two frames.
Status Play(show::ShowContent content, const render::RenderTarget& target, Log& log) {
  const cv::Mat bgr = Speckled(kWidth, kHeight, CV_8UC3);
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  LARARIUM_RETURN_IF_ERROR(TrackOne(content, ImageAt(0, bgr, grey).frame));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<show::Show> show,
                            show::Show::Create(std::move(content), {}, log));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<audio::Mixer> mixer,
                            audio::Mixer::Create(show->sounds(), {}));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<show::ShowRenderer> renderer,
                            show::ShowRenderer::Create(show->content()));
  show::StagedFrame staged;
  std::array<float, 2 * audio::Mixer::kBlockFrames> block = {};
  for (int i = 0; i < 50; ++i) {
    const double time = 0.01 * i;
    show->StageFrame(ImageAt(i, bgr, grey), time, staged);
    if (i == 1 || i == 49) {
      LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
      target.Finish();
    }
    mixer->Render(staged.sound, time, block);
    if (!std::all_of(block.begin(), block.end(), [](float s) { return std::isfinite(s); })) {
      return Status::Error("sound", "samples that are no numbers");
    }
  }
  return Status();
}

// Loads and plays a bundle in the same way as the player.
Status LoadAndPlay(const std::filesystem::path& path,
                   const render::RenderTarget& target,
                   Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(path));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, show::LoadShowContent(bundle));
  return Play(std::move(content), target, log).At(path.string());
}

// ---- mutations ----

// Flips, sets, removes, repeats or inserts bytes.
void MutateBytes(std::string& bytes, Random& random) {
  const int changes = 1 + static_cast<int>(random.Below(4));
  for (int i = 0; i < changes && !bytes.empty(); ++i) {
    const auto at = random.Below(static_cast<uint32_t>(bytes.size()));
    const auto run = std::min<size_t>(1 + random.Below(16), bytes.size() - at);
    switch (random.Below(6)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.Below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random.Below(256));
        break;
      case 2:  // dangerous values of sizes and counts
        bytes.replace(at, run, run, random.Below(2) == 0 ? '\xff' : '\0');
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes.insert(at, run, static_cast<char>(random.Below(256)));
        break;
      default:
        bytes.insert(random.Below(static_cast<uint32_t>(bytes.size())), bytes.substr(at, run));
    }
  }
}

// Changes aligned words, because counts, offsets, indices and numbers are aligned in our files.
void MutateWords(std::string& bytes, Random& random) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::array<float, 8> kNumbers = {std::numeric_limits<float>::quiet_NaN(),
                                             kInfinity,
                                             -kInfinity,
                                             3e38f,
                                             -1e20f,
                                             1e-40f,
                                             0.0f,
                                             -1.0f};
  constexpr std::array<uint32_t, 8> kIntegers = {0,       1,       0x7fffffff, 0x80000000,
                                                 ~0u - 1, 1 << 20, 0xffff,     65};
  const uint32_t words = static_cast<uint32_t>(bytes.size() / 4);
  const int changes = 1 + static_cast<int>(random.Below(2));
  for (int i = 0; i < changes && words > 0; ++i) {
    const size_t at = 4 * size_t{random.Below(words)};
    uint32_t word = 0;
    std::memcpy(&word, &bytes[at], 4);
    switch (random.Below(4)) {
      case 0:
        std::memcpy(&word, &kNumbers[random.Below(kNumbers.size())], 4);
        break;
      case 1:
        word = kIntegers[random.Below(kIntegers.size())];
        break;
      case 2:
        word += random.Below(2) == 0 ? 1 : ~0u;
        break;
      default:  // changes half of the word
        word = random.Below(2) == 0 ? word | 0xffff0000 : word & 0xffff0000;
    }
    std::memcpy(&bytes[at], &word, 4);
  }
}

// Collects all values of a JSON document, the document itself first.
void Collect(Json& json, std::vector<Json*>& values) {
  values.push_back(&json);
  if (json.is_structured()) {
    for (Json& value : json) {
      Collect(value, values);
    }
  }
}

// Stands for the number 1e999, which is valid JSON but cannot be written by our library.
constexpr const char* kTooLarge = "@1e999@";

Json OddValue(const Json& before, const std::vector<Json*>& values, Random& random) {
  switch (random.Below(12)) {
    case 0:
      return nullptr;
    case 1:
      return kTooLarge;
    case 2:
      return before.is_number() ? Json(-before.get<double>()) : Json(-1);
    case 3:
      return before.is_number() ? Json(before.get<double>() * 1e6) : Json(1e300);
    case 4:
      return std::numeric_limits<int64_t>::max();
    case 5:
      return 0;
    case 6:
      return "";
    case 7:
      return std::string(1 + random.Below(5000), 'x');
    case 8:
      return "../../\x01\xc3\xa9/" + std::to_string(random.Below(10));
    case 9:
      return Json::array();
    case 10:
      return Json::object();
    default:  // a copy of another value of the document
      return *values[random.Below(static_cast<uint32_t>(values.size()))];
  }
}

void MutateList(Json& list, Random& random) {
  const auto at = list.begin() + random.Below(static_cast<uint32_t>(list.size()));
  switch (random.Below(3)) {
    case 0:
      list.erase(at);
      break;
    case 1:
      list.push_back(Json(*at));
      break;
    default: {
      const Json item = *at;
      const uint32_t times = 1 + random.Below(3000);
      for (uint32_t i = 0; i < times; ++i) {
        list.push_back(item);
      }
    }
  }
}

void MutateObject(Json& object, Random& random) {
  auto at = object.begin();
  std::advance(at, random.Below(static_cast<uint32_t>(object.size())));
  const Json value = *at;
  const std::string key = at.key();
  if (random.Below(2) == 0) {
    object.erase(at);
  }
  object[key + "x"] = value;
}

void MutateJson(std::string& text, Random& random) {
  Json json = Json::parse(text);
  const int changes = 1 + static_cast<int>(random.Below(2));
  for (int i = 0; i < changes; ++i) {
    std::vector<Json*> values;
    Collect(json, values);
    Json& value = *values[random.Below(static_cast<uint32_t>(values.size()))];
    if (value.is_array() && !value.empty() && random.Below(2) == 0) {
      MutateList(value, random);
    } else if (value.is_object() && !value.empty() && random.Below(2) == 0) {
      MutateObject(value, random);
    } else {
      value = OddValue(Json(value), values, random);
    }
  }
  text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string too_large = "\"" + std::string(kTooLarge) + "\"";
  for (size_t at = 0; (at = text.find(too_large, at)) != std::string::npos;) {
    text.replace(at, too_large.size(), "1e999");
  }
}

// Mutates a member according to its kind, or as bytes.
void Mutate(NamedBytes& member, Random& random) {
  const bool by_kind = random.Below(4) > 0;
  if (by_kind && member.name.ends_with(".json")) {
    MutateJson(member.bytes, random);
  } else if (by_kind && member.name.find(".lar") != std::string::npos) {
    MutateWords(member.bytes, random);
  } else {
    MutateBytes(member.bytes, random);
  }
}

// ---- the test ----

double PeakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// True if an error names the bundle and describes the problem in words.
bool IsClear(const std::string& message) {
  const size_t file = message.find("a.larshow");
  if (file == std::string::npos) {
    return false;
  }
  for (const char* raw :
       {"std::", "bad_alloc", "terminate", "exception", "basic_string", "vector:"}) {
    if (message.find(raw) != std::string::npos) {
      return false;
    }
  }
  // Removes the location, for example "a.larshow: cup.larprop: ".
  std::string said = message.substr(file);
  for (size_t end = said.find(": "); end != std::string::npos; end = said.find(": ")) {
    if (said.find(' ') < end) {
      break;
    }
    said.erase(0, end + 2);
  }
  return std::count_if(said.begin(), said.end(), [](unsigned char c) { return std::isalpha(c); }) >=
         10;
}

void WriteFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

TEST(MutatedBundles, AreRefusedClearlyOrRun) {
  const auto context = render::CreateOffscreenContext();
  ASSERT_TRUE(context.ok()) << context.message();
  const auto target = render::RenderTarget::Create(kWidth, kHeight);
  ASSERT_TRUE(target.ok()) << target.message();
  const std::shared_ptr<Log> log = MakeSilentLog();
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.larshow";
  const std::vector<NamedBytes> members = Members();
  const std::string manifest = ManifestText(members);
  const std::string file = Archive(manifest, members);
  WriteFile(path, file);
  const Status good = LoadAndPlay(path, *target, *log);
  ASSERT_TRUE(good.ok()) << good.message();
  const int mutations = test::IsThorough() ? 10'000 : 300;
  int refused = 0, ran = 0;
  Took longest;
  std::map<std::string, std::pair<int, int>> by_part;  // number rejected, number played
  for (int number = 0; number < mutations; ++number) {
    Random random(static_cast<uint64_t>(number) + 1);
    std::string part;
    std::string bytes;
    switch (number % 4) {
      case 0:  // mutates the file, like a bad disk
        part = "the file";
        bytes = file;
        MutateBytes(bytes, random);
        break;
      case 1: {  // mutates the manifest and keeps its members, like a malicious author
        part = "manifest.json";
        NamedBytes changed = {part, manifest};
        Mutate(changed, random);
        bytes = Archive(changed.bytes, members);
        break;
      }
      default: {  // mutates a member and updates the manifest
        std::vector<NamedBytes> changed = members;
        NamedBytes& member = changed[random.Below(static_cast<uint32_t>(changed.size()))];
        part = member.name;
        Mutate(member, random);
        bytes = Archive(ManifestText(changed), changed);
      }
    }
    WriteFile(path, bytes);
    const Stopwatch watch;
    const Status status = LoadAndPlay(path, *target, *log);
    const Took took = watch.Seconds();
    longest = {std::max(longest.wall, took.wall), std::max(longest.processor, took.processor)};
    EXPECT_LE(took.processor, kMostSeconds)
        << "bundle " << number << " (" << part << ") " << status.message();
    EXPECT_TRUE(status.ok() || IsClear(status.message()))
        << "bundle " << number << " (" << part << "): " << status.message();
    ++(status.ok() ? ran : refused);
    ++(status.ok() ? by_part[part].second : by_part[part].first);
  }
  EXPECT_LE(PeakMebibytes(), kMostMebibytes);
  EXPECT_GT(refused, ran / 4) << "the mutations reach nothing";
  EXPECT_GT(ran, refused / 50) << "nothing is played";
  RecordProperty("refused", refused);
  RecordProperty("ran", ran);
  std::printf(
      "%d refused, %d ran; longest %.3f s of processor time, %.3f s by the clock; "
      "peak %.0f MiB\n",
      refused, ran, longest.processor, longest.wall, PeakMebibytes());
  for (const auto& [part, counts] : by_part) {
    std::printf("%s: %d refused, %d ran\n", part.c_str(), counts.first, counts.second);
  }
}

}  // namespace
}  // namespace lararium::player
