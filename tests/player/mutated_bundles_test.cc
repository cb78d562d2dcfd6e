// Bundles with anything in them: each is refused clearly or is a show that runs.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "shared/bundle/bundle.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/show/show.h"
#include "shared/stage/mesh_file.h"
#include "tests/human/rich_human.h"
#include "tests/stage/test_props.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

constexpr double kMostSeconds = 1.0;
constexpr double kMostMebibytes = 512.0;

struct NamedBytes {
  std::string name;
  std::vector<std::byte> bytes;
};

std::vector<std::byte> BytesOf(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// A show with a little of everything.
bundle::ShowManifest Manifest() {
  bundle::ShowManifest manifest;
  manifest.title = "Small";
  manifest.drama = "drama.lua";
  bundle::PlaceEntry& place = manifest.places.emplace_back();
  place.name = "bar";
  place.scene = "bar.larscene";
  place.occluders = {{"wall", "wall.larmesh", {}}};
  place.probes.emplace_back().light.sky[0] = {1.0f, 2.0f, 3.0f};
  manifest.cast = {{"one", "one.larhuman"}};
  manifest.objects = {{"cup", "cup.larprop", {}}};
  manifest.lines = {{"hello", "", {{"la", {"hello.json", ""}}}}};
  manifest.spoken = {{"la", "captions.json"}};
  manifest.captions = {"en"};
  return manifest;
}

std::vector<NamedBytes> Members() {
  geometry::TriangleMesh wall;
  wall.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  wall.indices = {0, 1, 2};
  return {
      {"drama.lua", BytesOf(R"(
function main()
  local one = actor("one")
  one:say("hello")
  wait(0.1)
  for i = 1, 5 do wait(0.05) end
end
)")},
      {"bar.larscene", test::OnePointScene(50.0)},
      {"wall.larmesh", stage::SerializeMesh(wall)},
      {"one.larhuman", human::SerializeHuman(human::RichHuman())},
      {"cup.larprop", stage::SerializeProp(test::MakeCup())},
      {"hello.json",
       BytesOf(R"({"schema": 1, "duration": 0.5, "visemes": [{"t": 0, "viseme": "aa"}]})")},
      {"captions.json", BytesOf(R"({"schema": 1, "lines": {"hello": {"en": [{"begin": 0, "end": 1,)"
                                R"( "text": "Hello"}]}}, "names": {"one": {"en": "One"}}})")}};
}

Status Write(const std::filesystem::path& path,
             const bundle::ShowManifest& manifest,
             const std::vector<NamedBytes>& members) {
  std::vector<bundle::MemberContent> contents;
  for (const NamedBytes& member : members) {
    contents.push_back({member.name, std::span<const std::byte>(member.bytes)});
  }
  std::filesystem::remove(path);
  return bundle::WriteBundle(path, manifest, contents);
}

// As the player does; half a second of the show.
Status LoadAndRun(const std::filesystem::path& path, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(path));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, show::LoadShowContent(bundle));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<show::Show> show,
                            show::Show::Create(std::move(content), {}, log));
  show::StagedFrame staged;
  for (int i = 0; i < 15; ++i) {
    vision::TrackedFrame tracked;
    tracked.camera = geometry::CameraModel{64, 48, 50.0, 50.0, 31.5, 23.5};
    tracked.camera_from_map = geometry::Rigid3{Eigen::Quaterniond::Identity(), {0.0, 0.0, 4.0}};
    tracked.frame.index = i;
    tracked.frame.capture_time = i / 30.0;
    show->StageFrame(std::move(tracked), i / 30.0, staged);
  }
  return Status();
}

// Flips, sets, cuts, repeats or inserts bytes.
void Mutate(std::vector<std::byte>& bytes, Random& random) {
  const int changes = 1 + static_cast<int>(random.Below(4));
  for (int i = 0; i < changes && !bytes.empty(); ++i) {
    const auto at = random.Below(static_cast<uint32_t>(bytes.size()));
    const auto place = bytes.begin() + at;
    const auto run = std::min<size_t>(1 + random.Below(16), bytes.size() - at);
    switch (random.Below(6)) {
      case 0:
        *place ^= static_cast<std::byte>(1u << random.Below(8));
        break;
      case 1:
        *place = static_cast<std::byte>(random.Below(256));
        break;
      case 2:  // what sizes and counts are most afraid of
        std::fill_n(place, run, static_cast<std::byte>(random.Below(2) == 0 ? 0xff : 0x00));
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes.insert(place, run, static_cast<std::byte>(random.Below(256)));
        break;
      default: {
        const std::vector<std::byte> piece(place, place + static_cast<std::ptrdiff_t>(run));
        bytes.insert(bytes.begin() + random.Below(static_cast<uint32_t>(bytes.size())),
                     piece.begin(), piece.end());
      }
    }
  }
}

double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double PeakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

TEST(MutatedBundles, AreRefusedClearlyOrRun) {
  const std::shared_ptr<Log> log = MakeSilentLog();
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.larshow";
  const std::vector<NamedBytes> members = Members();
  ASSERT_TRUE(Write(path, Manifest(), members).ok());
  const Status good = LoadAndRun(path, *log);
  ASSERT_TRUE(good.ok()) << good.message();
  const std::vector<std::byte> file = *ReadBytes(path);
  int refused = 0, ran = 0;
  double longest = 0.0;
  for (int number = 0; number < LARARIUM_MUTATIONS; ++number) {
    Random random(static_cast<uint64_t>(number) + 1);
    // One in four as a thief or a bad disk would: the file. The others as a bad author would: the
    // members, packed as they should be.
    Status written;
    if (number % 4 == 0) {
      std::vector<std::byte> changed = file;
      Mutate(changed, random);
      std::ofstream(path, std::ios::binary | std::ios::trunc)
          .write(reinterpret_cast<const char*>(changed.data()),
                 static_cast<std::streamsize>(changed.size()));
    } else {
      std::vector<NamedBytes> changed = members;
      Mutate(changed[random.Below(static_cast<uint32_t>(changed.size()))].bytes, random);
      written = Write(path, Manifest(), changed);
      ASSERT_TRUE(written.ok()) << written.message();
    }
    const double begin = ProcessorSeconds();
    const Status status = LoadAndRun(path, *log);
    const double seconds = ProcessorSeconds() - begin;
    longest = std::max(longest, seconds);
    EXPECT_LE(seconds, kMostSeconds) << "bundle " << number << " " << status.message();
    if (status.ok()) {
      ++ran;
    } else {
      ++refused;
      // Its place: the bundle and its member, or the line of the script.
      EXPECT_TRUE(status.message().find("a.larshow") != std::string::npos ||
                  status.message().find("drama.lua:") != std::string::npos)
          << "bundle " << number << ": " << status.message();
    }
  }
  EXPECT_LE(PeakMebibytes(), kMostMebibytes);
  EXPECT_GT(refused, ran / 4) << "the mutations reach nothing";
  RecordProperty("refused", refused);
  RecordProperty("ran", ran);
  std::printf("%d refused, %d ran, longest %.3f s of processor time, peak %.0f MiB\n", refused, ran,
              longest, PeakMebibytes());
}

}  // namespace
}  // namespace lararium::player
