#include "editor/app/window.h"

#include <epoxy/gl.h>
// epoxy first: GLFW must not bring its own OpenGL headers.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <chrono>
#include <cstdlib>
#include <memory>

#include "editor/app/layout.h"
#include "editor/app/workspace.h"
#include "editor/panels/theme.h"
#include "shared/core/file.h"
#include "shared/render/window.h"

namespace lararium::app {

namespace {

// Where the editor remembers the last project (XDG base directories).
std::filesystem::path StateFile() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path base =
      state != nullptr && *state != '\0'
          ? std::filesystem::path(state)
          : std::filesystem::path(home != nullptr ? home : ".") / ".local" / "state";
  return base / "lararium" / "editor.json";
}

// The sample beside the build tree that this program runs from; empty elsewhere.
std::filesystem::path SampleProject() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path root = program.parent_path() / ".." / ".." / "..";
  const std::filesystem::path sample =
      (root / "scenes" / "maquette" / "maquette.lararium").lexically_normal();
  return !error && std::filesystem::exists(sample, error) ? sample : std::filesystem::path();
}

Result<std::filesystem::path> LastProject() {
  const Result<Json> json = LoadJson(StateFile());
  if (json.ok()) {
    const Result<std::string> project = JsonView(*json, StateFile().string()).Text("project");
    std::error_code ignored;
    if (project.ok() && std::filesystem::exists(*project, ignored)) {
      return std::filesystem::path(*project);
    }
  }
  if (std::filesystem::path sample = SampleProject(); !sample.empty()) {
    return sample;
  }
  return Status::Error(
      "lararium-editor", "no project was opened before",
      "name one: lararium-editor PROJECT; or make one: lararium-editor new PROJECT");
}

// Not being able to remember is no reason to stop.
void RememberProject(const std::filesystem::path& project, Log& log) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(project, error);
  std::filesystem::create_directories(StateFile().parent_path(), error);
  if (const Status status = SaveJson(StateFile(), {{"project", absolute.string()}}); !status.ok()) {
    log.warn("{}", status.message());
  }
}

// ImGui with its back ends, for the life of the window.
class Interface {
 public:
  explicit Interface(const render::Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    panels::ApplyTheme(window.content_scale());
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~Interface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void Begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
  }
  void End(const render::Window::Size& size) {
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    glClearColor(panels::colour::kWindow.x, panels::colour::kWindow.y, panels::colour::kWindow.z,
                 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
};

std::string Title(const Workspace& workspace) {
  return workspace.document().title + (workspace.commands().dirty() ? " \xe2\x80\xa2" : "") +
         " \xe2\x80\x93 Lararium";
}

// Sleeps while nothing moves, but long enough awake for what ImGui settles over
// a few frames after input.
void WaitForInput(render::Window& window, const Workspace& workspace) {
  constexpr double kBusyWait = 1.0 / 60.0;  // seconds
  constexpr double kIdleWait = 0.1;
  window.WaitEvents(workspace.Busy() ? kBusyWait : kIdleWait);
}

Status MainLoop(render::Window& window, Workspace& workspace) {
  Interface interface(window);
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Layout> layout, Layout::Create());
  render::WindowCallbacks callbacks;
  callbacks.key = [&layout](int key, int action, int modifiers) {
    if (action != GLFW_RELEASE) {
      layout->AddKey({key, modifiers, action == GLFW_REPEAT});
    }
  };
  window.SetCallbacks(std::move(callbacks));
  auto last = std::chrono::steady_clock::now();
  std::string title;
  while (!window.ShouldClose() && !layout->quit_requested()) {
    WaitForInput(window, workspace);
    const auto now = std::chrono::steady_clock::now();
    workspace.Update(std::chrono::duration<double>(now - last).count());
    last = now;
    if (std::string wanted = Title(workspace); wanted != title) {
      title = std::move(wanted);
      window.SetTitle(title);
    }
    const render::Window::Size size = window.framebuffer_size();
    if (size.width == 0 || size.height == 0) {
      continue;
    }
    interface.Begin();
    layout->Show(workspace);
    interface.End(size);
    window.SwapBuffers();
  }
  window.SetCallbacks({});
  return Status();
}

}  // namespace

Status RunWindow(const WindowOptions& options, Log& log) {
  std::filesystem::path project = options.project;
  if (project.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(project, LastProject());
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Workspace> workspace,
                            Workspace::Open({project}, log));
  RememberProject(project, log);
  render::WindowOptions window_options;
  window_options.title = Title(*workspace);
  window_options.width = 1440;
  window_options.height = 900;
  LARARIUM_ASSIGN_OR_RETURN(render::Window window, render::Window::Create(window_options));
  return MainLoop(window, *workspace);
}

}  // namespace lararium::app
