// Cost of a frame of the editor's interface, with a large map and a long timeline: all CPU time of
// the process, including the software renderer's threads, without the composite (there is no
// recording). Work that other threads do once after the start, such as synthesising the library's
// sounds, is awaited first: it would count as the frames' cost. Prints JSON with median and 95th
// percentile for frames in which the pointer moves over the timeline; in which the timeline scrolls
// below it; in which the scene view turns; and that are painted completely.
//
//   lararium_editor_bench ITEMS FRAMES [SCENE.larscene [POINTS]]
//
// POINTS: the map's points are repeated with small offsets up to this number.

#include <epoxy/gl.h>
// epoxy first: ImGui's back end must not bring its own OpenGL headers.
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "editor/panels/widgets/theme.h"
#include "editor/session/workspace.h"
#include "editor/window/frame_painter.h"
#include "editor/window/layout.h"
#include "shared/core/file.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/vision/scene_database.h"
#include "tests/support/test_files.h"

namespace {

using namespace lararium;  // NOLINT: the program itself

double ProcessSeconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double ThreadSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Waits until only frames take CPU time.
void AwaitQuiet(editor::Workspace& workspace) {
  constexpr double kQuietShare = 0.02;
  constexpr auto kSpell = std::chrono::milliseconds(250);
  constexpr int kMostSpells = 240;
  for (int i = 0; i < kMostSpells; ++i) {
    const double before = ProcessSeconds();
    workspace.Update(0.0);
    std::this_thread::sleep_for(kSpell);
    if (ProcessSeconds() - before < kQuietShare * std::chrono::duration<double>(kSpell).count()) {
      return;
    }
  }
  std::fprintf(stderr, "Something works in the background all the while; it counts as well.\n");
}

// Twenty lanes of speech, gazes, expressions and gestures with `items` items, one every quarter of
// a second.
std::string LongScript(int items) {
  const char* const kLanes[] = {"speech", "gaze", "expressions", "gestures"};
  const char* const kFields[] = {"line = 'salve'", "target = 'visitor'", "expression = 'joy'",
                                 "clip = 'wave'"};
  constexpr int kPeople = 5;
  std::string script;
  for (int lane = 0; lane < kPeople * 4; ++lane) {
    script += "track{actor = 'p" + std::to_string(lane / 4) + "', " + kLanes[lane % 4] + " = {\n";
    for (int i = lane; i < items; i += kPeople * 4) {
      script +=
          "  {at = " + std::to_string(i * 0.25) + ", length = 3.5, " + kFields[lane % 4] + "},\n";
    }
    script += "}}\n";
  }
  return script;
}

double Quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return 1e3 * *at;
}

// Copies a map and adds points that cost drawing time but do not match anything.
void CopyScene(const std::filesystem::path& from, const std::filesystem::path& to, size_t points) {
  auto scene = vision::LoadSceneDatabase(from);
  CHECK(scene.ok());
  const size_t own = scene->points.size();
  for (size_t i = own; i < points; ++i) {
    const float aside = 1e-3f * static_cast<float>(i / own);
    scene->points.push_back(scene->points[i % own] + Eigen::Vector3f::Constant(aside));
    scene->normals.push_back(scene->normals[i % own]);
    scene->observation_counts.push_back(scene->observation_counts[i % own]);
    scene->session_masks.push_back(scene->session_masks[i % own]);
    if (!scene->colours.empty()) {
      scene->colours.push_back(scene->colours[i % own]);
    }
    scene->descriptor_begin.push_back(scene->descriptor_begin.back());
  }
  CHECK(vision::SaveSceneDatabase(to, *scene).ok());
}

enum class Scenario { kPointer, kScroll, kOrbit, kWhole };

void Act(Scenario scenario, int frame, editor::FramePainter& painter) {
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = 1.0f / 60.0f;
  io.MouseDown[0] = scenario == Scenario::kOrbit;
  io.MousePos = scenario == Scenario::kOrbit
                    ? ImVec2(500.0f + static_cast<float>(frame % 300), 250.0f)
                    : ImVec2(300.0f + static_cast<float>(frame % 800),
                             640.0f + static_cast<float>(frame % 180));
  if (scenario == Scenario::kScroll) {
    io.MouseWheel = frame % 40 < 20 ? 1.0f : -1.0f;
  }
  if (scenario == Scenario::kWhole) {
    painter.Forget();
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: lararium_editor_bench ITEMS FRAMES [SCENE.larscene [POINTS]]\n");
    return 2;
  }
  const int items = std::atoi(argv[1]);
  const int frames = std::atoi(argv[2]);
  const test::TemporaryFolder folder;
  const editor::ProjectPaths paths{folder / "bench.lararium"};
  CHECK(editor::CreateProject(paths, "bench").ok());
  CHECK(WriteFileAtomically(paths.Drama(), LongScript(items)).ok());
  if (argc > 3) {
    editor::ProjectDocument document;
    document.title = "bench";
    document.places.emplace_back().name = "site";
    CHECK(editor::SaveProject(paths, document).ok());
    std::filesystem::create_directories(paths.Place("site"));
    CopyScene(argv[3], paths.Scene("site"), argc > 4 ? static_cast<size_t>(std::atoi(argv[4])) : 0);
  }
  const std::shared_ptr<Log> log = MakeSilentLog();
  const auto opening = std::chrono::steady_clock::now();
  const auto workspace = editor::Workspace::Open(paths, *log);
  CHECK(workspace.ok());
  const double open_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - opening).count();
  const auto context = render::CreateOffscreenContext();
  CHECK(context.ok());
  const auto target = render::RenderTarget::Create(1440, 900);
  CHECK(target.ok());
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().DisplaySize = ImVec2(1440, 900);
  editor::Settings settings;
  editor::PanelSizes sizes;
  panels::ApplyTheme(editor::Theme::kDark, 1.0f);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  const auto layout = editor::Layout::Create();
  CHECK(layout.ok());
  size_t points = 0;
  for (int i = 0; i < 3000 && argc > 3 && points == 0; ++i) {  // Wait until the map is loaded.
    (*workspace)->Update(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if ((*workspace)->map().loaded().database != nullptr) {
      points = (*workspace)->map().loaded().database->points.size();
    }
  }
  editor::FramePainter painter;
  const auto run = [&](Scenario scenario, int count, std::vector<double>* interface_s) {
    std::vector<double> process_s;
    for (int i = 0; i < count; ++i) {
      const double thread = ThreadSeconds();
      const double process = ProcessSeconds();
      Act(scenario, i, painter);
      (*workspace)->Update(1.0 / 60.0);
      ImGui_ImplOpenGL3_NewFrame();
      ImGui::NewFrame();
      (*layout)->Show(**workspace, settings, sizes);
      ImGui::Render();
      const double laid_out = ThreadSeconds();
      if (painter.Paint(*ImGui::GetDrawData(), glm::vec3(0.0f))) {
        painter.CopyInto(target->framebuffer());  // The window does the same.
      }
      glFinish();
      if (interface_s != nullptr) {
        interface_s->push_back(laid_out - thread);
      }
      process_s.push_back(ProcessSeconds() - process);
    }
    return process_s;
  };
  run(Scenario::kPointer, 3, nullptr);
  (*layout)->AddKey({'2', 0, false});  // The scene view.
  run(Scenario::kPointer, 17, nullptr);
  AwaitQuiet(**workspace);
  std::vector<double> interface_s;
  const std::vector<double> pointer = run(Scenario::kPointer, frames, &interface_s);
  const std::vector<double> scroll = run(Scenario::kScroll, frames, nullptr);
  run(Scenario::kPointer, 3, nullptr);
  const std::vector<double> orbit = run(Scenario::kOrbit, frames, nullptr);
  const std::vector<double> whole = run(Scenario::kWhole, frames, nullptr);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf("{\"items\": %d, \"points\": %zu, \"open_seconds\": %.3f, \"interface_ms\": %.2f",
              items, points, open_s, Quantile(interface_s, 0.5));
  const std::pair<const char*, const std::vector<double>*> kinds[] = {
      {"pointer", &pointer}, {"scroll", &scroll}, {"orbit", &orbit}, {"whole", &whole}};
  for (const auto& [name, times] : kinds) {
    std::printf(", \"%s_cpu_ms\": [%.2f, %.2f]", name, Quantile(*times, 0.5),
                Quantile(*times, 0.95));
  }
  std::printf(", \"peak_mib\": %.0f}\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  return 0;
}
