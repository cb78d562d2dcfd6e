// What a frame of the editor's interface costs, with a large map and a long timeline: all
// processor time of the process, the software renderer's threads included, without the
// composite picture (there is no recording). Prints JSON.
//
//   lararium_editor_bench ITEMS FRAMES [SCENE.larscene]

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

#include "editor/app/layout.h"
#include "editor/app/workspace.h"
#include "editor/panels/theme.h"
#include "shared/core/file.h"
#include "shared/render/graphics_context.h"
#include "shared/render/render_target.h"
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

// Ten lanes of speech, gazes, expressions and markers, spread over the items' seconds.
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

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return 1e3 * values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: lararium_editor_bench ITEMS FRAMES [SCENE.larscene]\n");
    return 2;
  }
  const int items = std::atoi(argv[1]);
  const int frames = std::atoi(argv[2]);
  const test::TemporaryFolder folder;
  const app::ProjectPaths paths{folder / "bench.lararium"};
  CHECK(app::CreateProject(paths, "bench").ok());
  CHECK(WriteFileAtomically(paths.Drama(), LongScript(items)).ok());
  if (argc > 3) {
    app::ProjectDocument document;
    document.title = "bench";
    document.places.emplace_back().name = "site";
    CHECK(app::SaveProject(paths, document).ok());
    std::filesystem::create_directories(paths.Place("site"));
    std::filesystem::copy_file(argv[3], paths.Scene("site"));
  }
  const std::shared_ptr<Log> log = MakeSilentLog();
  const auto opening = std::chrono::steady_clock::now();
  const auto workspace = app::Workspace::Open(paths, *log);
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
  app::Settings settings;
  panels::ApplyTheme(app::Theme::kDark, 1.0f);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  const auto layout = app::Layout::Create();
  CHECK(layout.ok());
  size_t points = 0;
  for (int i = 0; i < 3000 && argc > 3 && points == 0; ++i) {  // until the map is there
    (*workspace)->Update(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if ((*workspace)->loaded().database != nullptr) {
      points = (*workspace)->loaded().database->points.size();
    }
  }
  std::vector<double> interface_s;
  std::vector<double> process_s;
  for (int i = 0; i < frames + 20; ++i) {
    const double thread = ThreadSeconds();
    const double process = ProcessSeconds();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = 1.0f / 60.0f;
    // The mouse wanders over the timeline.
    io.MousePos =
        ImVec2(300.0f + static_cast<float>(i % 800), 640.0f + static_cast<float>(i % 180));
    (*workspace)->Update(1.0 / 60.0);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    (*layout)->Show(**workspace, settings);
    ImGui::Render();
    const double drawn = ThreadSeconds();
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
    glViewport(0, 0, 1440, 900);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glFinish();
    if (i == 2) {
      (*layout)->AddKey({'2', 0, false});  // around the place
    }
    if (i >= 20) {
      interface_s.push_back(drawn - thread);
      process_s.push_back(ProcessSeconds() - process);
    }
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "{\"items\": %d, \"points\": %zu, \"open_seconds\": %.3f, \"interface_ms\": %.2f, "
      "\"frame_cpu_ms\": %.2f, \"peak_mib\": %.0f}\n",
      items, points, open_s, Median(interface_s), Median(process_s),
      static_cast<double>(usage.ru_maxrss) / 1024.0);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  return 0;
}
