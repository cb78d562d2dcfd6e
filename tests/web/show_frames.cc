// show_frames BUNDLE FRAMES SECONDS FOLDER
// Stages a show from that moment of its drama on, 30 frames a second, as it is seen from one
// of the place's keyframes, and writes what the test of the show in WebAssembly compares:
//   FOLDER/people.f32   where people stand and how they are posed: stage_from_actor, skin matrices
//   FOLDER/hair.f32     skin matrices of joints that swing
//   FOLDER/faces.f32    some of the vertices of faces, and their normals
//   FOLDER/cloth.f32    some of the vertices of cloth
//   FOLDER/light.f32    the light on some of the vertices of people and things
//   FOLDER/things.f32   stage_from_part of all things
//   FOLDER/frames.json  of each frame: the drama's time, people, captions, and the time of staging
// It is compiled for both systems.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/log.h"
#include "shared/core/parallel.h"
#include "shared/show/caption_texts.h"
#include "shared/show/show.h"
#include "tests/web/moment.h"

namespace lararium::show {
namespace {

// Only every 61st vertex is written, so that the files stay small.
constexpr size_t kStep = 61;

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Numbers {
  std::vector<float> people;
  std::vector<float> hair;
  std::vector<float> faces;
  std::vector<float> cloth;
  std::vector<float> light;
  std::vector<float> things;
};

void Append(const glm::mat4& matrix, std::vector<float>& out) {
  out.insert(out.end(), glm::value_ptr(matrix), glm::value_ptr(matrix) + 16);
}

void AppendSome(std::span<const glm::vec3> vectors, std::vector<float>& out) {
  for (size_t i = 0; i < vectors.size(); i += kStep) {
    out.insert(out.end(), {vectors[i].x, vectors[i].y, vectors[i].z});
  }
}

// True for each joint that swings behind its parent.
std::vector<bool> FindSwinging(const human::Human& human) {
  std::vector<bool> swinging(human.skeleton.size(), false);
  for (const human::SpringChain& chain : human.springs) {
    for (const uint32_t joint : chain.joints) {
      swinging[joint] = true;
    }
  }
  return swinging;
}

void AppendNumbers(const StagedFrame& staged, Numbers& out) {
  const StagedPeople& people = staged.people;
  for (const StagedActor& actor : people.actors) {
    Append(actor.stage_from_actor, out.people);
    const std::vector<bool> swinging = FindSwinging(*actor.figure);
    for (uint32_t joint = 0; joint < actor.skin_count; ++joint) {
      Append(people.skin[actor.skin_begin + joint], swinging[joint] ? out.hair : out.people);
    }
  }
  for (const StagedMesh& mesh : people.meshes) {
    const glm::vec3* positions = people.positions.data() + mesh.vertex_begin;
    AppendSome({positions, mesh.vertex_count}, mesh.mesh.posed ? out.cloth : out.faces);
    if (!mesh.mesh.posed) {
      AppendSome({people.normals.data() + mesh.vertex_begin, mesh.vertex_count}, out.faces);
    }
  }
  AppendSome(staged.light.on_people, out.light);
  AppendSome(staged.light.on_things, out.light);
  for (const glm::mat4& matrix : staged.things.stage_from_part) {
    Append(matrix, out.things);
  }
}

Json Described(const StagedFrame& staged, const CaptionTexts& texts, double milliseconds) {
  Json people = Json::array();
  for (const StagedActor& actor : staged.people.actors) {
    people.push_back(actor.cast);
  }
  std::vector<render::Caption> captions;
  CollectCaptions(texts, staged, captions);
  Json shown = Json::array();
  for (const render::Caption& caption : captions) {
    shown.push_back({{"speaker", caption.speaker},
                     {"text", caption.text},
                     {"side", static_cast<int>(caption.side)}});
  }
  return {{"time", staged.time},
          {"people", people},
          {"moving_vertices", staged.people.positions.size()},
          {"lit_vertices", staged.light.on_people.size()},
          {"captions", shown},
          {"milliseconds", milliseconds}};
}

Status Write(const std::filesystem::path& file, const std::vector<float>& numbers) {
  return WriteFileAtomically(file, std::string(reinterpret_cast<const char*>(numbers.data()),
                                               numbers.size() * sizeof(float)));
}

Status StageFrames(const std::filesystem::path& file,
                   int frames,
                   double seconds,
                   const std::filesystem::path& folder) {
  const Clock::time_point start = Clock::now();
  const std::shared_ptr<Log> log = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Show> show, OpenAt(file, seconds, *log));
  Json described = {{"loading_milliseconds", MillisecondsSince(start)}};
  const CaptionTexts texts = TextsOf(show->content());
  Numbers numbers;
  StagedFrame staged;
  for (int i = 0; i < frames; ++i) {
    const vision::TrackedFrame tracked = ViewOf(*show, i);
    const Clock::time_point begin = Clock::now();
    show->StageFrame(tracked, tracked.frame.capture_time, staged);
    const double milliseconds = MillisecondsSince(begin);
    described["frames"].push_back(Described(staged, texts, milliseconds));
    AppendNumbers(staged, numbers);
  }
  for (const drama::ScriptError& error : show->drama().errors()) {
    described["errors"].push_back(error.message);
  }
  LARARIUM_RETURN_IF_ERROR(Write(folder / "people.f32", numbers.people));
  LARARIUM_RETURN_IF_ERROR(Write(folder / "hair.f32", numbers.hair));
  LARARIUM_RETURN_IF_ERROR(Write(folder / "faces.f32", numbers.faces));
  LARARIUM_RETURN_IF_ERROR(Write(folder / "cloth.f32", numbers.cloth));
  LARARIUM_RETURN_IF_ERROR(Write(folder / "light.f32", numbers.light));
  LARARIUM_RETURN_IF_ERROR(Write(folder / "things.f32", numbers.things));
  return WriteFileAtomically(folder / "frames.json", described.dump());
}

}  // namespace
}  // namespace lararium::show

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: show_frames BUNDLE FRAMES SECONDS FOLDER\n");
    return 2;
  }
  const lararium::ThreadLimit one(1);
  const lararium::Status status =
      lararium::show::StageFrames(argv[1], std::atoi(argv[2]), std::atof(argv[3]), argv[4]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
