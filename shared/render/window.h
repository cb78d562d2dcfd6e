#pragma once

// A window with an OpenGL context (GLFW).

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/graphics_context.h"

struct GLFWwindow;

namespace lararium::render {

struct WindowOptions {
  std::string title = "Lararium";
  int width = 1280;  // screen coordinates, of a window that is not full screen
  int height = 720;
  std::optional<int> monitor =
      std::nullopt;  // full screen there, without a pointer; 0: the primary
  bool vsync = true;
  bool visible = true;
  GraphicsChoice graphics = GraphicsApi::kOpenGl33;
};

// Codes are GLFW's. Positions are in screen coordinates from the top-left corner.
struct WindowCallbacks {
  std::function<void(int key, int action, int modifiers)> key;
  // What a key types, after it was pressed; Unicode.
  std::function<void(char32_t character)> character = {};
  std::function<void(int button, int action, int modifiers)> mouse_button;
  std::function<void(double x, double y)> cursor;
  std::function<void(double x, double y)> scroll;
  std::function<void(int width, int height)> resize;  // framebuffer, pixels
  std::function<void()> refresh = {};  // what was shown is lost: after being covered, say
};

inline constexpr int kKeyPressed = 1;
// "a", "1", "f1", "space", "enter", "left", "page_down", ...; empty: a key without a name.
std::string KeyName(int key);
// Whether there is a key or a controller's button of that name.
bool IsButtonName(std::string_view name);

// Move-only. Use it on the main thread only.
class Window {
 public:
  // Makes the window's context current. Fails with a clear message where there
  // is no display, no such graphics, or a driver that lacks what pictures are drawn with.
  static Result<Window> Create(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  void SetCallbacks(WindowCallbacks callbacks);
  void SetTitle(const std::string& title);

  // Shows what was drawn; waits for the display when vsync is on.
  void SwapBuffers();
  // Handles input, without waiting; WaitEvents sleeps until something happens.
  void PollEvents();
  void WaitEvents(double timeout_seconds);

  // Buttons of game controllers that were pressed since it was last asked: "pad_a", "pad_up",
  // "pad_start", ...
  std::vector<std::string> TakePadButtons();

  bool ShouldClose() const;
  // Whether it was asked to close since this was last asked.
  bool TakeClose();
  void RequestClose();

  struct Size {
    int width = 0;
    int height = 0;
  };
  Size framebuffer_size() const;  // pixels; 0 x 0 while minimised
  float content_scale() const;    // 2 on a display of double density
  GLFWwindow* handle() const;     // for ImGui's back end

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
