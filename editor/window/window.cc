#include "editor/window/window.h"

#include <epoxy/gl.h>
// epoxy first: GLFW must not bring its own OpenGL headers.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "editor/panels/widgets/file_chooser.h"
#include "editor/panels/widgets/key_state.h"
#include "editor/panels/widgets/keyboard_focus.h"
#include "editor/panels/widgets/keys.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/wrapped_text.h"
#include "editor/session/workspace.h"
#include "editor/window/frame_painter.h"
#include "editor/window/window_content.h"
#include "shared/core/memory.h"
#include "shared/render/gl/window.h"

// Declared here, because GLFW/glfw3native.h also needs the headers of Xlib and RandR. A GLFW that
// was built for Wayland alone lacks it.
extern "C" __attribute__((weak)) unsigned long glfwGetX11Window(GLFWwindow* window);

namespace lararium::editor {

namespace {

// Blocks of at least this size in bytes are returned to the system at once. Baking and opening
// allocate and free hundreds of megabytes on long-lived threads whose heaps would keep them.
// Pictures of the window are larger, but rarely drawn.
constexpr size_t kLargeBlock = 1 << 20;
// Interval at which free memory is returned, such as memory from opening, compiling shaders or
// seeking the drama.
constexpr std::chrono::seconds kKeepInterval(2);

// ImGui with its back ends, for the window's lifetime.
class Interface {
 public:
  explicit Interface(const render::Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    // Text copied from a wrapped field contains no line breaks of the wrapping.
    ImGui::GetIO().SetClipboardTextFn = [](void* of, const char* text) {
      glfwSetClipboardString(static_cast<GLFWwindow*>(of), panels::UnwrapText(text).c_str());
    };
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }

  // Applies the theme. Call between frames. Does nothing if the look has not changed.
  void SetLook(const Settings& look, float display_scale) {
    if (has_look_ && look_ == look) {
      return;
    }
    panels::ApplyTheme(look.theme, display_scale * static_cast<float>(look.scale));
    if (has_look_) {  // The back end creates the first texture itself.
      ImGui_ImplOpenGL3_DestroyFontsTexture();
      ImGui_ImplOpenGL3_CreateFontsTexture();
      painter_.Forget();
    }
    look_ = look;
    has_look_ = true;
  }

  ~Interface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  // key, modifiers: GLFW codes.
  void NotePress(int key, int modifiers) { latch_.Press(key, modifiers); }

  // keys_walk: see panels::Navigation.
  void Begin(bool keys_walk) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::GetIO().Fonts->ClearTexData();  // The texture has a copy.
    ImGui_ImplGlfw_NewFrame();
    latch_.Hold();
    navigation_.Prepare(keys_walk);
    ImGui::NewFrame();
  }
  // Returns false if the window need not be redrawn. lost: the window's content was lost.
  bool End(bool lost) {
    ImGui::Render();
    latch_.LetGo();
    const ImVec4& background = panels::Colours().window;
    const bool painted =
        painter_.Paint(*ImGui::GetDrawData(), {background.x, background.y, background.z});
    if (painted || lost) {
      painter_.CopyInto(0);
    }
    return painted || lost;
  }

 private:
  FramePainter painter_;
  panels::KeyLatch latch_;
  panels::Navigation navigation_;
  Settings look_;
  bool has_look_ = false;
};

// Waits for input; briefly while something moves. The idle timeout lets ImGui finish changes that
// take a few frames after input.
void WaitForInput(render::Window& window, const WindowContent& content) {
  constexpr double kBusyWait = 1.0 / 60.0;  // seconds
  constexpr double kIdleWait = 0.1;
  window.WaitEvents(content.Busy() ? kBusyWait : kIdleWait);
}

// Letters by the keyboard layout; all other keys by position.
int KeyOfLayout(int key) {
  const char* name = glfwGetKeyName(key, 0);
  const bool letter = name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return letter ? name[0] - 'a' + GLFW_KEY_A : key;
}

// The window as the desktop's portal identifies it; empty where it does not lie on an X server.
std::string PortalWindow(GLFWwindow* window) {
  const unsigned long id = glfwGetX11Window != nullptr ? glfwGetX11Window(window) : 0;
  std::array<char, 32> text = {};
  std::snprintf(text.data(), text.size(), "x11:%lx", id);
  return id != 0 ? text.data() : "";
}

// Reduces a window that is larger than the monitor.
void FitOnMonitor(const render::Window& window, const WindowSizes& sizes) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  if (monitor != nullptr) {
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  }
  if (width > 0 && height > 0 && (sizes.width > width || sizes.height > height)) {
    glfwSetWindowSize(window.handle(), std::min(sizes.width, width),
                      std::min(sizes.height, height));
    glfwSetWindowPos(window.handle(), x, y);
  }
  if (sizes.maximized) {
    glfwMaximizeWindow(window.handle());
  }
}

// The window's present size. before: its size when not maximised.
WindowSizes SizesOf(const render::Window& window, WindowSizes before, const PanelSizes& panels) {
  before.panels = panels;
  before.maximized = glfwGetWindowAttrib(window.handle(), GLFW_MAXIMIZED) == GLFW_TRUE;
  const bool shown = glfwGetWindowAttrib(window.handle(), GLFW_ICONIFIED) == GLFW_FALSE;
  if (shown && !before.maximized) {
    glfwGetWindowSize(window.handle(), &before.width, &before.height);
  }
  return before;
}

Status MainLoop(render::Window& window,
                std::unique_ptr<Workspace> workspace,
                const Settings& settings,
                const WindowSizes& sizes,
                Log& log) {
  Interface interface(window);
  panels::FileChooser chooser(PortalWindow(window.handle()));
  WindowContent content(std::move(workspace), settings, sizes.panels, log);
  render::WindowCallbacks callbacks;
  panels::AltTap alt;
  callbacks.key = [&](int key, int action, int modifiers) {
    if (alt.Ends(key, action)) {
      content.AddKey({GLFW_KEY_F10, 0, false});
    }
    if (action != GLFW_RELEASE) {
      interface.NotePress(key, modifiers);
      content.AddKey({KeyOfLayout(key), modifiers, action == GLFW_REPEAT});
    }
  };
  callbacks.mouse_button = [&alt](int, int, int) { alt.Cancel(); };
  callbacks.character = [&content](char32_t character) { content.AddCharacter(character); };
  bool lost = false;
  callbacks.drop = [&content](const std::vector<std::string>& paths) {
    content.Drop({paths.begin(), paths.end()});
  };
  callbacks.refresh = [&lost] { lost = true; };
  window.SetCallbacks(std::move(callbacks));
  auto last = std::chrono::steady_clock::now();
  std::string title;
  Status status;
  while (status.ok() && !content.quit_requested()) {
    WaitForInput(window, content);
    if (window.TakeClose()) {
      content.RequestQuit();
    }
    const auto now = std::chrono::steady_clock::now();
    content.Update(std::chrono::duration<double>(now - last).count());
    last = now;
    if (std::string wanted = content.Title(); wanted != title) {
      title = std::move(wanted);
      window.SetTitle(title);
    }
    const render::Window::Size size = window.framebuffer_size();
    if (size.width == 0 || size.height == 0) {
      continue;
    }
    interface.SetLook(content.settings(), window.content_scale());
    chooser.BeginFrame();
    interface.Begin(content.keys_walk());
    status = content.Show();
    if (interface.End(std::exchange(lost, false))) {
      window.SwapBuffers();
    }
  }
  window.SetCallbacks({});
  KeepWindowSizes(SizesOf(window, sizes, content.panels()), log);
  return status;
}

}  // namespace

Status RunWindow(const std::filesystem::path& project, Log& log) {
  KeepPagesSmall();
  // As many arenas as threads that can allocate at the same time.
  ShareArenas(static_cast<int>(std::max(2u, std::thread::hardware_concurrency())));
  ReturnBlocksFrom(kLargeBlock);
  const Settings settings = RestoreSettings(log);
  std::unique_ptr<Workspace> workspace;
  if (!project.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(workspace, Workspace::Open({project}, log));
  }
  const WindowSizes sizes = RestoreWindowSizes(log);
  render::WindowOptions window_options;
  window_options.width = sizes.width;
  window_options.height = sizes.height;
  LARARIUM_ASSIGN_OR_RETURN(render::Window window, render::Window::Create(window_options));
  FitOnMonitor(window, sizes);
  const HeapKeeper heap_keeper(kKeepInterval);
  return MainLoop(window, std::move(workspace), settings, sizes, log);
}

}  // namespace lararium::editor
